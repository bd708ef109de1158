#pragma once
#include <vector>

#include "engine/mesh/solid/sides/opposite.h"
#include "engine/mesh/solid/sides/surface_pieces.h"

namespace spia {

/// Where a piece of a solid of sheet lies: on one skin, on the other one, or across the thickness.
enum class PieceSide : char { one, other, rim };

struct SheetSides {
    std::vector<PieceSide> side;       ///< per piece
    double contradicted = 0;           ///< share of the skins' area that lies opposite to its own
                                       ///< side
    int where = -1;                    ///< of `places`, the first of the largest such spot; -1:
                                       ///< none
    std::vector<double> opposite_area; ///< per piece: its share that a face lies behind at about
                                       ///< the thickness, 0 to 1
};

/// Sorts the pieces, see thin_solid(). @param thickness mm
/// @param across_it  per piece: known to be of faces across the thickness, whatever lies opposite
/// to it (round_holes())
SheetSides sheet_sides(const SurfacePieces& pieces, const std::vector<Opposite>& places, double thickness,
                       const std::vector<char>& across_it);

} // namespace spia
