#include "tests/support/fender.h"
#include "tests/support/inner_panel.h"
#include "tests/support/relief.h"
#include "tests/unit/support/expectations.h"

namespace spia::shapes {
namespace {

using std::numbers::pi;

TEST(Step, IsSmoothAndReachesItsDepthAndSlope)
{
    const Step step(47, 78, 8);
    EXPECT_EQ(step(-1), 0);
    EXPECT_EQ(step(step.run() + 1), 47);
    const double h = step.run() / 20000;
    double steepest = 0, largest_change = 0, before = 0;
    for (double t = -h; t < step.run() + 2 * h; t += h) {
        const double slope = (step(t + h) - step(t)) / h;
        largest_change = std::max(largest_change, std::abs(std::atan(slope) - std::atan(before)));
        steepest = std::max(steepest, slope);
        before = slope;
    }
    EXPECT_NEAR(std::atan(steepest), 78 * pi / 180, 1e-6);
    EXPECT_LT(largest_change,
              2 * h / 8 / std::cos(78 * pi / 180)); // the turn of an arc of 8 mm over one step
}

TEST(InnerPanel, IsAHeightFieldWithAWindowAndTenHolesAtEverySize)
{
    for (int n : {2000, 7000, 20000}) {
        const ParametricMesh panel = inner_panel({.triangles = n});
        expect_count(panel.mesh, n);
        expect_topology(panel.mesh, 12, -10);
        expect_well_shaped(panel.mesh, 0, 20);
        EXPECT_GT(least_upward(panel.mesh), 0);
        EXPECT_EQ(panel.mesh.position.topRows(2), panel.parameter);
    }
}

TEST(InnerPanel, DrawWallHasItsAngle)
{
    const TriMesh mesh = inner_panel({.wall_angle_deg = 78, .triangles = 40000}).mesh;
    const Eigen::Matrix3Xd vectors = area_vectors(mesh);
    double steep = 0; // area within 3 degrees of the wall's angle
    for (int f = 0; f < mesh.triangles(); ++f)
        steep += std::abs(std::acos(vectors(2, f) / vectors.col(f).norm()) - 78 * pi / 180) < 3 * pi / 180
                     ? vectors.col(f).norm()
                     : 0;
    const double around = 4 * (245 + 145) - 8 * 50 + 2 * pi * (50 + 23 / 2.0); // middle of the wall
    // the flat part of the wall is 35.6 mm high
    EXPECT_NEAR(steep, around * 35.6, 0.15 * around * 35.6);
}

TEST(Fender, HasOneBoundaryWithFourCorners)
{
    for (int n : {2000, 20000, 80000}) {
        const ParametricMesh part = fender({.triangles = n});
        expect_count(part.mesh, n);
        expect_topology(part.mesh, 1, 1);
        expect_well_shaped(part.mesh, 0, 20);
        const std::vector<int> loop = boundary_loops(part.mesh).front();
        std::vector<double> turns; // in the parameter plane
        for (size_t i = 0; i < loop.size(); ++i) {
            const Eigen::Vector2d a = part.parameter.col(loop[i]);
            const Eigen::Vector2d b = part.parameter.col(loop[(i + 1) % loop.size()]);
            const Eigen::Vector2d c = part.parameter.col(loop[(i + 2) % loop.size()]);
            const Eigen::Vector2d p = b - a, q = c - b;
            turns.push_back(std::atan2(p.x() * q.y() - p.y() * q.x(), p.dot(q)));
        }
        std::sort(turns.rbegin(), turns.rend());
        EXPECT_NEAR(turns[3], pi / 2, 1e-6);
        EXPECT_LT(turns[4], 0.7) << n;
    }
}

TEST(Fender, FlangeIsBentByItsAngle)
{
    const TriMesh mesh = fender({.flange_angle_deg = 85}).mesh;
    const Eigen::Matrix3Xd normal = area_vectors(mesh).colwise().normalized();
    EXPECT_GT(normal.row(2).minCoeff(), -0.5); // the skin's slope at its edge adds to the flange's
                                               // angle
    EXPECT_LT(normal.row(2).minCoeff(), 0.1);
}

} // namespace
} // namespace spia::shapes
