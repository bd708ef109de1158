#pragma once
#include "engine/mesh/solid/skin.h"

namespace spia {

/// Puts vertices of a middle surface of skin_of() where the known surfaces of its outer skin say
/// exactly (ThinSolidOptions::surface):
/// - those that lie on one cylinder onto the middle one. Along faces across the thickness that are
///   slanted against the bend, as
///   those of a hole through it, they were moved in the tangent plane;
/// - those of a slanted rim where a cylinder goes over into a plane or another cylinder
///   tangentially onto the line where it ends. Else the bend's
///   zone would have ends askew, and another angle on each side of a hole.
/// Triangles that turn over by that get other diagonals, see flip_folds().
void onto_surfaces(SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet, const ThinSolidOptions& options);

} // namespace spia
