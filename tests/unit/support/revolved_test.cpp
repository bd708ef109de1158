#include "tests/support/revolved.h"

#include <filesystem>

#include "tests/unit/support/expectations.h"

namespace spia::shapes {
namespace {

using std::numbers::pi;

TEST(Revolved, DomeHasTheAreaOfItsClosedForm)
{
    std::vector<double> h, error;
    for (int n : {2000, 8000, 32000}) {
        const Dome shape{.triangles = n};
        const TriMesh mesh = dome(shape).mesh;
        expect_count(mesh, n);
        expect_topology(mesh, 1, 1);
        expect_well_shaped(mesh, 0, 25);
        EXPECT_GT(least_upward(mesh), 0);
        h.push_back(mean_edge(mesh));
        error.push_back(std::abs(area(mesh) - shape.area()));
    }
    EXPECT_LT(error.back(), 2e-4 * Dome{}.area());
    EXPECT_NEAR(convergence_order(h, error), 2, 0.2);
}

TEST(Revolved, SphereCapHasTheAreaOfItsClosedForm)
{
    const SphereCap hemisphere{.half_angle_deg = 90, .triangles = 20000};
    EXPECT_NEAR(hemisphere.area(), 2 * pi * 50 * 50, 1e-9);
    EXPECT_NEAR(area(sphere_cap(hemisphere).mesh), hemisphere.area(), 5e-4 * hemisphere.area());
}

TEST(Revolved, SharpCupKeepsRowsOnItsEdgeAndRim)
{
    const SharpCup shape;
    const AxisymmetricPart part = sharp_cup(shape);
    expect_count(part.mesh, shape.triangles);
    expect_topology(part.mesh, 1, 1);
    expect_well_shaped(part.mesh, 0, 25);
    EXPECT_NEAR(area(part.mesh), shape.area(), 2e-3 * shape.area());
    int on_edge = 0;
    for (int v = 0; v < part.mesh.vertices(); ++v) {
        const auto x = part.mesh.position.col(v);
        const double r = x.head<2>().norm();
        EXPECT_TRUE(std::abs(r - shape.radius) < 1e-12 * shape.radius || x.z() == 0) << "vertex " << v;
        on_edge += std::abs(r - shape.radius) < 1e-12 * shape.radius && x.z() == 0;
    }
    EXPECT_EQ(on_edge, int(part.rim.size()));
    EXPECT_EQ(part.rim, boundary_loops(part.mesh).front());
}

TEST(Revolved, ArcLengthOfAConeIsTheDistanceToItsApex)
{
    Eigen::Matrix2Xd meridian(2, 2);
    meridian << 0, 30, /**/ 40, 0;
    const AxisymmetricPart cone = axisymmetric(meridian, 3000);
    const Eigen::Vector3d apex(0, 0, 40);
    EXPECT_LT(
        (cone.arc_length - (cone.mesh.position.colwise() - apex).colwise().norm().transpose()).cwiseAbs().maxCoeff(),
        1e-12);
    EXPECT_NEAR(area(cone.mesh), pi * 30 * 50, 3e-3 * pi * 30 * 50);
}

TEST(Revolved, MeridianThatStartsOffTheAxisGivesARing)
{
    Eigen::Matrix2Xd meridian(2, 2);
    meridian << 20, 60, /**/ 0, 0;
    const TriMesh ring = axisymmetric(meridian, 4000).mesh;
    expect_topology(ring, 2, 0);
    expect_well_shaped(ring, 0, 25);
}

TEST(Revolved, ReferenceMeridiansAreMeshedAtEverySize)
{
    const std::filesystem::path folder = SPIA_SOURCE_DIR "/../shared/reference/axisymmetric";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << folder << " is absent";
    for (const char* name : {"dome_flange_r177", "flat_cup_r177", "cone_cup_aluminium"})
        for (int n : {2000, 20000, 200000}) {
            const Eigen::Matrix2Xd meridian = read_meridian(folder / (std::string(name) + ".meridian.csv"));
            const AxisymmetricPart part = axisymmetric(meridian, n);
            expect_count(part.mesh, n, 0.03);
            expect_topology(part.mesh, 1, 1);
            expect_well_shaped(part.mesh, 0, 25);
            EXPECT_GT(least_upward(part.mesh), 0);
            EXPECT_NEAR(part.mesh.position.col(part.rim.front()).head<2>().norm(), meridian(0, meridian.cols() - 1),
                        1e-9);
        }
}

} // namespace
} // namespace spia::shapes
