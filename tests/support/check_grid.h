#pragma once
#include <string>

#include "engine/coons/grid.h"
#include "tests/support/random_outlines.h"

namespace spia::shapes {

/// What is wrong with a planar grid of a blank, empty if nothing: every cell strictly convex and
/// counter-clockwise by exact arithmetic, every node where its triangle says, the corners on their
/// vertices, the other border nodes on edges of the outline and in its order.
std::string fault_of(const GridResult& grid, const BlankBoundary& boundary);

struct RandomGrid {
    std::string fault = {}; ///< as above; also what was thrown, unless
    bool refused = false;   ///< the blank was refused as one that winds too much
    std::vector<AttemptReport> attempts = {};
};

/// coons_grid() of an outline with default options.
RandomGrid random_grid(const RandomOutline& drawn);

} // namespace spia::shapes
