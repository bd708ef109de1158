#include "engine/mesh/solid/bends/fine_rims.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/mesh/solid/off_axis.h"

namespace spia {
namespace {

/// Divides a triangle whose side from corner k on is a chord of a hole's rim.
/// @returns false where the wall does not meet the middle of the sheet between
bool divide(const MiddleOfSolid& part, const UnrolledBend& bend, const StatedSurface& wall, const PlaneTriangle& t,
            size_t k, PlaneTriangles& into)
{
    const int a = t.corner[k], b = t.corner[(k + 1) % 3], c = t.corner[(k + 2) % 3];
    const Eigen::Vector3d from = bend.skin.in_space(into.at[size_t(a)]), to = bend.skin.in_space(into.at[size_t(b)]),
                          u = off_axis(wall, from), v = off_axis(wall, to);
    const double angle = std::atan2(u.cross(v).dot(wall.direction), u.dot(v));
    constexpr double finest = 3 * std::numbers::pi / 180;
    const int pieces = std::max(1, int(std::ceil(std::abs(angle) / finest - 1e-6)));
    int last = a;
    for (int i = 1; i < pieces; ++i) {
        const double share = double(i) / pieces;
        const Eigen::Vector3d out = Eigen::AngleAxisd(share * angle, wall.direction) * u.normalized() * wall.radius;
        const Eigen::Vector3d axis =
            wall.point + ((1 - share) * from + share * to - wall.point).dot(wall.direction) * wall.direction;
        const auto place = where_wall_meets(part, bend, wall, axis + out);
        if (!place)
            return false;
        const int now = into.add(*place, a);
        into.triangle.push_back({{last, now, c}, t.source});
        last = now;
    }
    into.triangle.push_back({{last, b, c}, t.source});
    return true;
}

} // namespace

PlaneTriangles with_fine_rims(const MiddleOfSolid& part, const UnrolledBend& bend, const std::vector<BendHole>& holes,
                              const PlaneTriangles& triangles)
{
    std::map<EdgeKey, const BendHole*> hole_at; // per edge of a rim
    for (const BendHole& hole : holes)
        for (size_t i = 0; i < hole.rim.size(); ++i)
            hole_at[edge_key(hole.rim[i], hole.rim[(i + 1) % hole.rim.size()])] = &hole;
    constexpr double least = 1e-4; // of the height over the longest edge: the doctor calls 1e-6 no
                                   // area
    PlaneTriangles result = triangles;
    result.triangle.clear();
    for (const PlaneTriangle& t : triangles.triangle) {
        size_t k = 0;
        while (k < 3 && !hole_at.contains(edge_key(t.corner[k], t.corner[(k + 1) % 3])))
            ++k;
        const size_t begin = result.triangle.size(), vertices = result.at.size();
        const bool divided =
            k < 3 && divide(part, bend, hole_at.at(edge_key(t.corner[k], t.corner[(k + 1) % 3]))->wall, t, k, result) &&
            std::all_of(result.triangle.begin() + long(begin), result.triangle.end(),
                        [&](const PlaneTriangle& q) { return quality(result, q.corner) > least; });
        if (!divided) {
            result.triangle.resize(begin);
            result.at.resize(vertices);
            result.source_vertex.resize(vertices);
            result.triangle.push_back(t);
        }
    }
    return result;
}

} // namespace spia
