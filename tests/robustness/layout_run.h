#pragma once
#include <string>

#include "engine/layout/fit_patches.h"
#include "tests/support/random_outlines.h"

namespace spia {

struct LayoutRun {
    std::string fault; ///< what is wrong with the patches, or why there are none; empty: nothing
    int patches = 0;
    bool split = false;                  ///< every face was divided, see Layout
    bool reached = false;                ///< within the tolerance everywhere
    std::vector<AttemptReport> attempts; ///< at the patches
};

/// blank_patches() of a plate with default options, within 1/1000 of its diagonal. Checked without
/// them: as many loops of border as the plate has, every inner curve of two patches and every outer
/// one of one, areas that add up to the plate's, control points of shared sides equal to the last
/// bit, every patch proved to have no fold.
LayoutRun run_layout(const shapes::RandomOutline& drawn);

} // namespace spia
