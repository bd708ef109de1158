#pragma once
#include <vector>

#include "engine/coons/quad_grid.h"
#include "engine/coons/untangle_elements.h"
#include "engine/core/progress.h"

namespace spia {

struct UntangleOptions {
    int most_steps = 100;      ///< Newton steps
    double area_weight = 0.05; ///< of the wanted cell areas against good cell shapes
    bool keep_spacing = false; ///< cells are wanted as wide as the border cells of their column and
                               ///< row are, not all alike
};

/// Moves the inner nodes of a planar grid until every cell turns the right way, and on to well
/// shaped cells; the nodes on the border stay. The four corner triangles of each cell are the
/// elements of untangle_elements(): cells as oblong as the sides are long, of equal area, are what
/// they would like to be. Once unfolded, a grid never folds again. Look at the result with
/// cell_quality(): a grid may be impossible to unfold.
void untangle(QuadGrid& planar, const std::vector<Pull>& pulls, const UntangleOptions& options = {},
              const Progress& progress = {});

} // namespace spia
