#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Closed rows of boundary vertices with the mesh on their left (outer loop counter-clockwise,
/// holes clockwise, seen from the outer side); the longest one by length comes first. Each starts
/// at its smallest vertex index.
std::vector<std::vector<int>> boundary_loops(const TriMesh& mesh);

/// Per vertex: the area-weighted mean of the normals of its faces, unit length (zero where they
/// cancel). 3 by #V
Eigen::Matrix3Xd vertex_normals(const TriMesh& mesh);

/// Per face: half the cross product of two edges; its length is the area in mm2. 3 by #F
Eigen::Matrix3Xd area_vectors(const TriMesh& mesh);

double area(const TriMesh& mesh);              ///< mm2
double bounding_diagonal(const TriMesh& mesh); ///< mm

} // namespace spia
