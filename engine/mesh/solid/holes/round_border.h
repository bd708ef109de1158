#pragma once
#include <vector>

#include "engine/mesh/solid/skin.h"
#include "engine/mesh/solid/stated_surface.h"

namespace spia {

/// Radians, of a chord of a border. Chords of angle a take a^2/6 of the area of a circle; around a
/// large one that is to be next to nothing of the sheet, 5e-5, around a small one of itself: 3
/// degrees.
/// @param radius mm @param area mm2, of the sheet
double fine_turn(double radius, double area);

/// The border of a middle surface that is cut by a cylinder, as a drilled hole or a rounded corner
/// is, where the sheet is plane or bent over a cylinder: its vertices are put where the cylinder
/// meets the middle of the sheet, and chords of more than 3 degrees are divided by vertices there,
/// finer ones where they would take more than 5e-5 of the sheet's area: a round blank of 120 chords
/// is 0.05 % too small, as a hole is.
/// @param middle  gets more vertices and triangles, each called by the number of one that it lies
/// beside
/// @param surface per triangle of the solid
/// @param done  triangles of the solid, ascending: walls whose border is so already
/// @returns how many chords were divided
int round_border(SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet,
                 const std::vector<StatedSurface>& surface, const std::vector<int>& done = {});

} // namespace spia
