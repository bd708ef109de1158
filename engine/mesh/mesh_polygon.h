#pragma once
#include <Eigen/Core>
#include <vector>

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

/// Triangles of the inside of a polygon with holes, between its points alone: each hole is joined
/// to what is around it by the shortest free line, then ears are cut; Delaunay throughout.
/// @param rings 2 by n each, n >= 3: the outline counter-clockwise, then the holes clockwise; their
/// points become the vertices of the mesh, in this order
/// @return without triangles if rings cross each other or themselves, or a hole is not inside
PlanarMesh triangulate_polygon(const std::vector<Eigen::Matrix2Xd>& rings);

} // namespace spia
