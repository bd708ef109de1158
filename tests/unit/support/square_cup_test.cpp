#include "tests/support/square_cup.h"

#include "tests/unit/support/expectations.h"

namespace spia::shapes {
namespace {

TEST(SquareCup, AreaOfThePolyhedronTendsToTheClosedForm)
{
    for (double draft : {0.0, 10.0}) { // unequal radii: errors of their two terms must not cancel
        std::vector<double> h, error;
        for (int n : {4000, 16000, 64000}) {
            const SquareCup shape{.punch_radius = 6, .die_radius = 10, .draft_deg = draft, .triangles = n};
            const TriMesh mesh = square_cup(shape);
            h.push_back(mean_edge(mesh));
            error.push_back(std::abs(area(mesh) - shape.area()));
        }
        EXPECT_LT(error.back(), 3e-4 * SquareCup{}.area());
        EXPECT_NEAR(convergence_order(h, error), 2, 0.3) << "draft " << draft;
    }
}

TEST(SquareCup, IsADiskOfGoodTrianglesAtEverySize)
{
    for (int n : {2000, 10000, 100000}) {
        const TriMesh mesh = square_cup({.triangles = n});
        expect_count(mesh, n);
        expect_topology(mesh, 1, 1);
        expect_well_shaped(mesh, 0, 25);
        EXPECT_GT(least_angles(mesh).mean(),
                  47 * std::numbers::pi / 180); // right angles throughout: 45 at most
        EXPECT_GT(least_upward(mesh), -1e-12);
    }
}

TEST(SquareCup, DraftMakesItAHeightField) { EXPECT_GT(least_upward(square_cup({.draft_deg = 1})), 0.01); }

TEST(SquareCup, VerticalWallStandsOnThePunchSquare)
{
    const SquareCup shape;
    const TriMesh mesh = square_cup(shape);
    const Eigen::Array3d low = mesh.position.rowwise().minCoeff(), high = mesh.position.rowwise().maxCoeff();
    const double half = shape.punch / 2 + shape.die_radius + shape.flange_width;
    EXPECT_NEAR(high.z(), 0, 1e-12);
    EXPECT_NEAR(low.z(), -shape.depth, 1e-12);
    EXPECT_NEAR(high.x(), half, 1e-9);
    EXPECT_NEAR(low.y(), -half, 1e-9);
    double widest_wall = 0; // in the upper half of the part lies no vertex outside the punch square
    for (int v = 0; v < mesh.vertices(); ++v)
        if (mesh.position(2, v) > -shape.depth / 2)
            widest_wall = std::max(widest_wall, std::abs(mesh.position(0, v)));
    EXPECT_NEAR(widest_wall, shape.punch / 2, 1e-12);
}

} // namespace
} // namespace spia::shapes
