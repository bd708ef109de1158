#pragma once
#include <vector>

#include "engine/unfold/plan/turns.h"

namespace spia {

/// Takes from plane regions the faces that only lead to a bend: on a mesh that does not follow the
/// bend lines, they lie across them. @param most mm beside the plane in which most of a region
/// lies; @param region #F, -1 on bends
void give_borders(const TriMesh& part, const SheetTurns& turns, double most, int regions, std::vector<int>& region);

} // namespace spia
