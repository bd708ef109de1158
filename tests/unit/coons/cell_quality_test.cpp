#include "engine/coons/cell_quality.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

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
    EXPECT_EQ(folded_cells(grid), (std::vector{2, 6})); // in the rows below and above
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

TEST(CellQuality, ANodeThatIsNoNumberFoldsItsCells)
{
    QuadGrid grid = unit_cells(4, 3);
    grid.position(0, grid.node(2, 1)) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(cell_quality(grid).folded_cells, 4);
    grid.position(0, grid.node(2, 1)) = std::numeric_limits<double>::infinity();
    EXPECT_EQ(cell_quality(grid).folded_cells, 4);
}

TEST(CellQuality, TheOrientationOfACellIsExact)
{
    // A corner one rounding above, on and below the line between its neighbours; far from the
    // origin, where every difference of products in doubles is off by more than that.
    const double far = 1 << 20, up = std::nextafter(far + 1.0, 1e300), down = std::nextafter(far + 1.0, 0.0);
    const auto cell = [&](double y) {
        return std::array<Eigen::Vector2d, 4>{Eigen::Vector2d(far, far), Eigen::Vector2d(far + 1, y),
                                              Eigen::Vector2d(far + 2, far + 2), Eigen::Vector2d(far, far + 2)};
    };
    EXPECT_TRUE(turns_left_everywhere(cell(down)));
    EXPECT_FALSE(turns_left_everywhere(cell(far + 1)));
    EXPECT_FALSE(turns_left_everywhere(cell(up)));
}

TEST(CellQuality, TheScaledJacobianIsTheSineOfTheSharpestAngle)
{
    QuadGrid grid = unit_cells(3, 2);
    const double shear = std::tan(0.5); // angles pi / 2 -+ 0.5
    grid.position.row(0) += shear * grid.position.row(1);
    EXPECT_NEAR(cell_quality(grid).min_scaled_jacobian, std::cos(0.5), 1e-14);
}

TEST(CellQuality, TheWorstCellIsTheOneWithTheSharpestAngle)
{
    QuadGrid grid = unit_cells(4, 2);
    // of the last cell a corner is drawn in
    grid.position.col(grid.node(4, 2)).head<2>() << 3.6, 1.6;
    const CellQuality quality = cell_quality(grid);
    EXPECT_NEAR(quality.min_scaled_jacobian, 5. / 13, 1e-12);
    EXPECT_EQ(quality.worst_cell, 7);
    EXPECT_EQ(grid.column_and_row(quality.worst_cell), (std::array{3, 1}));
}

} // namespace spia
