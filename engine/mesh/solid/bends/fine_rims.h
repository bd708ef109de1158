#pragma once
#include <vector>

#include "engine/mesh/solid/bends/bend_holes.h"

namespace spia {

/// The rims of holes with chords as round_border() has them. Triangles that would become too narrow
/// by that keep their chord.
/// @param triangles  of the bend, with the rims where the walls meet the middle of the sheet
PlaneTriangles with_fine_rims(const MiddleOfSolid& part, const UnrolledBend& bend, const std::vector<BendHole>& holes,
                              const PlaneTriangles& triangles);

} // namespace spia
