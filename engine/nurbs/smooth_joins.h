#pragma once
#include <numbers>

#include "engine/core/progress.h"
#include "engine/nurbs/multi_patch.h"

namespace spia {

struct SmoothJoinsOptions {
    double sharp = 10 * std::numbers::pi / 180; ///< radians: joins with a place of a greater angle
                                                ///< are edges of the part, and stay
    double tolerance = 0.1;                     ///< mm: how far control points may go is weighed by
                                                ///< it; moves are not bounded by it
    std::vector<char> kept = {};                ///< per patch, not 0: no control point of it moves;
                                                ///< empty: none is kept
    int most_steps = 8;
};

struct SmoothJoins {
    MultiPatch patches;
    double angle_before = 0, angle_after = 0; ///< radians, the greatest at the places that are no
                                              ///< edges
    int places = 0, edges = 0;                ///< of the joins at which they were measured, and how
                                              ///< many of these are edges
    double greatest_move = 0;                 ///< mm, of a control point
};

/// Takes the angle out of the joins of patches (G1), as far as control points on and beside the
/// shared sides can: the least squares of the angle between both patches, at twice as many places
/// of each span as it has functions, and, weighed far less, of the moves, by Gauss-Newton steps. A
/// place is smooth where the derivatives across the side, one into each patch, and the one along it
/// lie in a plane: det(A, B, T) = 0 [Farin, Curves and Surfaces for CAGD, 5th ed., 23.1]. Shared
/// sides stay shared to the last bit; ends of joins on the border of the whole stay where they are,
/// and only their neighbours on that border move.
/// @throws InputError if the patches are not watertight, have weights that are not 1, or `kept` is
/// not one entry per patch
SmoothJoins smooth_joins(const MultiPatch& patches, const SmoothJoinsOptions& options = {},
                         const Progress& progress = {});

} // namespace spia
