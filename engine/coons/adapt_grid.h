#pragma once
#include "engine/coons/blank_search.h"
#include "engine/coons/grid.h"
#include "engine/coons/quad_grid.h"
#include "engine/core/progress.h"

namespace spia {

/// Moves the lines of a grid towards the places where the part bends across them, in bends and at
/// edges: of a line's neighbours the turn of the normal, the largest along it, deals out a share of
/// the lines (graded_lines()). Nodes stay on the grid's own lines, unless cells have to be
/// untangled; those of the border stay on the outline. Where there is no sound grid, half the share
/// is tried, and a quarter.
/// @param grid  sound
/// @param share  of the lines that go to bends, 0 to 1
/// @return false, and the grid as it was, if its cells would not be sound, or less than half as
/// good at the worst, or if nothing bends
///         (GridResult::no_bends)
bool grade_lines(const BlankSearch& blank, const BlankBoundary& boundary, double share, GridResult& grid,
                 const Progress& progress = {});

/// Moves the inner nodes of a sound grid towards cells with right angles and even sizes along each
/// line (the energy of untangle() with cells as wide as their ends on the border are). It stays
/// sound on the way, or stays as it was, also where its worst cell would be less than half as good,
/// or where it has no inner nodes.
/// @return whether the cells are evened out now
bool even_cells(const BlankSearch& blank, GridResult& grid, const Progress& progress = {});

} // namespace spia
