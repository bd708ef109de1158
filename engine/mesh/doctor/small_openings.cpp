#include "engine/mesh/doctor/small_openings.h"

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using Edge = std::pair<int, int>;

constexpr double infinite = std::numeric_limits<double>::infinity();

double area_of(const TriMesh& mesh, int a, int b, int c)
{
    const Eigen::Vector3d p = mesh.position.col(a);
    return (mesh.position.col(b) - p).cross(mesh.position.col(c) - p).norm() / 2;
}

/// Triangles between the vertices of a closed row that have the least area together.
class LeastCover {
public:
    /// @param used  edges of the surface from the smaller vertex to the larger: no inner edge of the cover may be one
    LeastCover(const TriMesh& mesh, const std::vector<int>& row, const std::map<Edge, int>& used)
        : row_(row), count_(row.size()), best_(count_ * count_, 0), middle_(count_ * count_, 0)
    {
        for (size_t span = 2; span < count_; ++span)
            for (size_t i = 0; i + span < count_; ++i) {
                const size_t j = i + span;
                double& least = best_[i * count_ + j] = infinite;
                if (span + 1 < count_ && used.contains(std::minmax(row[i], row[j])))
                    continue;
                for (size_t k = i + 1; k < j; ++k) {
                    const double with =
                        best_[i * count_ + k] + best_[k * count_ + j] + area_of(mesh, row[i], row[k], row[j]);
                    if (with < least) {
                        least = with;
                        middle_[i * count_ + j] = k;
                    }
                }
            }
    }

    double area() const { return best_[count_ - 1]; } ///< mm2; infinite: there is none

    /// In the direction of the row.
    std::vector<std::array<int, 3>> triangles() const
    {
        std::vector<std::array<int, 3>> result;
        std::vector<std::pair<size_t, size_t>> open{{0, count_ - 1}};
        while (!open.empty()) {
            const auto [i, j] = open.back();
            open.pop_back();
            if (j < i + 2)
                continue;
            const size_t k = middle_[i * count_ + j];
            result.push_back({row_[i], row_[k], row_[j]});
            open.emplace_back(i, k);
            open.emplace_back(k, j);
        }
        return result;
    }

private:
    const std::vector<int>& row_;
    size_t count_;
    std::vector<double> best_;   ///< mm2, from a vertex to a later one
    std::vector<size_t> middle_; ///< the third vertex of the triangle there
};

/// Every edge of the surface, from its smaller vertex, with a face beside it.
std::map<Edge, int> edges_of(const TriMesh& surface)
{
    std::map<Edge, int> face;
    for (int f = 0; f < surface.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            face[std::minmax(surface.triangle(k, f), surface.triangle((k + 1) % 3, f))] = f;
    return face;
}

double perimeter(const TriMesh& mesh, const std::vector<int>& loop)
{
    double sum = 0;
    for (size_t i = 0; i < loop.size(); ++i)
        sum += (mesh.position.col(loop[(i + 1) % loop.size()]) - mesh.position.col(loop[i])).norm();
    return sum;
}

} // namespace

std::optional<CoveredOpenings> cover_small_openings(const TriMesh& surface)
{
    constexpr size_t few = 5, most = 200;            // edges around three triangles that are missing; the time is cubic
    constexpr double slit = 1e-3, of_surface = 0.05; // of the diagonal; of the area
    CoveredOpenings result{surface, {}, boundary_loops(surface), {}, true};
    if (result.loop.empty() || result.loop.front().size() > most) // the longest, as a sheet has
        return std::nullopt;
    const std::map<Edge, int> used = edges_of(surface);
    double covered = 0;
    for (const std::vector<int>& loop : result.loop) {
        if (loop.size() > most)
            return std::nullopt;
        const std::vector<int> row(loop.rbegin(), loop.rend()); // the surface is on the left of the loop
        const LeastCover least(surface, row, used);
        result.width.push_back(2 * least.area() / perimeter(surface, loop));
        if (loop.size() > 3) // a triangle is one that is missing, however large
            covered += least.area();
        const bool wide = loop.size() > 3 && result.width.back() > slit * bounding_diagonal(surface);
        if (covered > of_surface * area(surface) || (wide && loop.size() > few))
            return std::nullopt;
        result.surely &= !wide;
        for (const auto& triangle : least.triangles()) {
            result.mesh.triangle.conservativeResize(3, result.mesh.triangles() + 1);
            result.mesh.triangle.rightCols(1) << triangle[0], triangle[1], triangle[2];
            result.beside.push_back(used.at(std::minmax(loop[0], loop[1])));
        }
    }
    return result;
}

} // namespace spia
