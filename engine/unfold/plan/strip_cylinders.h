#pragma once
#include <vector>

#include "engine/mesh/solid/fit/cylinder_fit.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Faces of a mesh that are chords of one cylinder.
struct StripCylinder {
    FittedCylinder cylinder;
    std::vector<int> face; ///< ascending
};

/// Finds where a tessellated cylinder is: plane strips side by side whose parallel edges lie on one
/// circle, at least two of them. Three or more edges lie on some circle anyway; it is the cylinder
/// that was tessellated if the sheet goes on tangentially from its last chords, which then turn by
/// half their own angle there, or if there are four and more strips as wide as each other. The size
/// of the cylinder does not matter.
/// @param normal      area_vectors() of the part
/// @param neighbour   face_neighbours() of its faces
/// @param tangential  only where the sheet goes on tangentially, however many strips there are
std::vector<StripCylinder> strip_cylinders(const TriMesh& part, const Eigen::Matrix3Xd& normal,
                                           const Eigen::Matrix3Xi& neighbour, bool tangential = false);

} // namespace spia
