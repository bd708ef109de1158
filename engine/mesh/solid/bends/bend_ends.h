#pragma once
#include <optional>

#include "engine/mesh/solid/bends/unrolled_bend.h"

namespace spia {

/// The triangles cut in two along the lines where flats and cylinder meet, and along the bend where
/// one would be a chord of too much of it. Those of a flat are called by one of the flat then,
/// those of the cylinder by one of that.
/// @returns nothing where an edge to the rest of the middle surface would have to be cut
std::optional<PlaneTriangles> cut_at_bend_ends(const MiddleOfSolid& part, const UnrolledBend& bend,
                                               PlaneTriangles triangles);

} // namespace spia
