#include "engine/coons/lift.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

#include "engine/coons/boundary.h"
#include "engine/core/error.h"
#include "tests/support/shapes.h"
#include "tests/unit/coons/outlines.h"

namespace spia::lift_test {

namespace {

GridResult grid_of(const TriMesh& part, const Blank& blank, const GridOptions& options = {})
{
    return coons_grid(part, blank, split_boundary(blank, part, propose_corners(blank, part)), options);
}

} // namespace

TEST(Lift, OfAPlanePartIsTheGridItself)
{
    const TriMesh part = outlines::part(outlines::star(4, 10, 5, 0.4));
    const GridResult grid = grid_of(part, outlines::as_blank(part));
    EXPECT_LT((lift(grid).lifted.position - grid.planar.position).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((lift(grid.planar, outlines::as_blank(part), part).lifted.position - grid.planar.position)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9);
}

TEST(Lift, OfAnUnrolledCylinderComesCloserWithSecondOrder)
{
    const double radius = 10, angle = 2.5, height = 15;
    std::vector<double> error;
    for (const int n : {8, 16, 32}) {
        // nothing in common with the grid
        TriMesh part = shapes::rectangle(radius * angle, height, n + 1, n - 1);
        const Blank blank = outlines::as_blank(part);
        for (int v = 0; v < part.vertices(); ++v) {
            const double s = part.position(0, v) / radius;
            part.position.col(v) << radius * std::cos(s), radius * std::sin(s), blank.position(1, v);
        }
        const GridResult grid = grid_of(part, blank);
        const LiftResult lifted = lift(grid);
        double worst = 0;
        for (int k = 0; k < grid.planar.nodes(); ++k) {
            const double s = grid.planar.position(0, k) / radius;
            const Eigen::Vector3d truth(radius * std::cos(s), radius * std::sin(s), grid.planar.position(1, k));
            worst = std::max(worst, (lifted.lifted.position.col(k) - truth).norm());
        }
        error.push_back(worst);
    }
    EXPECT_GT(std::log2(error[0] / error[1]), 1.7);
    EXPECT_GT(std::log2(error[1] / error[2]), 1.7);
    EXPECT_LT(error[2], 0.02); // the sagitta r (da)^2 / 8 = 0.0072 of an edge
}

TEST(Lift, BorderNodesAreOnTheEdgeOfThePart)
{
    TriMesh part = shapes::rectangle(10, 10, 6, 5);
    const Blank blank = outlines::as_blank(part);
    part.position.row(2) =
        // z = f(x) + 0.3 y
        part.position.row(0).array().square() * 0.1 + part.position.row(1).array() * 0.3;
    const QuadGrid lifted = lift(grid_of(part, blank)).lifted;
    for (int i = 0; i <= lifted.columns; ++i) {
        const Eigen::Vector3d p = lifted.position.col(lifted.node(i, 0));
        const int k = std::min(5, int(p.x() / 10 * 6));
        const double x0 = k * 10.0 / 6, x1 = x0 + 10.0 / 6;
        const double chord = 0.1 * (x0 * x0 + (p.x() - x0) * (x1 + x0));
        EXPECT_NEAR(p.z(), chord, 1e-12);
        EXPECT_EQ(p.y(), 0);
    }
}

TEST(Lift, NodesInAHoleAreMarkedAndLieOnASmoothFill)
{
    // A shallow saddle plate with a square hole.
    TriMesh full = shapes::rectangle(2, 2, 20, 20), part = full;
    std::vector<int> kept;
    for (int f = 0; f < full.triangles(); ++f) {
        const Eigen::Vector3d centre =
            (full.position.col(full.triangle(0, f)) + full.position.col(full.triangle(1, f)) +
             full.position.col(full.triangle(2, f))) /
            3;
        if (std::abs(centre.x() - 1) > 0.4 || std::abs(centre.y() - 1) > 0.4)
            kept.push_back(f);
    }
    part.triangle = full.triangle(Eigen::all, kept).eval();
    const Blank blank = outlines::as_blank(part);
    part.position.row(2) =
        0.2 * (part.position.row(0).array() - 1).square() - 0.2 * (part.position.row(1).array() - 1).square();
    for (const GridMethod method : {GridMethod::automatic, GridMethod::harmonic}) {
        const GridResult grid = grid_of(part, blank, {.method = method});
        const LiftResult lifted = lift(grid);
        int in_hole = 0;
        for (int n = 0; n < grid.planar.nodes(); ++n) {
            const double x = grid.planar.position(0, n) - 1, y = grid.planar.position(1, n) - 1;
            const double far = std::max(std::abs(x), std::abs(y));
            const bool inside = far < 0.4 - 1e-9;
            if (inside || far > 0.4 + 1e-9) {
                EXPECT_EQ(bool(lifted.on_fill[size_t(n)]), inside);
            }
            EXPECT_EQ(bool(lifted.on_fill[size_t(n)]), lifted.place[size_t(n)].face >= part.triangles());
            EXPECT_NEAR(lifted.lifted.position(2, n), 0.2 * (x * x - y * y), 0.004);
            in_hole += inside;
        }
        EXPECT_GT(in_hole, 100);
    }
}

TEST(Lift, ANodeOffTheBlankIsNamed)
{
    const TriMesh part = shapes::rectangle(3, 2, 3, 2);
    const Blank blank = outlines::as_blank(part);
    QuadGrid grid = grid_of(part, blank, {.columns = 3, .rows = 2}).planar;
    grid.position.col(5) << 1, -0.01, 0;
    try {
        lift(grid, blank, part);
        ADD_FAILURE() << "the node is outside";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("node 5"), std::string::npos) << error.what();
    }
}

} // namespace spia::lift_test
