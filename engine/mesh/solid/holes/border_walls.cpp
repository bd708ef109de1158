#include "engine/mesh/solid/holes/border_walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/face_neighbours.h"

namespace spia {

using Kind = StatedSurface::Kind;

BorderWalls::BorderWalls(const TriMesh& solid, const ThinSolid& sheet, const std::vector<StatedSurface>& surface,
                         const std::vector<int>& done)
    : solid_(solid), surface_(surface), gap_(1e-3 * sheet.thickness)
{
    const std::vector<EdgeUse> uses = edge_uses(solid.triangle);
    const auto counts = [&](int f) { return !std::ranges::binary_search(done, f); };
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end != begin + 2)
            return;
        int one = uses[begin].face, other = uses[begin + 1].face;
        if (sheet.side[size_t(one)] != SheetSide::outer)
            std::swap(one, other);
        if (sheet.side[size_t(one)] == SheetSide::outer && sheet.side[size_t(other)] == SheetSide::rim && counts(other))
            wall_[{uses[begin].low, uses[begin].high}] = other;
    });
    const Eigen::Matrix3Xi next = face_neighbours(solid.triangles(), uses);
    for (auto& [edge, wall] : wall_)
        if (surface[size_t(wall)].kind == Kind::other)
            wall = cylinder_beyond(edge, wall, sheet, next).value_or(wall);
    std::erase_if(wall_, [&](const auto& each) { return !counts(each.second); });
}

int BorderWalls::beyond(int a, int b) const
{
    const auto found = wall_.find({std::min(a, b), std::max(a, b)});
    return found == wall_.end() ? -1 : found->second;
}

/// The nearest over faces of chamfers and roundings that goes around the edge.
/// @param across  a triangle of them, at the edge
std::optional<int> BorderWalls::cylinder_beyond(const std::pair<int, int>& edge, int across, const ThinSolid& sheet,
                                                const Eigen::Matrix3Xi& next) const
{
    constexpr size_t most = 1000; // triangles, of a rounding in many rows
    std::vector<int> reached{across};
    for (size_t i = 0; i < reached.size() && i < most; ++i)
        for (int k = 0; k < 3; ++k) {
            const int f = next(k, reached[i]);
            if (f < 0 || sheet.side[size_t(f)] != SheetSide::rim || std::ranges::find(reached, f) != reached.end())
                continue;
            const StatedSurface& s = surface_[size_t(f)];
            if (s.kind == Kind::other)
                reached.push_back(f);
            else if (s.kind == Kind::cylinder &&
                     around(s, solid_.position.col(edge.first), solid_.position.col(edge.second)))
                return f;
        }
    return std::nullopt;
}

std::optional<Level> BorderWalls::around(const StatedSurface& cylinder, const Eigen::Vector3d& a,
                                         const Eigen::Vector3d& b) const
{
    constexpr double along = 0.9; // cosine of 26 degrees: the rounding of a straight edge
    if (std::abs((b - a).dot(cylinder.direction)) > along * (b - a).norm())
        return std::nullopt;
    const double at = off_axis(cylinder, a).norm();
    return std::abs(off_axis(cylinder, b).norm() - at) < gap_ ? std::optional(Level{cylinder, at}) : std::nullopt;
}

bool BorderWalls::crosses(int wall, const Eigen::Vector3d& up) const
{
    constexpr double most_oblique = 0.5; // cosine of 60 degrees
    const StatedSurface& s = surface_[size_t(wall)];
    return s.kind == Kind::cylinder && std::abs(s.direction.dot(up)) > most_oblique;
}

bool BorderWalls::tangent(int cylinder, int wall, const Eigen::Vector3d& place, const Eigen::Vector3d& up) const
{
    constexpr double smooth = 1e-3; // radians; gaps between CAD faces
    const auto along_sheet = [&](int f) {
        const StatedSurface& s = surface_[size_t(f)];
        const Eigen::Matrix3d c = solid_.position(Eigen::all, solid_.triangle.col(f));
        const Eigen::Vector3d n =
            s.kind == Kind::cylinder ? off_axis(s, place) : (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0));
        return (n - n.dot(up) * up).normalized();
    };
    return along_sheet(cylinder).cross(along_sheet(wall)).norm() < smooth;
}

} // namespace spia
