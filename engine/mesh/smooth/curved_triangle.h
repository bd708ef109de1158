#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

namespace spia {

/// A cubic triangle. [Farin 1986]
struct CubicTriangle {
    Eigen::Matrix3d corner; ///< mm, columns
    /// mm, near[i] has in column j the point a third of the way from corner i to corner j; its own
    /// column i is not used.
    std::array<Eigen::Matrix3d, 3> near = {};

    /// Its place at barycentric coordinates, with the point in its middle as Vlachos et al. 2001
    /// put it: as a quadratic triangle with these edges has it.
    Eigen::Vector3d at(const Eigen::Vector3d& barycentric) const;
};

/// mm, a third of the way from a place with a normal towards another, in the tangent plane there.
Eigen::Vector3d third_of_way(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& normal);

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
