#include "engine/mesh/solid/fit/plane_triangles.h"

#include <set>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/vectors.h"

namespace spia {
namespace {

/// Where a triangle is next to nothing or less, and is not with the other diagonal.
bool turn_diagonal(PlaneTriangles& mesh, const EdgeUse& one, const EdgeUse& other, std::set<EdgeKey>& edges)
{
    Triangle &s = mesh.triangle[size_t(one.face)].corner, &t = mesh.triangle[size_t(other.face)].corner;
    const auto k = size_t(one.corner);
    const int a = s[k], b = s[(k + 1) % 3], c = s[(k + 2) % 3], d = t[(size_t(other.corner) + 2) % 3];
    const Triangle first{a, d, c}, second{d, b, c};
    const double before = std::min(quality(mesh, s), quality(mesh, t)),
                 after = std::min(quality(mesh, first), quality(mesh, second));
    constexpr double thin = 0.02;   // of an angle's sine, about
    constexpr double better = 1e-9; // else rounding would turn it back and forth
    if (c == d || before > thin || after <= before + better || edges.contains(edge_key(c, d)))
        return false;
    s = first;
    t = second;
    edges.insert(edge_key(c, d));
    return true;
}

void turn_diagonals(PlaneTriangles& mesh)
{
    constexpr int rounds = 50;
    for (int round = 0; round < rounds; ++round) {
        std::vector<Triangle> corners;
        for (const PlaneTriangle& t : mesh.triangle)
            corners.push_back(t.corner);
        const std::vector<EdgeUse> uses = edge_uses(corners);
        std::vector<char> done(mesh.triangle.size(), 0);
        std::set<EdgeKey> edges;
        for (const EdgeUse& use : uses)
            edges.insert({use.low, use.high});
        bool any = false;
        for_each_edge(uses, [&](size_t begin, size_t end) {
            if (end == begin + 2 && !done[size_t(uses[begin].face)] && !done[size_t(uses[begin + 1].face)] &&
                turn_diagonal(mesh, uses[begin], uses[begin + 1], edges)) {
                done[size_t(uses[begin].face)] = done[size_t(uses[begin + 1].face)] = 1;
                any = true;
            }
        });
        if (!any)
            return;
    }
}

} // namespace

int PlaneTriangles::add(const Eigen::Vector2d& place, int like)
{
    at.push_back(place);
    source_vertex.push_back(source_vertex[size_t(like)]);
    return int(at.size()) - 1;
}

double area(const PlaneTriangles& mesh, const Triangle& t)
{
    const Eigen::Vector2d& a = mesh.at[size_t(t[0])];
    return mesh.way_round * cross(mesh.at[size_t(t[1])] - a, mesh.at[size_t(t[2])] - a) / 2;
}

double quality(const PlaneTriangles& mesh, const Triangle& t)
{
    double longest = 0;
    for (size_t k = 0; k < 3; ++k)
        longest = std::max(longest, (mesh.at[size_t(t[(k + 1) % 3])] - mesh.at[size_t(t[k])]).squaredNorm());
    return longest > 0 ? 2 * area(mesh, t) / longest : 0;
}

std::optional<PlaneTriangles> moved(PlaneTriangles mesh, const std::vector<Eigen::Vector2d>& to)
{
    for (const PlaneTriangle& t : mesh.triangle)
        for (const int v : t.corner)
            if (!to[size_t(v)].allFinite())
                return std::nullopt;
    const std::vector<Eigen::Vector2d> from = mesh.at;
    constexpr int steps = 64; // of about a thickness: less than chords of a rim are long
    for (int step = 1; step <= steps; ++step) {
        const double share = double(step) / steps;
        for (size_t v = 0; v < to.size(); ++v)
            mesh.at[v] = (1 - share) * from[v] + share * to[v];
        turn_diagonals(mesh);
    }
    if (!std::ranges::all_of(mesh.triangle, [&](const auto& t) { return area(mesh, t.corner) > 0; }))
        return std::nullopt;
    return mesh;
}

} // namespace spia
