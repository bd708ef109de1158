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

Eigen::VectorXd scaled_jacobians(const QuadGrid& planar)
{
    Eigen::VectorXd result(Eigen::Index(planar.columns) * planar.rows);
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
            result[i + Eigen::Index(j) * planar.columns] = smallest;
        }
    return result;
}

CellQuality cell_quality(const QuadGrid& planar)
{
    const Eigen::VectorXd jacobian = scaled_jacobians(planar);
    CellQuality quality;
    quality.min_scaled_jacobian = jacobian.size() > 0 ? jacobian.minCoeff() : 1;
    for (int cell = 0; cell < jacobian.size(); ++cell)
        if (jacobian[cell] <= least_sine && quality.folded_cells++ == 0)
            quality.first_folded = cell;
    return quality;
}

} // namespace spia
