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

/// What the sizes ask for along a segment.
struct Run {
    std::vector<double> share = {0}, pieces = {0}; // of the way so far, and as many edges; both increase
};

Run run_along(const TriMesh& mesh, int a, int b, const SizeField& size)
{
    const double length = (mesh.position.col(b) - mesh.position.col(a)).norm();
    if (!size.grows_in_long_faces()) // in equal pieces of the mean of both ends
        return {{0, 1}, {0, 2 * length / (size.at_vertex(a) + size.at_vertex(b))}};
    constexpr double step = 0.5; // of an edge
    Run run;
    for (double done = 0; done < length;) {
        const double way = std::min(step * size.between(a, b, done / length), length - done);
        const double asked = size.between(a, b, (done + way / 2) / length);
        done = done + way < length ? done + way : length;
        run.share.push_back(done / length);
        run.pieces.push_back(run.pieces.back() + way / asked);
    }
    return run;
}

/// Shares of the way that divide it into as many pieces, each with as much of what is asked for.
std::vector<double> cuts_of(const Run& run, int pieces)
{
    std::vector<double> result;
    size_t i = 1;
    for (int k = 1; k < pieces; ++k) {
        const double wanted = run.pieces.back() * k / pieces;
        while (run.pieces[i] < wanted)
            ++i;
        const double within = (wanted - run.pieces[i - 1]) / (run.pieces[i] - run.pieces[i - 1]);
        result.push_back(run.share[i - 1] + within * (run.share[i] - run.share[i - 1]));
    }
    return result;
}

} // namespace

LineDivision divide_line(const TriMesh& mesh, const std::vector<int>& line, const SizeField& size,
                         const Eigen::VectorXd& sagitta, const Progress& progress)
{
    constexpr double longest_chord = 1.4; // of the size asked for
    const size_t n = line.size();
    const auto at = [&](size_t i) -> Eigen::Vector3d { return mesh.position.col(line[i]); };
    std::vector<double> along(n, 0); // in units of the size asked for
    for (size_t i = 1; i < n; ++i)
        along[i] = along[i - 1] + run_along(mesh, line[i - 1], line[i], size).pieces.back();
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
    LineDivision result{std::vector<char>(n, 0), std::vector<std::vector<double>>(n - 1)};
    result.keep[n - 1] = 1;
    for (size_t j = n - 1; j > 0; j = before[j]) {
        result.keep[before[j]] = 1;
        if (before[j] + 1 == j)
            result.cuts[j - 1] = cuts_of(run_along(mesh, line[j - 1], line[j], size),
                                         std::max(1, int(std::lround(along[j] - along[j - 1]))));
    }
    return result;
}

} // namespace spia
