#include "engine/coons/untangle.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

#include "engine/coons/cell_quality.h"

namespace spia {

namespace {

QuadGrid rectangle_grid(int columns, int rows, double width, double height)
{
    QuadGrid grid{columns, rows, Eigen::Matrix3Xd::Zero(3, (columns + 1) * (rows + 1))};
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            grid.position.col(grid.node(i, j)) << width * i / columns, height * j / rows, 0;
    return grid;
}

} // namespace

TEST(Untangle, RandomNodesInARectangleBecomeTheUniformGrid)
{
    // Equal rectangles of the wanted shape are the minimum of the energy, so the way back is known.
    const QuadGrid uniform = rectangle_grid(20, 12, 30, 20);
    QuadGrid grid = uniform;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(0, 1);
    for (int j = 1; j < 12; ++j)
        for (int i = 1; i < 20; ++i)
            grid.position.col(grid.node(i, j)) << 30 * part(random), 20 * part(random), 0;
    ASSERT_GT(cell_quality(grid).folded_cells, 100);
    untangle(grid, {});
    EXPECT_EQ(cell_quality(grid).folded_cells, 0);
    EXPECT_LT((grid.position - uniform.position).cwiseAbs().maxCoeff(), 0.1); // cells are 1.5 wide
}

TEST(Untangle, APulledNodeComesNearItsTargetWithoutAFold)
{
    QuadGrid grid = rectangle_grid(10, 10, 10, 10);
    const int node = grid.node(5, 5);
    const Eigen::Vector2d target(8, 6.5);
    untangle(grid, {{node, target, 1e4}});
    EXPECT_EQ(cell_quality(grid).folded_cells, 0);
    EXPECT_LT((grid.position.col(node).head<2>() - target).norm(), 0.1);
}

TEST(Untangle, BorderNodesStay)
{
    QuadGrid grid = rectangle_grid(6, 6, 1, 1);
    grid.position.col(grid.node(3, 3)) << 2, 2, 0;
    const QuadGrid before = grid;
    untangle(grid, {});
    for (int k = 0; k <= 6; ++k)
        for (const int n : {grid.node(k, 0), grid.node(k, 6), grid.node(0, k), grid.node(6, k)})
            EXPECT_EQ(grid.position.col(n), before.position.col(n));
    EXPECT_EQ(cell_quality(grid).folded_cells, 0);
}

} // namespace spia
