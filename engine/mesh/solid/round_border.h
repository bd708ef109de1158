#pragma once
#include <vector>

#include "engine/mesh/solid/skin.h"
#include "engine/mesh/solid/stated_surface.h"

namespace spia {

/// The border of a middle surface that is cut by a cylinder, as a drilled hole or a rounded corner
/// is, where the sheet is plane or bent over a cylinder: its vertices are put where the cylinder
/// meets the middle of the sheet, and chords of more than 3 degrees are divided by vertices there.
/// A hole of 18 chords is 2 % too small, one of 120 chords 0.05 %.
/// @param middle  gets more vertices and triangles, each called by the number of one that it lies
/// beside
/// @param surface per triangle of the solid
/// @param done  triangles of the solid, ascending: walls whose border is so already
/// @returns how many chords were divided
int round_border(SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet,
                 const std::vector<StatedSurface>& surface, const std::vector<int>& done = {});

} // namespace spia
