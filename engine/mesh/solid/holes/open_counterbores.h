#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A counterbore whose circles a border, a bend or another hole cuts: there is an arc of each.
struct OpenCounterbore {
    std::vector<int> floor; ///< triangles, ascending
    std::vector<int> wall;  ///< triangles that stand around the floor, ascending
    Eigen::Vector3d place;  ///< mm, in the middle of the floor
};

/// Found by shape alone, before it is known what is a skin: plane floors that walls stand around
/// along an arc, and that end at an arc of another radius about the same axis, below which a wall
/// goes down square to them to the thickness. Whole ones are among them; shallow ones are marks.
/// @param normal  per triangle its area vector, outwards
/// @param thickness  mm, of the sheet, about
std::vector<OpenCounterbore> open_counterbores(const TriMesh& solid, const Eigen::Matrix3Xd& normal, double thickness);

} // namespace spia
