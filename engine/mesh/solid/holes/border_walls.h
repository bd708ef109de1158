#pragma once
#include <Eigen/Core>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "engine/mesh/solid/off_axis.h"
#include "engine/mesh/solid/thin_solid.h"

namespace spia {

/// A plane or cylinder at a distance from a stated one.
struct Level {
    StatedSurface of;
    double at = 0; ///< mm along the plane's normal, or the radius

    /// mm beyond it
    double value(const Eigen::Vector3d& p) const
    {
        return (of.kind == StatedSurface::Kind::plane ? (p - of.point).dot(of.direction) : off_axis(of, p).norm()) - at;
    }
    Eigen::Vector3d normal(const Eigen::Vector3d& p) const
    {
        return of.kind == StatedSurface::Kind::plane ? of.direction : off_axis(of, p).normalized();
    }
};

/// The walls of the border of a solid's outer skin: for each of its edges the triangle across, or
/// where that is of a chamfer or a rounding around a cylinder, one of the cylinder beyond.
class BorderWalls {
public:
    /// @param surface  per triangle of the solid
    /// @param done  triangles of the solid, ascending, that do not count
    BorderWalls(const TriMesh& solid, const ThinSolid& sheet, const std::vector<StatedSurface>& surface,
                const std::vector<int>& done);

    /// The triangle of the solid beyond an edge between two of its vertices; -1: it is none of the
    /// border.
    int beyond(int a, int b) const;

    /// The cylinder with the axis of a stated one that a chord goes around, but for gaps.
    std::optional<Level> around(const StatedSurface& cylinder, const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b) const;

    /// Whether a triangle is of a cylinder across the sheet, with the normal `up`: no rounding
    /// along it.
    bool crosses(int wall, const Eigen::Vector3d& up) const;

    /// Whether the wall of a triangle, or what is beyond its chamfer, goes on from that of a
    /// cylinder without a corner at a place of the middle surface with the normal `up`.
    bool tangent(int cylinder, int wall, const Eigen::Vector3d& place, const Eigen::Vector3d& up) const;

    double gap() const { return gap_; } ///< mm, between CAD faces

private:
    const TriMesh& solid_;
    const std::vector<StatedSurface>& surface_;
    double gap_;
    std::map<std::pair<int, int>, int> wall_; ///< per edge

    std::optional<int> cylinder_beyond(const std::pair<int, int>& edge, int across, const ThinSolid& sheet,
                                       const Eigen::Matrix3Xi& next) const;
};

} // namespace spia
