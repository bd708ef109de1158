#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/solid/marks/refilled_mark.h"

namespace spia {

/// Closes a bend over a mark, see refilled_mark(): the polygon is split where plane skin goes over
/// into the cylinder, and gets vertices on that where its triangles would turn by more than 3
/// degrees and more than the edges of the polygon do.
/// @param loop  vertices of the solid around the mark
/// @param beside  triangles of the skin along it
/// @returns nothing where that is neither
std::optional<RefilledMark> refilled_bend(const MarkedSkin& marked, const std::vector<int>& loop,
                                          const std::vector<int>& beside);

} // namespace spia
