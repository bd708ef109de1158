#pragma once
#include <vector>

#include "engine/mesh/sheet_sides.h"

namespace spia {

/// Floors of counterbores: plane rings at another level than their skin. A wall goes up from their outer circle to a circle on the skin,
/// another one down from their inner circle, coaxial cylinders both, and from there faces across the thickness reach
/// the other skin. Others are pockets, steps and bosses.
/// @param normal  per triangle its area vector, outwards
/// @param side  per piece
/// @param least  mm2; smaller ones are not looked for
/// @returns per piece, whether it is one or of its walls: of coarse meshes a wall may have been taken for skin
std::vector<char> counterbore_floors(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const SurfacePieces& pieces,
                                     const std::vector<PieceSide>& side, double thickness, double least);

} // namespace spia
