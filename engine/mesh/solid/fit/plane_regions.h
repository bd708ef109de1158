#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A triangle and its edge from corner k on, with the one beyond it; -1: none.
struct FaceEdge {
    int face, k, next;
};

/// The planes that a solid consists of; each triangle is in one.
struct PlaneRegions {
    std::vector<int> of;        ///< per triangle, its plane
    Eigen::Matrix3Xd direction; ///< per plane, unit length, outwards
    Eigen::VectorXd level;      ///< per plane, mm: how far from the origin it is along its
                                ///< direction
};

/// Each triangle's plane is that of the largest one from which it can be reached in its plane.
/// @param normal  per triangle its area vector, outwards
/// @param neighbour  as face_neighbours() has it
/// @param within  mm, how far a triangle's corners may be off its plane
PlaneRegions plane_regions(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const Eigen::Matrix3Xi& neighbour,
                           double within);

/// The closed rows of edges that part a plane from others, per plane; those that touch others at a
/// vertex, or border on nothing, are left out.
std::vector<std::vector<std::vector<FaceEdge>>> borders_of(const PlaneRegions& planes, const TriMesh& solid,
                                                           const Eigen::Matrix3Xi& neighbour);

/// mm, from the longest side of a triangle to its third corner. @param normal  its area vector
double altitude(const TriMesh& mesh, int face, const Eigen::Vector3d& normal);

} // namespace spia
