#include "engine/nurbs/tessellate.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/evaluate.h"
#include "tests/support/known_surfaces.h"

namespace spia {

TEST(Tessellate, TrianglesLieInTheSurfaceAndLookTheWayOfItsNormals)
{
    const double radius = 50;
    const Tessellation t = tessellate(surfaces::sphere_patch(radius), 8);
    ASSERT_EQ(t.mesh.vertices(), 9 * 9);
    ASSERT_EQ(t.mesh.triangles(), 2 * 8 * 8);
    for (int i = 0; i < t.mesh.vertices(); ++i) {
        EXPECT_NEAR(t.mesh.position.col(i).norm(), radius, 1e-12);
        EXPECT_LT((t.normal.col(i) - t.mesh.position.col(i) / radius).norm(), 1e-13);
        EXPECT_EQ(evaluate(surfaces::sphere_patch(radius), t.uv(0, i), t.uv(1, i)).position, t.mesh.position.col(i));
    }
    const Eigen::Matrix3Xd area = area_vectors(t.mesh);
    for (int f = 0; f < t.mesh.triangles(); ++f)
        EXPECT_GT(area.col(f).dot(t.normal.col(t.mesh.triangle(0, f))), 0);
    EXPECT_EQ(boundary_loops(t.mesh).size(), 1u);
}

TEST(Tessellate, AreaOfAQuarterCylinderIsApproachedWithSecondOrder)
{
    const double truth = std::numbers::pi / 2 * 30 * 80;
    const NurbsSurface s = surfaces::quarter_cylinder(30, 80);
    const double coarse = truth - area(tessellate(s, 8).mesh), fine = truth - area(tessellate(s, 16).mesh);
    EXPECT_GT(fine, 0) << "chords are shorter than arcs";
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
}

TEST(Tessellate, SamplesStandOnKnotsAndEvenlyBetweenThem)
{
    const std::vector<double> u = sample_parameters({0, 0, 0, 0.5, 0.5, 1, 1, 1}, 2, 2);
    EXPECT_EQ(u, (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
    EXPECT_THROW(tessellate(surfaces::crooked(), 0), InputError);
}

TEST(Tessellate, NormalsOfACollapsedSideAreItsLimits)
{
    // A cone with its tip at v = 0: the slant has the slope radius / length everywhere.
    const double radius = 30, length = 40;
    NurbsSurface s = surfaces::quarter_cylinder(radius, length);
    for (int i = 0; i < 3; ++i)
        s.control.col(s.index(i, 0)).setZero();
    const Tessellation t = tessellate(s, 4);
    for (int i = 0; i < t.mesh.vertices(); ++i) {
        EXPECT_NEAR(t.normal.col(i).norm(), 1, 1e-12);
        EXPECT_NEAR(t.normal(1, i), -radius / std::hypot(radius, length), 1e-9) << "vertex " << i;
    }
}

} // namespace spia
