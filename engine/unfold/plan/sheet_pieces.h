#pragma once
#include <vector>

#include "engine/unfold/plan/bends.h"
#include "engine/unfold/plan/turns.h"

namespace spia {

/// Faces that belong together: a region, or a network of bends that touch each other.
struct SheetPieces {
    std::vector<int> piece;      ///< #F
    std::vector<char> is_region; ///< #pieces
};

/// An edge that turns more is a fold of its own: it says nothing about how the faces beside it are
/// curved.
constexpr double fold = 0.9;

/// @param side mm, in which curvatures are counted
SheetPieces sheet_pieces(const SheetTurns& turns, double side, const BendLimits& limits);

} // namespace spia
