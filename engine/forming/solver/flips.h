#pragma once
#include <Eigen/Core>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Triangles of the blank with no or negative area, by an exact test (orient2d.h).
int flipped_triangles(const Eigen::Matrix3Xi& triangle, const Eigen::Matrix2Xd& X);

/// No triangle is flipped and none of the fans around the vertices winds round twice: jumps from
/// map to map may end in such a double cover, of which no energy finds the way out.
bool one_to_one_around_vertices(const TriMesh& part, const Eigen::Matrix2Xd& X);

} // namespace spia
