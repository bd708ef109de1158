#pragma once
#include <memory>

#include "engine/coons/grid.h"
#include "engine/layout/chords.h"
#include "engine/nurbs/blank_chart.h"

namespace spia {

struct PatchGridOptions {
    int cells = 16; ///< along a curve as long as a square patch of mean area is wide; 8 to 64 on
                    ///< every curve
};

/// The grid of one patch, on a mesh of its own of the region between its four sides.
struct PatchGrid {
    TriMesh region; ///< z = 0
    BlankBoundary boundary;
    GridResult grid;                         ///< no folded cell
    std::shared_ptr<const BlankChart> chart; ///< of it: (u, v) to the blank
};

/// One per patch of the layout; patches beside each other have as many cells along their common
/// side.
/// @throws InputError if a patch has no grid without folds; the message says where it is
std::vector<std::unique_ptr<const PatchGrid>> patch_grids(const Layout& layout, const Chords& chords,
                                                          const PatchGridOptions& options = {},
                                                          const Progress& progress = {});

} // namespace spia
