#include "tests/support/shapes.h"

#include "engine/core/error.h"
#include "tests/support/parametric_mesh.h"
#include "tests/unit/support/expectations.h"

namespace spia::shapes {
namespace {

using std::numbers::pi;

TEST(Shapes, PlateHasItsAreaAndOneLoopPerHole)
{
    for (int n : {2000, 20000}) {
        const Plate shape{.triangles = n};
        const TriMesh mesh = plate(shape);
        expect_count(mesh, n);
        expect_topology(mesh, 3, -1);
        expect_well_shaped(mesh, 0, 25);
        EXPECT_NEAR(area(mesh), shape.area(),
                    3.0 / n * shape.area()); // the chords of the holes: edge^2, so 1 / n
        EXPECT_NEAR(least_upward(mesh), 1, 1e-12);
    }
}

TEST(Shapes, BoundaryOfAPlateLiesOnItsRectangleAndCircles)
{
    for (int n : {4000, 70000}) { // the larger one is made by quartering
        const Plate shape{.triangles = n};
        const TriMesh mesh = plate(shape);
        const Region region = perforated({0, 0}, {shape.width, shape.height}, shape.holes);
        double farthest = 0;
        for (const auto& loop : boundary_loops(mesh))
            for (int v : loop)
                farthest = std::max(farthest, std::abs(region.distance(mesh.position.col(v).head<2>())));
        EXPECT_LT(farthest, 1e-9);
        for (const Eigen::Vector2d& corner : region.corners)
            EXPECT_EQ((mesh.position.topRows(2).colwise() - corner).colwise().norm().minCoeff(), 0);
    }
}

TEST(Shapes, MeshOfAnUndersampledSurfaceIsStillAHeightField)
{
    Region square;
    square.low = {0, 0};
    square.high = {200, 200};
    square.corners = {{0, 0}, {200, 0}, {200, 200}, {0, 200}};
    square.distance = [](const Eigen::Vector2d& p) { return box_distance(p, {100, 100}, {100, 100}, 0); };
    const auto egg_crate = [](const Eigen::Vector2d& p) { // slopes up to 76 degrees, a wave is two
                                                          // to six edges long
        return Eigen::Vector3d(p.x(), p.y(), 25 * std::sin(p.x() / 6) * std::sin(p.y() / 6));
    };
    for (int n : {3000, 6000, 12000}) {
        const ParametricMesh crate = mesh_surface(square, egg_crate, n);
        expect_topology(crate.mesh, 1, 1);
        EXPECT_GT(least_upward(crate.mesh), 0) << n;
    }
}

TEST(Shapes, SaddleHasNegativeCurvatureInside)
{
    const TriMesh mesh = saddle();
    expect_count(mesh, 4000);
    expect_topology(mesh, 1, 1);
    const Eigen::VectorXd sum = angle_sums(mesh);
    const std::vector<bool> boundary = on_boundary(mesh);
    for (int v = 0; v < mesh.vertices(); ++v)
        EXPECT_TRUE(boundary[v] || sum[v] > 2 * pi) << "vertex " << v;
}

TEST(Shapes, ClosedSphereHasItsAreaAndNoBoundary)
{
    const TriMesh mesh = closed_sphere(50, 20000);
    expect_count(mesh, 20000);
    expect_topology(mesh, 0, 2);
    EXPECT_NEAR(area(mesh), 4 * pi * 2500, 1e-3 * 4 * pi * 2500);
    EXPECT_GT(area_vectors(mesh).col(0).dot(mesh.position.col(mesh.triangle(0, 0))), 0);
}

TEST(Shapes, TorusHasItsAreaAndGenusOne)
{
    const TriMesh mesh = torus(60, 20, 20000);
    expect_count(mesh, 20000);
    expect_topology(mesh, 0, 0);
    EXPECT_NEAR(area(mesh), 4 * pi * pi * 60 * 20, 1e-2 * 4 * pi * pi * 60 * 20);
}

TEST(Shapes, MoebiusStripHasClashingOrientations)
{
    const TriMesh mesh = moebius_strip(50, 20, 2000);
    expect_count(mesh, 2000);
    EXPECT_EQ(euler_characteristic(mesh), 0);
    EXPECT_THROW(halfedges(mesh), InputError);
}

TEST(Shapes, TwoRectanglesAreTwoComponents) { expect_topology(two_rectangles(), 2, 2); }

} // namespace
} // namespace spia::shapes
