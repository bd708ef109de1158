#include "engine/coons/blank_search.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/vectors.h"

namespace spia {

namespace {

using Eigen::Vector2d;

/// Whether one layer can explain all these faces at one point: they meet in a vertex, and it is
/// inside at most one.
bool one_layer(const std::vector<MeshPoint>& found, const Eigen::Matrix3Xi& triangle)
{
    constexpr double inside = 1e-6; // barycentric
    int strictly_inside = 0;
    for (const MeshPoint& place : found)
        strictly_inside += place.distance == 0 && place.barycentric.minCoeff() > inside;
    if (strictly_inside > 1)
        return false;
    for (int k = 0; k < 3; ++k) {
        const int shared = triangle(k, found[0].face);
        if (std::all_of(found.begin(), found.end(),
                        [&](const MeshPoint& place) { return (triangle.col(place.face).array() == shared).any(); }))
            return true;
    }
    return false;
}

std::vector<std::array<int, 3>> faces_across(const Eigen::Matrix3Xi& triangle)
{
    const std::vector<EdgeUse> edges = edge_uses(triangle);
    std::vector<std::array<int, 3>> across(size_t(triangle.cols()), {-1, -1, -1});
    for (size_t e = 0; e + 1 < edges.size(); ++e)
        if (edges[e].same_edge(edges[e + 1])) {
            across[size_t(edges[e].face)][size_t(edges[e].corner)] = edges[e + 1].face;
            across[size_t(edges[e + 1].face)][size_t(edges[e + 1].corner)] = edges[e].face;
        }
    return across;
}

/// Separating axes: the normal of the segment and the normals of the triangle's edges, the
/// segment's box by the way.
bool touches(const Vector2d& p, const Vector2d& q, const std::array<Vector2d, 3>& corner, double tolerance)
{
    const auto apart = [&](const Vector2d& axis) {
        const double s = axis.dot(p), t = axis.dot(q);
        const double a = axis.dot(corner[0]), b = axis.dot(corner[1]), c = axis.dot(corner[2]);
        const double gap = std::max(std::min({a, b, c}) - std::max(s, t), std::min(s, t) - std::max({a, b, c}));
        return gap > tolerance * axis.norm();
    };
    const Vector2d along = q - p;
    if (apart({1, 0}) || apart({0, 1}) || apart({-along.y(), along.x()}))
        return false;
    for (size_t k = 0; k < 3; ++k) {
        const Vector2d edge = corner[(k + 1) % 3] - corner[k];
        if (apart({-edge.y(), edge.x()}))
            return false;
    }
    return true;
}

} // namespace

BlankSearch::BlankSearch(const FilledMesh& filled)
    : filled_(filled), locator_(filled.plane, filled.mesh.triangle), across_(faces_across(filled.mesh.triangle))
{
    constexpr double flat = 1e-12; // doubled area over squared longest edge that rounding can give
                                   // a sliver
    const Eigen::Matrix3Xi& triangle = filled.mesh.triangle;
    for (int f = 0; f < triangle.cols() && !overlaps_; ++f) {
        const Vector2d a = filled.plane.col(triangle(0, f)), b = filled.plane.col(triangle(1, f)),
                       c = filled.plane.col(triangle(2, f));
        const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
        overlaps_ = cross(b - a, c - a) < -flat * longest;
    }
    // Where one layer lies on another, the border of the common region is made of pieces of the
    // outline.
    const size_t n = filled.outline.size();
    for (size_t i = 0; i < n && !overlaps_; ++i) {
        const Vector2d a = filled.plane.col(filled.outline[i]), b = filled.plane.col(filled.outline[(i + 1) % n]);
        overlaps_ = unique_place(a).face < 0 || unique_place((a + b) / 2).face < 0;
    }
}

Vector2d BlankSearch::position(const MeshPoint& place) const
{
    Vector2d position = Vector2d::Zero();
    for (int k = 0; k < 3; ++k)
        position += place.barycentric[k] * filled_.plane.col(filled_.mesh.triangle(k, place.face));
    return position;
}

MeshPoint BlankSearch::unique_place(const Vector2d& point) const
{
    const std::vector<MeshPoint> found = locator_.covering(point);
    if (found.empty() || !one_layer(found, filled_.mesh.triangle))
        return {};
    return *std::max_element(found.begin(), found.end(), [](const MeshPoint& a, const MeshPoint& b) {
        return a.barycentric.minCoeff() < b.barycentric.minCoeff();
    });
}

MeshPoint BlankSearch::place_next_to(const Vector2d& point, const std::vector<MeshPoint>& neighbours) const
{
    const std::vector<MeshPoint> found = locator_.covering(point);
    for (const MeshPoint& neighbour : neighbours)
        for (const MeshPoint& candidate : found)
            if (line_stays_inside(neighbour, candidate))
                return candidate;
    return {};
}

bool BlankSearch::line_stays_inside(const MeshPoint& from, const MeshPoint& to) const
{
    // Through the faces that the line touches: the two ends hang together if they do so within
    // these.
    const Vector2d p = position(from), q = position(to);
    std::vector<int> reached = {from.face};
    for (size_t i = 0; i < reached.size(); ++i) {
        if (reached[i] == to.face)
            return true;
        for (const int face : across_[size_t(reached[i])]) {
            if (face < 0 || std::find(reached.begin(), reached.end(), face) != reached.end())
                continue;
            const auto corner = [&](int k) -> Vector2d { return filled_.plane.col(filled_.mesh.triangle(k, face)); };
            if (touches(p, q, {corner(0), corner(1), corner(2)}, locator_.tolerance()))
                reached.push_back(face);
        }
    }
    return false;
}

} // namespace spia
