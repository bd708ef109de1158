#include "engine/remesh/divide_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spia {
namespace {

double distance_to_chord(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& point)
{
    const Eigen::Vector3d along = b - a;
    const double squared = along.squaredNorm();
    const double t = squared > 0 ? std::clamp(along.dot(point - a) / squared, 0.0, 1.0) : 0;
    return (a + t * along - point).norm();
}

} // namespace

LineDivision divide_line(const TriMesh& mesh, const std::vector<int>& line, const Eigen::VectorXd& size,
                         const Eigen::VectorXd& sagitta, const Progress& progress)
{
    constexpr double longest_chord = 1.4; // of the size asked for
    const size_t n = line.size();
    const auto at = [&](size_t i) -> Eigen::Vector3d { return mesh.position.col(line[i]); };
    std::vector<double> along(n, 0); // in units of the size asked for
    for (size_t i = 1; i < n; ++i)
        along[i] = along[i - 1] + (at(i) - at(i - 1)).norm() * 2 / (size[line[i - 1]] + size[line[i]]);
    std::vector<double> cost(n, std::numeric_limits<double>::infinity());
    std::vector<size_t> before(n, 0);
    cost[0] = 0;
    const bool closed = line.front() == line.back();
    constexpr size_t most_left_out = 256; // at a time: what was finer by more stays somewhat finer
    for (size_t j = 1; j < n; ++j) {
        progress.checkpoint(double(j) / double(n), "dividing the kept lines");
        for (size_t i = j; i-- > (j > most_left_out ? j - most_left_out : 0);) {
            const double length = std::max(along[j] - along[i], 1e-6);
            if (j > i + 1) {
                if (length > longest_chord || (closed && i == 0 && j + 1 == n))
                    break;
                bool near = true;
                for (size_t k = i + 1; k < j && near; ++k)
                    near = distance_to_chord(at(i), at(j), at(k)) <= sagitta[line[k]];
                if (!near)
                    continue;
            }
            const double ratio = std::log(length / std::max(1.0, std::round(length)));
            if (const double whole = cost[i] + ratio * ratio; whole < cost[j]) {
                cost[j] = whole;
                before[j] = i;
            }
        }
    }
    LineDivision result{std::vector<char>(n, 0), std::vector<int>(n - 1, 1)};
    result.keep[n - 1] = 1;
    for (size_t j = n - 1; j > 0; j = before[j]) {
        result.keep[before[j]] = 1;
        if (before[j] + 1 == j)
            result.pieces[j - 1] = std::max(1, int(std::lround(along[j] - along[j - 1])));
    }
    return result;
}

} // namespace spia
