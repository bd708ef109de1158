#pragma once
#include <vector>

#include "engine/mesh/solid/skin.h"

namespace spia {

/// Triangles of a middle surface that look the other way than those of the outer skin; on a known
/// cylinder seen unrolled.
/// @param outer  with the vertices and triangles of the middle surface
std::vector<int> turned_over(const TriMesh& outer, const SkinMesh& middle, const ThinSolidOptions& options);

/// Along slanted edges, of holes that were drilled through a bend askew, vertices of the middle
/// surface move aside, and can move farther than the triangles of a strip are broad. In most strips
/// the other diagonals do for both surfaces; both get them, within one CAD face, known cylinder or
/// smooth place.
/// @param outer  with the vertices and triangles of the middle surface
void flip_folds(TriMesh& outer, SkinMesh& middle, const ThinSolidOptions& options);

} // namespace spia
