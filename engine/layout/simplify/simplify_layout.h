#pragma once
#include <cstdint>

#include "engine/core/progress.h"
#include "engine/layout/layout.h"

namespace spia {

/// Scaled Jacobian that analysis asks of a patch at the least: the sine of 11.5 degrees between its
/// parameter lines (shared aim of layouts and of the program's choice of a surface).
inline constexpr double well_shaped_jacobian = 0.2;

struct SimplifyOptions {
    double corner_deg = 50;                      ///< turn of the border from which on a vertex stays where it is
    double corner_radius = 1e30;                 ///< mm: not where the border is rounded by more
    double least_quality = well_shaped_jacobian; ///< below which no patch may come by a change
    bool refine = false;                         ///< every face of the start is divided into four first
    double effort = 1;                           ///< how long to search, over the usual
    std::uint64_t seed = 1;                      ///< of the order in which changes are tried
};

/// Takes patches away from a layout: diagonals and whole strips of patches shrink and sides turn
/// where that lowers an energy that counts patches and their shape, at first now and then where it
/// does not [simulated annealing]; what is left moves to where it has the best shape. Lines within
/// the sheet become straight but for kept ones; vertices slide along the border and along kept
/// lines; corners, and ends and junctions of kept lines, stay. Border and kept lines are the same,
/// the patches cover the same area, and every hole keeps three vertices. The search is counted in
/// steps: the same input gives the same bits. Of [Daniels et al. 2008; Tarini et al. 2010], who
/// simplify closed meshes, are the operations; energy, guard and border are for blanks.
/// @returns the start itself if it cannot be made simpler
Layout simplify_layout(const Layout& start, const SimplifyOptions& options = {}, const Progress& progress = {});

} // namespace spia
