#pragma once
#include <array>

#include "engine/coons/cell_quality.h"

namespace spia {

/// Column and row of the cell with the smallest scaled Jacobian.
inline std::array<int, 2> worst_cell(const QuadGrid& planar)
{
    int cell = 0;
    scaled_jacobians(planar).minCoeff(&cell);
    return {cell % planar.columns, cell / planar.columns};
}

} // namespace spia
