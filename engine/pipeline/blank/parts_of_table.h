#pragma once
#include <vector>

#include "engine/unfold/plan/bend_table.h"
#include "engine/unfold/plan/bends.h"

namespace spia {

/// Per bend of the map the one of the table that has most of its faces, else -1.
/// @param taken  set to which of the table have a bend of the map
std::vector<int> bends_in_table(const BendMap& map, const BendTable& table, std::vector<char>& taken);

/// Per bend of the map whether it is a part of what the table has as a whole one over a cylinder: a
/// piece between a hole and the side of a bend, an edge between its chords where a rim crosses
/// them, or one of narrow triangles between a bend and the rim of a hole beside it.
std::vector<char> parts_of_table(const TriMesh& part, const BendMap& map, const BendTable& table);

} // namespace spia
