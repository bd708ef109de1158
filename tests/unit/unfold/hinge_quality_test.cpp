#include "engine/unfold/step/hinge_quality.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/unfold/step/unfold_script.h"
#include "tests/support/bent_parts.h"
#include "tests/support/developable.h"

namespace spia {
namespace {

using std::numbers::pi;
constexpr double degree = pi / 180;

/// A plane through a line along y, turned down about it from the xy plane.
TargetSurface tilted(double x, double angle)
{
    Eigen::Matrix<double, 3, 2> axes;
    axes << std::cos(angle), 0, 0, 1, -std::sin(angle), 0;
    return PlaneFace{{x, 0, 0}, axes};
}

struct Split {
    std::vector<int> fixed, freed;
};

template <class Is> Split split(const TriMesh& part, const Is& is_fixed)
{
    Split out;
    for (int f = 0; f < part.triangles(); ++f)
        (is_fixed(Eigen::Vector3d(part.position(Eigen::all, part.triangle.col(f)).rowwise().mean())) ? out.fixed
                                                                                                     : out.freed)
            .push_back(f);
    return out;
}

} // namespace

TEST(HingeQuality, TheFirstFacetOfABendIsNoCrease)
{
    const shapes::BentFlange shape{.triangles = 600};
    const TriMesh part = shapes::bent_flange(shape).mesh;
    const Split pick = split(part, [&](const Eigen::Vector3d& at) { return at[0] > shape.base; });
    const std::vector<FreedPiece> pieces = freed_pieces(part, pick.fixed, pick.freed);
    const double diagonal = 100;
    const auto turned = [&](double by) { return hinge_quality(tilted(shape.base, by), part, pick.fixed, pieces); };
    EXPECT_NEAR(turned(0).angle, 0, 1e-12);
    EXPECT_FALSE(creased(turned(0), diagonal));
    for (const double by : {2., 4., 30.}) { // the flange goes up: the target turned down is turned
                                            // away from it
        EXPECT_NEAR(turned(by * degree).angle, by * degree, 1e-12);
        EXPECT_EQ(creased(turned(by * degree), diagonal), by > 3);
        EXPECT_LT(turned(by * degree).distance_mm, 1e-12);
    }
}

TEST(HingeQuality, AFlatNeighbourTakesNothingOffAndASharpEdgeBesideTheHingeNeither)
{
    // A row of squares of 10 mm along x: one to be freed, one that stays, and a third that stands
    // upright on its far edge.
    const TriMesh part =
        shapes::patchwork({{{Eigen::Vector3d(0, 0, 0), {10, 0, 0}, {10, 20, 0}, {0, 20, 0}}, 1, 2},
                           {{Eigen::Vector3d(10, 0, 0), {20, 0, 0}, {20, 20, 0}, {10, 20, 0}}, 1, 2},
                           {{Eigen::Vector3d(20, 0, 0), {20, 0, 10}, {20, 20, 10}, {20, 20, 0}}, 1, 2}});
    const Split pick = split(part, [](const Eigen::Vector3d& at) { return at[0] > 10; });
    const std::vector<FreedPiece> pieces = freed_pieces(part, pick.fixed, pick.freed);
    for (const double by : {-20., -4., 4., 20.}) {
        const TargetFit fit = hinge_quality(tilted(10, by * degree), part, pick.fixed, pieces);
        EXPECT_NEAR(fit.angle, std::abs(by) * degree, 1e-12);
        EXPECT_TRUE(creased(fit, 30));
    }
    EXPECT_NEAR(hinge_quality(tilted(10, 0), part, pick.fixed, pieces).angle, 0, 1e-12);
}

TEST(HingeQuality, AFaceThatOnlyTouchesTheEndOfTheHingeIsNoCrease)
{
    // The second square has a flange along the side that begins where the hinge ends, at any angle.
    for (const double up : {6., 30., 90.}) {
        const Eigen::Vector3d rise(0, -10 * std::cos(up * degree), 10 * std::sin(up * degree));
        const Eigen::Vector3d a(10, 0, 0), b(20, 0, 0);
        const TriMesh part = shapes::patchwork({{{Eigen::Vector3d(0, 0, 0), {10, 0, 0}, {10, 20, 0}, {0, 20, 0}}, 1, 2},
                                                {{a, {20, 0, 0}, {20, 20, 0}, {10, 20, 0}}, 1, 2},
                                                {{a, a + rise, b + rise, b}, 1, 1}});
        const Split pick = split(part, [](const Eigen::Vector3d& at) { return at[0] > 10; });
        const std::vector<FreedPiece> pieces = freed_pieces(part, pick.fixed, pick.freed);
        EXPECT_NEAR(hinge_quality(tilted(10, 0), part, pick.fixed, pieces).angle, 0, 1e-12) << up;
    }
}

} // namespace spia
