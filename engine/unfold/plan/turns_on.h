#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"
#include "engine/unfold/plan/bend_zones.h"

namespace spia {

/// Per zone of a mesh whether its bend is more than it: where it ends the sheet turns on, over
/// chords as broad as its own, or over another zone of the same cylinder, or leaves at another
/// angle than the zone ends. A bend ends in flats that touch its cylinder: their planes say how
/// much it turns.
/// @param rounding  mm, by how much corners may lie off their places
std::vector<char> turns_on(const TriMesh& part, const std::vector<BendZone>& zones, double rounding);

} // namespace spia
