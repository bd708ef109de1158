#pragma once
#include "engine/coons/quad_grid.h"

namespace spia {

/// What the cells of a planar grid are like.
struct CellQuality {
    int folded_cells = 0;           ///< cells with a corner whose determinant is not positive
    int first_folded = -1;          ///< cell i + j * columns; -1 if none is
    double min_scaled_jacobian = 0; ///< smallest sine of a corner's angle over all cells; 1 in a grid of rectangles
};

/// Smallest sine of a corner's angle of each cell i + j * columns in the plane (z is not read): 1 in a rectangle, 0 or less
/// where the edges to the next and to the previous node do not turn counter-clockwise.
Eigen::VectorXd scaled_jacobians(const QuadGrid& planar);

/// Looks at the four corners of each cell in the plane (z is not read). A cell folds where the edges to the
/// next and to the previous node do not turn counter-clockwise; a corner of 180 degrees counts as folded.
CellQuality cell_quality(const QuadGrid& planar);

} // namespace spia
