#pragma once
#include <vector>

#include "engine/unfold/plan/bends.h"
#include "engine/unfold/plan/turns.h"

namespace spia {

struct Bands {
    std::vector<int> of; ///< #F, into bends; -1 on regions
    std::vector<Bend> bends;
};

/// The bands of faces between regions, measured. @param region #F, -1 on bends; @param least mm2
Bands find_bands(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& region, double least);

/// What is curved more within a region, but ends there or at the rim without a definite turn,
/// belongs to the region.
/// @returns whether there was any
bool give_dents(const Bands& bands, std::vector<int>& region);

/// Sharp edges between two regions that touch without a band.
std::vector<Bend> sharp_bends(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& region);

} // namespace spia
