#include "engine/coons/cell_quality.h"

#include <algorithm>
#include <array>

namespace spia {

namespace {

constexpr double least_sine = 1e-9; // below it, rounding decides which way the corner turns

double sine(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
    const double lengths = a.norm() * b.norm();
    return lengths > 0 ? (a.x() * b.y() - a.y() * b.x()) / lengths : 0;
}

} // namespace

CellQuality cell_quality(const QuadGrid& planar)
{
    CellQuality quality;
    quality.min_scaled_jacobian = 1;
    for (int j = 0; j < planar.rows; ++j)
        for (int i = 0; i < planar.columns; ++i) {
            const std::array<int, 4> node = {planar.node(i, j), planar.node(i + 1, j), planar.node(i + 1, j + 1),
                                             planar.node(i, j + 1)};
            double smallest = 1;
            for (size_t k = 0; k < 4; ++k) {
                const Eigen::Vector2d here = planar.position.col(node[k]).head<2>();
                smallest = std::min(smallest, sine(planar.position.col(node[(k + 1) % 4]).head<2>() - here,
                                                   planar.position.col(node[(k + 3) % 4]).head<2>() - here));
            }
            quality.min_scaled_jacobian = std::min(quality.min_scaled_jacobian, smallest);
            if (smallest > least_sine)
                continue;
            if (quality.folded_cells++ == 0)
                quality.first_folded = i + j * planar.columns;
        }
    return quality;
}

} // namespace spia
