#pragma once
#include "engine/coons/quad_grid.h"

namespace spia::viewer {

/// Smallest sine of a corner's angle of each cell in the plane: 1 in a rectangle, 0 or less where it folds. Cell
/// i + j * columns; the least of them is CellQuality::min_scaled_jacobian.
Eigen::VectorXd scaled_jacobians(const QuadGrid& planar);

} // namespace spia::viewer
