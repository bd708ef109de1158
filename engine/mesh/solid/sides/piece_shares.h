#pragma once
#include <vector>

#include "engine/mesh/solid/sides/opposite.h"
#include "engine/mesh/solid/sides/surface_pieces.h"

namespace spia {

/// What its opposite places say of each piece of a solid of sheet: shares of its area, 0 to 1.
struct PieceShares {
    std::vector<double> opposite; ///< opposite to another at about the thickness; 0 of what is
                                  ///< across the sheet: askew, low walls, roundings of the border
    std::vector<double> sloped;   ///< askew to the other side, by 20 to 44 degrees; 0 of bends
    std::vector<double> steep;    ///< by 20 to 60 degrees
    std::vector<char> low_wall;   ///< whether it is one, as around marks and steps
    std::vector<char> border;     ///< whether it is a wall or a strip of a rounding that goes over into one
};

constexpr double surely_skin = 0.8;    ///< opposite to another: it belongs to a skin
constexpr double mostly_sloped = 0.75; ///< of a piece; of sharp bends' outer sides a half

/// @param thickness mm
/// @param across_it  per piece: known to be of faces across the thickness, see sheet_sides()
PieceShares piece_shares(const SurfacePieces& pieces, const std::vector<Opposite>& places, double thickness,
                         const std::vector<char>& across_it);

/// Whether the place has a face turned against it at about the thickness: as at mitred edges and in
/// bends whose radii do not fit each other, too.
bool across(const Opposite& place, double thickness);

} // namespace spia
