#include "app/viewer/views/cell_jacobian.h"

#include <algorithm>
#include <array>

namespace spia::viewer {

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
                const Eigen::Vector2d a = planar.position.col(node[(k + 1) % 4]).head<2>() - here;
                const Eigen::Vector2d b = planar.position.col(node[(k + 3) % 4]).head<2>() - here;
                const double lengths = a.norm() * b.norm();
                smallest = std::min(smallest, lengths > 0 ? (a.x() * b.y() - a.y() * b.x()) / lengths : 0);
            }
            result[i + Eigen::Index(j) * planar.columns] = smallest;
        }
    return result;
}

} // namespace spia::viewer
