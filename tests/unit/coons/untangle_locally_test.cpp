#include "engine/coons/untangle_locally.h"

#include <gtest/gtest.h>

#include "engine/coons/cell_quality.h"
#include "tests/support/seeded_random.h"

namespace spia {

namespace {

constexpr int columns = 14, rows = 11;
// far from the rectangles that untangle() wants
const Eigen::Vector2d along_row(6, 0.1), along_column(5, 1.2);

/// Parallelograms of one shape. Their inner nodes are moved at random, across their length by up to
/// a share of their height.
QuadGrid sheared_cells(double share)
{
    const double height = (along_row.x() * along_column.y() - along_row.y() * along_column.x()) / along_row.norm();
    shapes::SeededRandom random(7);
    QuadGrid grid;
    grid.columns = columns;
    grid.rows = rows;
    grid.position = Eigen::Matrix3Xd::Zero(3, grid.nodes());
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            grid.position.col(grid.node(i, j)).head<2>() = i * along_row + j * along_column;
            if (i > 0 && j > 0 && i < columns && j < rows)
                grid.position(1, grid.node(i, j)) += share * height * random.between(-1, 1);
        }
    return grid;
}

} // namespace

TEST(UntangleLocally, CellsThatFoldAreUnfoldedToTheMeanShapeOfTheOthers)
{
    const QuadGrid exact = sheared_cells(0);
    QuadGrid grid = sheared_cells(1);
    ASSERT_EQ(cell_quality(exact).folded_cells, 0);
    ASSERT_GT(cell_quality(grid).folded_cells, 20);
    const double before = (grid.position - exact.position).norm();
    untangle_locally(grid, 4);
    EXPECT_EQ(cell_quality(grid).folded_cells, 0);
    EXPECT_LT((grid.position - exact.position).norm(), 0.3 * before);
    for (int n = 0; n < grid.nodes(); ++n) {
        const int i = n % (columns + 1), j = n / (columns + 1);
        if (i == 0 || j == 0 || i == columns || j == rows) {
            EXPECT_EQ(grid.position.col(n), exact.position.col(n));
        }
    }
}

TEST(UntangleLocally, CellsFarFromAFoldStayToTheLastBit)
{
    QuadGrid grid = sheared_cells(0);
    const int folded = grid.node(columns - 2, rows - 2);
    grid.position.col(folded).head<2>() -= 1.3 * along_column;
    const QuadGrid before = grid;
    ASSERT_GT(cell_quality(grid).folded_cells, 0);
    untangle_locally(grid, 2);
    EXPECT_EQ(cell_quality(grid).folded_cells, 0);
    EXPECT_NE(grid.position.col(folded), before.position.col(folded));
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < 4; ++i)
            EXPECT_EQ(grid.position.col(grid.node(i, j)), before.position.col(grid.node(i, j)));
}

TEST(UntangleLocally, CellsOfOneShapeStayWhereTheyAre)
{
    const QuadGrid exact = sheared_cells(0);
    QuadGrid kept = exact;
    untangle_locally(kept, 4);
    EXPECT_LT((kept.position - exact.position).cwiseAbs().maxCoeff(), 1e-6);
}

} // namespace spia
