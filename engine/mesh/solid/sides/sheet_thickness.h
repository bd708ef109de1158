#pragma once
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/solid/solid_in_pieces.h"

namespace spia {

/// The thickness between curved skins. Rays meet chords there, not the surfaces; vertices lie on
/// them, so the thickness is the distance of vertices that lie straight opposite to each other: of
/// those where the skins turn, if there are enough. Of flats that are folded without a radius those
/// lie on the mitre, farther apart than the flats are: there rays are right, as the ends of free
/// edges say.
/// @param by_rays mm, and what is returned where too few vertices lie so
/// @param marks  do not count
double between_vertices(const SolidInPieces&, double by_rays, const std::vector<SheetMark>& marks);

/// How far away the other skin is from a place of one.
struct LocalThickness {
    int face;
    double thickness, area; ///< mm, at most 10 times the sheet's; mm2
};

/// At the places where rays were sent, at most 60,000 of them.
std::vector<LocalThickness> local_thickness(const SolidInPieces&, double thickness, const Progress&);

} // namespace spia
