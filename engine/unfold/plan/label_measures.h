#pragma once
#include <vector>

#include "engine/unfold/plan/turns.h"

namespace spia {

// Measures of numbered sets of faces. `number`: #F, the set of each face from 0 up to `count`;
// negative: in none

/// mm2, per number
std::vector<double> areas_of(const SheetTurns& turns, const std::vector<int>& number, size_t count);

/// New numbers from the largest down; equally large ones (to rounding) in the order of their first
/// face.
std::vector<int> by_area(const std::vector<double>& area);

/// The middle of the face that is nearest to the mean place, per number. mm
std::vector<Eigen::Vector3d> places(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& number,
                                    size_t count);

Eigen::Vector3d middle(const TriMesh& part, int face); ///< mm

} // namespace spia
