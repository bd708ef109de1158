#include "engine/coons/cell_quality.h"

#include <cmath>
#include <gtest/gtest.h>

namespace spia {

namespace {

QuadGrid unit_cells(int columns, int rows)
{
    QuadGrid grid{columns, rows, Eigen::Matrix3Xd::Zero(3, (columns + 1) * (rows + 1))};
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            grid.position.col(grid.node(i, j)) << i, j, 0;
    return grid;
}

} // namespace

TEST(CellQuality, ANodePulledOverItsNeighbourFoldsTheCellsItShould)
{
    QuadGrid grid = unit_cells(4, 3);
    EXPECT_EQ(cell_quality(grid).folded_cells, 0);
    EXPECT_EQ(cell_quality(grid).first_folded, -1);
    EXPECT_EQ(cell_quality(grid).min_scaled_jacobian, 1);
    // Node (2, 1) goes over node (3, 1): the two cells to its right turn over.
    grid.position.col(grid.node(2, 1)).x() = 3.5;
    EXPECT_EQ(cell_quality(grid).folded_cells, 2);
    EXPECT_EQ(cell_quality(grid).first_folded, 2);
    EXPECT_LT(cell_quality(grid).min_scaled_jacobian, 0);
}

TEST(CellQuality, ANonConvexAndAFlatCornerCountAsFolded)
{
    QuadGrid grid = unit_cells(1, 1);
    grid.position.col(3) << 0.5, 0.5, 0; // on the diagonal: a straight angle
    EXPECT_EQ(cell_quality(grid).folded_cells, 1);
    grid.position.col(3) << 0.3, 0.3, 0;
    EXPECT_EQ(cell_quality(grid).folded_cells, 1);
    grid.position.col(3) << 0.6, 0.6, 0;
    EXPECT_EQ(cell_quality(grid).folded_cells, 0);
}

TEST(CellQuality, TheScaledJacobianIsTheSineOfTheSharpestAngle)
{
    QuadGrid grid = unit_cells(3, 2);
    const double shear = std::tan(0.5); // angles pi / 2 -+ 0.5
    grid.position.row(0) += shear * grid.position.row(1);
    EXPECT_NEAR(cell_quality(grid).min_scaled_jacobian, std::cos(0.5), 1e-14);
}

} // namespace spia
