#pragma once
#include <Eigen/Core>
#include <optional>

namespace spia {

/// A triangle whose corners lie on a smooth surface that bulges over it, and whose normals are
/// known there.
struct CurvedTriangle {
    Eigen::Matrix3d corner; ///< mm, columns
    Eigen::Matrix3d normal; ///< of the surface at the corners, unit length, all to one side

    /// Where the surface lies over a place of the triangle, told by its barycentric coordinates:
    /// exact at the corners, off by the fourth power of an edge elsewhere. [Vlachos et al. 2001,
    /// curved PN triangles]
    Eigen::Vector3d on_surface(const Eigen::Vector3d& barycentric) const;

    /// mm, the triangle in a plane, counter-clockwise, its edges as long as the surface is over
    /// them, of a circular arc exactly; where the surface curves both ways all alike longer or
    /// shorter, as its area asks.
    /// @returns nothing where the surface is not curved, or turns too far over an edge to be told
    /// by its ends
    std::optional<Eigen::Matrix<double, 2, 3>> laid() const;
};

} // namespace spia
