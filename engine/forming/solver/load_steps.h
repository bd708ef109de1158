#pragma once
#include "engine/forming/solver/stages.h"

namespace spia {

/// solve_at_once(), and where that finds no equilibrium the forces of the tools from none on in
/// steps, as far as they go.
Eigen::Matrix2Xd solve(SolveContext& context, const Eigen::Matrix2Xd& X, SolveReport& report, const Progress& progress);

/// Adds to the reason how much of the forces is in the blank, if not all.
void add_share(SolveReport& report);

} // namespace spia
