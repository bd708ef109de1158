#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "engine/mesh/solid/stated_surface.h"

namespace spia {

/// The cylinder through places of a bend of which nothing is stated. @param normal of its
/// triangles, area vectors
/// @returns nothing where they do not turn, or a place is farther from it than `within`, mm
std::optional<StatedSurface> cylinder_through(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& normal,
                                              double within);

/// A bend and the plane skin beside it, unrolled: a cylinder, and up to two planes that touch it.
/// Along u it turns, v runs along the axis.
class UnrolledSkin {
public:
    /// Of surfaces as they are stated. @returns nothing where they are others than one cylinder and
    /// planes that touch it
    /// @param points  of what is to be unrolled @param within  mm, what places may be off
    static std::optional<UnrolledSkin> of(const std::vector<StatedSurface>& surfaces, const Eigen::Matrix3Xd& points,
                                          double within);

    /// Nothing if the place is farther from the surface than `within`.
    std::optional<Eigen::Vector2d> flat(const Eigen::Vector3d& place) const;
    Eigen::Vector3d in_space(const Eigen::Vector2d& flat) const;
    /// u of the lines where planes touch the cylinder.
    std::vector<double> seams() const;
    /// Radians that the surface turns between two places.
    double turn(double u, double to) const;
    /// -1 before the cylinder, 0 on it, 1 beyond it.
    int zone(double u) const;
    int zone_of(const StatedSurface& surface) const;

private:
    /// One that touches the cylinder, beyond the angle at which it does.
    struct Side {
        StatedSurface plane;
        double angle; ///< radians, from the x axis
    };
    UnrolledSkin(const StatedSurface& cylinder, const Eigen::Matrix3Xd& points, double within);
    double angle_of(const Eigen::Vector3d& place) const;
    Eigen::Vector3d out(double angle) const; ///< from the axis, unit length
    bool touch(const StatedSurface& plane, const Eigen::Matrix3Xd& points);

    StatedSurface cylinder_;
    double within_;
    Eigen::Vector3d x_, y_;                   ///< across the axis; angles are from x, at the middle
                                              ///< of the places
    std::array<std::optional<Side>, 2> side_; ///< before the cylinder and beyond it
};

} // namespace spia
