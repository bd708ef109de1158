#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/coons/quad_grid.h"
#include "engine/core/progress.h"

namespace spia {

/// Draws a node to a place, with weight / 2 times the squared distance over the cell size.
struct Pull {
    int node = -1;
    Eigen::Vector2d target;
    double weight = 1;
};

struct UntangleOptions {
    int most_steps = 100;      ///< Newton steps
    double area_weight = 0.05; ///< of equal cell areas against good cell shapes
};

/// Moves the inner nodes of a planar grid until every cell turns the right way, and on to well shaped cells; the nodes
/// on the border stay. Minimises the mean ratio of the four corner triangles of each cell, with the determinant D in
/// its denominator replaced by (D + sqrt(D^2 + eps^2)) / 2 while cells are folded and eps brought to zero [Garanzha et
/// al. 2021, Foldover-free maps in 50 lines of code], by projected Newton steps. Once unfolded, a grid never folds
/// again. Look at the result with cell_quality(): a grid may be impossible to unfold.
void untangle(QuadGrid& planar, const std::vector<Pull>& pulls, const UntangleOptions& options = {},
              const Progress& progress = {});

} // namespace spia
