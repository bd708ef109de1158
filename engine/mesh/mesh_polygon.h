#pragma once
#include <Eigen/Core>

namespace spia {

/// A triangle mesh in the plane.
struct PlanarMesh {
    Eigen::Matrix2Xd position; ///< 2 by #V
    Eigen::Matrix3Xi triangle; ///< 3 by #F, counter-clockwise
};

/// Meshes the inside of a polygon without moving or adding a vertex on its edge: ear clipping, then
/// points inside whose spacing follows the edges around them and grows by a quarter from ring to
/// ring, Delaunay throughout.
/// @param outline 2 by n, n >= 3, counter-clockwise; its points become the first n vertices of the
/// mesh
/// @return without triangles if the outline crosses itself, runs clockwise or has no area
PlanarMesh mesh_polygon(const Eigen::Matrix2Xd& outline);

} // namespace spia
