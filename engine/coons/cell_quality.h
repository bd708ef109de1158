#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/coons/quad_grid.h"

namespace spia {

/// What the cells of a planar grid are like.
struct CellQuality {
    int folded_cells = 0;           ///< cells that are not strictly convex
    int first_folded = -1;          ///< cell i + j * columns; -1 if none is
    int worst_cell = -1;            ///< likewise, the one with the least scaled Jacobian
    double min_scaled_jacobian = 0; ///< its value, the smallest sine of a corner's angle over all
                                    ///< cells; 1 in a grid of rectangles
};

/// Smallest sine of a corner's angle of each cell i + j * columns in the plane (z is not read): 1
/// in a rectangle, 0 or less where the edges to the next and to the previous node do not turn
/// counter-clockwise.
Eigen::VectorXd scaled_jacobians(const QuadGrid& planar);

/// Whether a cell is strictly convex and counter-clockwise: the triangles at its four corners are,
/// by exact arithmetic (orient2d()). Its bilinear map then has a positive determinant everywhere,
/// which is linear between those at the corners.
bool turns_left_everywhere(const std::array<Eigen::Vector2d, 4>& corner);

/// The cells i + j * columns that fold, rising: those that do not turn_left_everywhere(), and those
/// with a sine of a corner not above 1e-9: one of 180 degrees counts as folded, as does a node that
/// is no number.
std::vector<int> folded_cells(const QuadGrid& planar);

/// Looks at the four corners of each cell in the plane (z is not read).
CellQuality cell_quality(const QuadGrid& planar);

} // namespace spia
