#include "engine/layout/spokes.h"

#include <cmath>
#include <numbers>

#include "engine/core/small_sparse.h"
#include "engine/layout/plane_lines.h"
#include "engine/mesh/locate.h"
#include "engine/mesh/mesh_polygon.h"

namespace spia {
namespace {

/// Each edge in pieces that are short beside the whole; `at` gets where the given points have gone.
Eigen::Matrix2Xd refined(const Eigen::Matrix2Xd& polygon, std::vector<int>& at)
{
    const Eigen::Index n = polygon.cols();
    double length = 0;
    for (Eigen::Index i = 0; i < n; ++i)
        length += (polygon.col((i + 1) % n) - polygon.col(i)).norm();
    const double piece = length / 160;
    std::vector<Eigen::Vector2d> points;
    std::vector<int> gone(static_cast<size_t>(n));
    for (Eigen::Index i = 0; i < n; ++i) {
        gone[size_t(i)] = int(points.size());
        const Eigen::Vector2d from = polygon.col(i), to = polygon.col((i + 1) % n);
        const int pieces = std::max(1, int(std::ceil((to - from).norm() / piece)));
        for (int k = 0; k < pieces; ++k)
            points.push_back(from + (to - from) * (double(k) / pieces));
    }
    for (int& index : at)
        index = gone[size_t(index)];
    Eigen::Matrix2Xd result(2, Eigen::Index(points.size()));
    for (size_t i = 0; i < points.size(); ++i)
        result.col(Eigen::Index(i)) = points[i];
    return result;
}

/// Even by length between two starts.
Eigen::Matrix2Xd on_circle(const Eigen::Matrix2Xd& polygon, const std::vector<int>& start)
{
    const auto n = int(polygon.cols());
    Eigen::Matrix2Xd result(2, n);
    for (size_t k = 0; k < start.size(); ++k) {
        const int from = start[k], count = (start[(k + 1) % start.size()] - from + n) % n;
        std::vector<double> reached = {0};
        for (int i = 0; i < count; ++i)
            reached.push_back(reached.back() + (polygon.col((from + i + 1) % n) - polygon.col((from + i) % n)).norm());
        for (int i = 0; i < count; ++i) {
            const double angle =
                2 * std::numbers::pi * (double(k) + reached[size_t(i)] / reached.back()) / double(start.size());
            result.col((from + i) % n) << std::cos(angle), std::sin(angle);
        }
    }
    return result;
}

/// Inner vertices at weighted means of their neighbours: the nearer, the heavier.
Eigen::Matrix2Xd disc(const PlanarMesh& mesh, const Eigen::Matrix2Xd& border)
{
    const Eigen::Index all = mesh.position.cols(), fixed = border.cols(), free = all - fixed;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(free, 2);
    for (Eigen::Index f = 0; f < mesh.triangle.cols(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.triangle(k, f), b = mesh.triangle((k + 1) % 3, f);
            const double weight = 1 / std::max((mesh.position.col(a) - mesh.position.col(b)).norm(), 1e-300);
            for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
                if (i < fixed)
                    continue;
                entries.emplace_back(i - fixed, i - fixed, weight);
                if (j >= fixed)
                    entries.emplace_back(i - fixed, j - fixed, -weight);
                else
                    right.row(i - fixed) += weight * border.col(j).transpose();
            }
        }
    Eigen::Matrix2Xd result(2, all);
    result.leftCols(fixed) = border;
    if (free > 0) {
        Eigen::SparseMatrix<double> matrix(free, free);
        matrix.setFromTriplets(entries.begin(), entries.end());
        result.rightCols(free) = SparseLdlt(matrix).solve(right).transpose();
    }
    return result;
}

bool spokes_cross(const Spokes& spokes, const Eigen::Matrix2Xd& polygon)
{
    const Eigen::Index n = polygon.cols();
    for (size_t a = 0; a < spokes.line.size(); ++a) {
        const Eigen::Matrix2Xd& p = spokes.line[a];
        for (Eigen::Index i = 0; i + 1 < p.cols(); ++i) {
            for (Eigen::Index e = 0; e < n; ++e) {
                const Eigen::Vector2d from = polygon.col(e), to = polygon.col((e + 1) % n);
                const bool at_start = i == 0 && (from == p.col(0) || to == p.col(0));
                if (!at_start && segments_meet(p.col(i), p.col(i + 1), from, to))
                    return true;
            }
            for (size_t b = a + 1; b < spokes.line.size(); ++b)
                for (Eigen::Index j = 0; j + 1 < spokes.line[b].cols(); ++j) {
                    const bool at_centre = i + 2 == p.cols() && j + 2 == spokes.line[b].cols();
                    if (!at_centre &&
                        segments_meet(p.col(i), p.col(i + 1), spokes.line[b].col(j), spokes.line[b].col(j + 1)))
                        return true;
                }
        }
    }
    return false;
}

} // namespace

std::optional<Spokes> spokes(const Eigen::Matrix2Xd& polygon, const std::vector<int>& start)
{
    std::vector<int> at = start;
    const Eigen::Matrix2Xd fine = refined(polygon, at);
    const PlanarMesh mesh = mesh_polygon(fine);
    if (mesh.triangle.cols() == 0)
        return std::nullopt;
    const Eigen::Matrix2Xd image = disc(mesh, on_circle(fine, at));
    const PlanarLocator locator(image, mesh.triangle);
    const auto back = [&](const Eigen::Vector2d& place) -> Eigen::Vector2d {
        const MeshPoint found = locator.nearest(place);
        return mesh.position(Eigen::all, mesh.triangle.col(found.face)) * found.barycentric;
    };
    for (const int samples : {6, 12, 24, 48, 96}) { // as straight as it can be
        Spokes result;
        result.centre = back(Eigen::Vector2d::Zero());
        for (size_t k = 0; k < start.size(); ++k) {
            const double angle = 2 * std::numbers::pi * double(k) / double(start.size());
            const Eigen::Vector2d rim(std::cos(angle), std::sin(angle));
            Eigen::Matrix2Xd line(2, samples + 1);
            line.col(0) = polygon.col(start[k]);
            for (int i = 1; i < samples; ++i)
                line.col(i) = back(rim * (1 - double(i) / samples));
            line.col(samples) = result.centre;
            result.line.push_back(std::move(line));
        }
        if (!spokes_cross(result, polygon))
            return result;
    }
    return std::nullopt;
}

} // namespace spia
