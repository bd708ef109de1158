#include "engine/nurbs/blank_chart.h"

#include <cmath>
#include <gtest/gtest.h>

#include "engine/coons/boundary.h"
#include "engine/coons/lift.h"
#include "engine/core/error.h"
#include "tests/support/shapes.h"

namespace spia {

namespace {

/// A flat sheet whose sides are waves, meshed finely; the part is its blank with a height.
struct Waves {
    TriMesh part;
    Blank blank;
    BlankBoundary boundary;

    explicit Waves(double amplitude, double length = 0.11)
    {
        const int n = 120;
        part = shapes::rectangle(1, 1, n, n);
        std::array<int, 4> corners{};
        for (int k = 0; k < part.vertices(); ++k) {
            const double s = part.position(0, k), t = part.position(1, k);
            const Eigen::Vector2d corner[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            for (size_t c = 0; c < 4; ++c)
                if ((Eigen::Vector2d(s, t) - corner[c]).norm() < 1e-9)
                    corners[c] = k;
            const double x = 100 * s + amplitude * std::sin(2 * t / length) * (1 - 2 * s);
            const double y = 100 * t + amplitude * std::sin(2 * s / length) * (1 - 2 * t);
            part.position.col(k) << x, y, 10 * std::sin(x / 20);
        }
        blank.position = part.position.topRows<2>();
        boundary = split_boundary(blank, part, corners);
    }
};

std::vector<double> lines(int cells)
{
    std::vector<double> t;
    for (int i = 0; i <= cells; ++i)
        t.push_back(double(i) / cells);
    return t;
}

} // namespace

TEST(BlankChart, GivesTheNodesOfItsGridAndABorderOnTheOutline)
{
    const Waves sheet(1.5);
    GridOptions options;
    options.columns = 16;
    options.rows = 12;
    const GridResult grid = coons_grid(sheet.part, sheet.blank, sheet.boundary, options);
    const BlankChart chart(grid, sheet.boundary);
    const GridResult same = chart.refined(lines(16), lines(12));
    EXPECT_LT((same.planar.position - grid.planar.position).cwiseAbs().maxCoeff(), 1e-10);

    const GridResult fine = chart.refined(lines(160), lines(96));
    EXPECT_EQ(fine.quality.folded_cells, 0);
    EXPECT_EQ(fine.nodes_outside, 0);
    const LiftResult lifted = lift(fine);
    for (int j = 0; j <= 96; ++j)
        for (int i = 0; i <= 160; ++i) {
            const int node = fine.planar.node(i, j);
            const Eigen::Vector3d p = lifted.lifted.position.col(node);
            // The node lies on the part over its place in the plane ...
            EXPECT_LT((p.head<2>() - fine.planar.position.col(node).head<2>()).norm(), 1e-9);
            // ... and a border node on an edge of the outline: it has no share of the third vertex.
            if (i == 0 || j == 0 || i == 160 || j == 96) {
                EXPECT_EQ(fine.place[size_t(node)].barycentric.minCoeff(), 0);
            }
        }
}

TEST(BlankChart, LinesNextToTheBorderFollowTheOutlineBetweenTheNodes)
{
    // Eight nodes a side are too few for the waves: the map through them alone would leave the
    // outline by a millimetre.
    const Waves sheet(1.5, 0.05);
    GridOptions options;
    options.columns = options.rows = 8;
    const GridResult grid = coons_grid(sheet.part, sheet.blank, sheet.boundary, options);
    const BlankChart chart(grid, sheet.boundary);
    std::vector<double> v = lines(8);
    v.insert(v.begin() + 1, 1e-4);
    const GridResult fine = chart.refined(lines(128), v);
    for (int i = 0; i <= 128; ++i)
        EXPECT_LT((fine.planar.position.col(fine.planar.node(i, 1)) - fine.planar.position.col(fine.planar.node(i, 0)))
                      .norm(),
                  0.05)
            << i;
}

TEST(BlankChart, IsSmoothAcrossTheCellsOfItsGrid)
{
    // Second differences of the finer lines across a node of the grid are like those beside it:
    // bilinear cells would kink.
    const Waves sheet(1.5);
    GridOptions options;
    options.columns = options.rows = 16;
    const GridResult grid = coons_grid(sheet.part, sheet.blank, sheet.boundary, options);
    const BlankChart chart(grid, sheet.boundary);
    const GridResult fine = chart.refined(lines(256), lines(256));
    double at_nodes = 0, beside = 0;
    for (int j = 64; j <= 192; ++j)
        for (int i = 64; i <= 192; ++i) {
            const auto at = [&](int k) -> Eigen::Vector3d { return fine.planar.position.col(fine.planar.node(k, j)); };
            const double second = (at(i - 1) - 2 * at(i) + at(i + 1)).norm();
            (i % 16 == 0 ? at_nodes : beside) = std::max(i % 16 == 0 ? at_nodes : beside, second);
        }
    EXPECT_LT(at_nodes, 1.5 * beside + 1e-12);
}

TEST(BlankChart, FoldedGridIsRefused)
{
    const Waves sheet(1.5);
    GridOptions options;
    options.columns = options.rows = 8;
    GridResult grid = coons_grid(sheet.part, sheet.blank, sheet.boundary, options);
    grid.quality.folded_cells = 1;
    EXPECT_THROW(BlankChart(grid, sheet.boundary), InputError);
}

} // namespace spia
