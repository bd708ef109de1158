#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/solid/sides/sheet_sides.h"

namespace spia {

/// A place where sheet is thinner all over: the floor of a pocket or of a step that is so deep that
/// it is no part of a skin.
struct ThinFloor {
    std::vector<char> piece;         ///< per piece
    double area = 0;                 ///< mm2
    double thickness = 0;            ///< mm, that is left there
    PieceSide skin = PieceSide::one; ///< the side that it stands off
};

/// The largest one: faces across the thickness, as it seemed, that look at a skin straight on at
/// one distance, below the thickness.
/// @param known  per piece: others are not asked about, as walls of holes and countersinks
std::optional<ThinFloor> thin_floor(const SurfacePieces& pieces, const std::vector<Opposite>& places,
                                    const std::vector<PieceSide>& side, double thickness,
                                    const std::vector<char>& known);

} // namespace spia
