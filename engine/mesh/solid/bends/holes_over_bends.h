#pragma once
#include <vector>

#include "engine/mesh/solid/skin.h"
#include "engine/mesh/solid/stated_surface.h"

namespace spia {

/// Round holes through a bend that are about as wide as it: their rim meets the middle of the sheet
/// farther from the bend's ends than the outer skin, or nearer to them, and vertices of the bend's
/// cylinder belong on the flat beside it. They are put where the wall meets the middle surface, the
/// triangles around are made sound in the plane of the unrolled bend, and cut where flat and
/// cylinder meet. What is no round hole, or cannot be made sound, stays as it is.
/// @param middle  as onto_surfaces() leaves it; gets more vertices and triangles, called by those
/// that they lie beside
/// @param surface  per triangle of the solid
/// @returns the triangles of the solid that are walls of those holes, ascending: their border is as
/// round_border() makes it
std::vector<int> holes_over_bends(SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet,
                                  const std::vector<StatedSurface>& surface);

} // namespace spia
