#include "engine/mesh/solid/holes/oblique_holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "engine/mesh/nearest_share.h"
#include "engine/mesh/solid/holes/sheet_walls.h"

namespace spia {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// The vertices of an edge, one after the other; nothing if it is not one closed row.
std::optional<std::vector<int>> row_of(const std::map<int, int>& edge)
{
    if (edge.size() < 3)
        return std::nullopt;
    std::vector<int> row{edge.begin()->first};
    while (true) {
        const auto next = edge.find(row.back());
        if (next == edge.end() || row.size() > edge.size())
            return std::nullopt;
        if (next->second == row.front())
            return row.size() == edge.size() ? std::optional(row) : std::nullopt;
        row.push_back(next->second);
    }
}

/// A closed row of points in a plane.
struct Polygon {
    Points point;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(), middle = Eigen::Vector3d::Zero(); ///< of its area
    double area = 0;                                                                    ///< mm2
    double out = 0; ///< mm, how far a point is from the plane at most
};
Polygon polygon(const TriMesh& solid, const std::vector<int>& row)
{
    Polygon result;
    for (const int v : row)
        result.point.push_back(solid.position.col(v));
    const Points& p = result.point;
    const auto corner = [&](size_t k) {
        return Eigen::Vector3d((p[k] - p[0]).cross(p[(k + 1) % p.size()] - p[0]) / 2);
    };
    for (size_t k = 0; k < p.size(); ++k)
        result.normal += corner(k);
    result.area = result.normal.norm();
    result.normal /= result.area;
    for (size_t k = 0; k < p.size(); ++k) {
        result.middle += corner(k).dot(result.normal) / result.area * (p[0] + p[k] + p[(k + 1) % p.size()]) / 3;
        result.out = std::max(result.out, std::abs((p[k] - p[0]).dot(result.normal)));
    }
    return result;
}

double distance_from(const Polygon& polygon, const Eigen::Vector3d& place)
{
    double least = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < polygon.point.size(); ++k) {
        const Eigen::Vector3d &a = polygon.point[k], way = polygon.point[(k + 1) % polygon.point.size()] - a;
        const double along = nearest_share(place, a, way);
        least = std::min(least, (a + along * way - place).norm());
    }
    return least;
}

/// The cylinder that all of some faces are stated to lie on; null if there is none.
const StatedSurface* cylinder_of(const std::vector<int>& faces, const std::vector<StatedSurface>& surface)
{
    if (surface.empty())
        return nullptr;
    const StatedSurface& first = surface[size_t(faces.front())];
    const bool all = std::ranges::all_of(faces, [&](int f) {
        return surface[size_t(f)].kind == StatedSurface::Kind::cylinder && same_cylinder(surface[size_t(f)], first);
    });
    return all ? &first : nullptr;
}

/// From each vertex of one to its own of the other, if they are as many and all ways are the same.
std::optional<Eigen::Vector3d> between_vertices(const Polygon& from, const Polygon& to, double same)
{
    const size_t count = from.point.size();
    if (to.point.size() != count)
        return std::nullopt;
    for (size_t shift = 0; shift < count; ++shift) { // their walls go round the other way
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        double off = 0;
        for (size_t k = 0; k < count; ++k)
            mean += (to.point[(shift + count - k) % count] - from.point[k]) / double(count);
        for (size_t k = 0; k < count; ++k)
            off = std::max(off, (to.point[(shift + count - k) % count] - from.point[k] - mean).norm());
        if (off <= same)
            return mean;
    }
    return std::nullopt;
}

/// Whether a wall is straight in a direction, but for facets whose corners are not opposite to each
/// other.
bool leads_along(const TriMesh& solid, const SheetWall& wall, const Eigen::Vector3d& way)
{
    constexpr double most = 0.3; // sine
    return std::ranges::all_of(wall.face, [&](int f) {
        const auto corner = [&](int k) { return solid.position.col(solid.triangle(k, f)); };
        const Eigen::Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        return std::abs(normal.dot(way)) <= most * normal.norm() * way.norm();
    });
}

/// Of the wall of an oblique hole in a flat; nothing if it is none.
std::optional<ObliqueHole> oblique_hole(const TriMesh& solid, const ThinSolid& sheet, const SheetWall& wall,
                                        const std::vector<StatedSurface>& surface)
{
    const auto outer = row_of(wall.outer.next), inner = row_of(wall.inner.next);
    if (!outer || !inner)
        return std::nullopt;
    const double t = sheet.thickness;
    constexpr double flat = 1e-4, same = 1e-3, askew = 1e-3; // of the thickness
    constexpr double alike = 0.03; // of the radius: chords of 0.35 radians are 0.015 within a circle
    const Polygon from = polygon(solid, *outer), to = polygon(solid, *inner);
    if (!(from.area > 0) || !(to.area > 0) || from.out > flat * t || to.out > flat * t)
        return std::nullopt;
    Eigen::Vector3d way = to.middle - from.middle;
    const double through = way.dot(from.normal);
    if (std::abs(std::abs(through) - t) > flat * t || (way - through * from.normal).norm() <= askew * t)
        return std::nullopt;
    if (const StatedSurface* cylinder = cylinder_of(wall.face, surface))
        way = through / cylinder->direction.dot(from.normal) * cylinder->direction;
    else if (const auto exact = between_vertices(from, to, same * t))
        way = *exact;
    else if (through * sheet.flipped > 0)
        return std::nullopt; // the border of the sheet: chamfered along one side it has another middle
    if (!leads_along(solid, wall, way))
        return std::nullopt; // chamfers, which may make both edges alike
    const double close = alike * std::sqrt(from.area / 3);
    if (!std::ranges::all_of(from.point, [&](const auto& p) { return distance_from(to, p + way) <= close; }))
        return std::nullopt;
    std::vector<int> rim = *outer;
    std::ranges::sort(rim);
    return ObliqueHole{std::move(rim), way / 2};
}

} // namespace

std::vector<ObliqueHole> oblique_holes(const TriMesh& solid, const ThinSolid& sheet,
                                       const std::vector<StatedSurface>& surface)
{
    std::vector<ObliqueHole> holes;
    for (const SheetWall& wall : sheet_walls(solid, sheet))
        if (auto hole = oblique_hole(solid, sheet, wall, surface))
            holes.push_back(std::move(*hole));
    return holes;
}

} // namespace spia
