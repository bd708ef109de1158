#include "engine/mesh/doctor/small_openings.h"

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <utility>

#include "engine/mesh/doctor/least_triangulation.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using Edge = std::pair<int, int>;

double area_of(const TriMesh& mesh, int a, int b, int c)
{
    const Eigen::Vector3d p = mesh.position.col(a);
    return (mesh.position.col(b) - p).cross(mesh.position.col(c) - p).norm() / 2;
}

/// Triangles between the vertices of a closed row that have the least area together; the cost is
/// that area.
/// @param used  edges of the surface from the smaller vertex to the larger: no inner edge of the
/// cover may be one
Triangulation least_cover(const TriMesh& mesh, const std::vector<int>& row, const std::map<Edge, int>& used)
{
    return least_triangulation(
        row.size(), 0, [&](size_t i, size_t j) { return !used.contains(std::minmax(row[i], row[j])); },
        [&](size_t i, size_t k, size_t j) { return area_of(mesh, row[i], row[k], row[j]); },
        [](double a, double b, double c) { return a + b + c; });
}

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
        const Triangulation least = least_cover(surface, row, used);
        result.width.push_back(2 * least.cost / perimeter(surface, loop));
        if (loop.size() > 3) // a triangle is one that is missing, however large
            covered += least.cost;
        const bool wide = loop.size() > 3 && result.width.back() > slit * bounding_diagonal(surface);
        if (covered > of_surface * area(surface) || (wide && loop.size() > few))
            return std::nullopt;
        result.surely &= !wide;
        for (const auto& triangle : least.triangles) {
            result.mesh.triangle.conservativeResize(3, result.mesh.triangles() + 1);
            for (int k = 0; k < 3; ++k)
                result.mesh.triangle(k, result.mesh.triangles() - 1) = row[size_t(triangle[size_t(k)])];
            result.beside.push_back(used.at(std::minmax(loop[0], loop[1])));
        }
    }
    return result;
}

} // namespace spia
