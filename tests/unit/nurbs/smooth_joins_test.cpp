#include "engine/nurbs/smooth_joins.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/nurbs/certificate.h"
#include "tests/support/joined_patches.h"

namespace spia {
namespace {

constexpr double degree = std::numbers::pi / 180;

using patches::greatest_angle;

/// The patch at 0 <= u <= 1 and the one beyond it of a surface over the plane, as control points of
/// even Greville abscissas: of a plane or a parabolic sheet they join smoothly.
MultiPatch two(const std::function<double(double, double)>& height)
{
    std::vector<NurbsSurface> patches;
    for (const double from : {0., 1.}) {
        NurbsSurface s;
        s.degree_u = s.degree_v = 3;
        s.count_u = s.count_v = 7;
        s.knots_u = s.knots_v = {0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1};
        s.control.resize(3, 49);
        s.weight.setOnes(49);
        const auto greville = [&](int i) {
            return (s.knots_u[size_t(i) + 1] + s.knots_u[size_t(i) + 2] + s.knots_u[size_t(i) + 3]) / 3;
        };
        for (int j = 0; j < 7; ++j)
            for (int i = 0; i < 7; ++i) {
                const double x = 100 * (from + greville(i)), y = 100 * greville(j);
                s.control.col(s.index(i, j)) << x, y, height(x, y);
            }
        patches.push_back(s);
    }
    return joined(std::move(patches));
}

/// Angles of up to two degrees: the second row of the second patch goes up and down.
MultiPatch bent_joint()
{
    MultiPatch patches = two([](double x, double y) { return 0.002 * x * y; });
    NurbsSurface& second = patches.patch[1];
    for (int j = 0; j < second.count_v; ++j)
        second.control(2, second.index(1, j)) += 0.2 * std::cos(3. * j);
    return patches;
}

} // namespace

TEST(SmoothJoins, TakesTheAngleOutOfTheJointOfTwoPatches)
{
    const MultiPatch before = bent_joint();
    ASSERT_GT(greatest_angle(before), 1 * degree);
    const SmoothJoins smooth = smooth_joins(before);
    EXPECT_NEAR(smooth.angle_before, greatest_angle(before), 0.02 * greatest_angle(before));
    EXPECT_LT(greatest_angle(smooth.patches), 0.01 * degree);
    EXPECT_LE(greatest_angle(smooth.patches), 1.01 * smooth.angle_after + 1e-9);
    EXPECT_LT(smooth.greatest_move, 0.2); // mm: what was bent at most
    EXPECT_EQ(smooth.edges, 0);
    require_watertight(smooth.patches);
}

TEST(SmoothJoins, KeepTheBorderOfTheWholeButBesideTheEndsOfJoints)
{
    const MultiPatch before = bent_joint(), after = smooth_joins(before).patches;
    int moved = 0;
    for (const PatchSide& side : outer_sides(before))
        for (const int control : side_controls(before.patch[size_t(side.patch)], side.side))
            if (const Eigen::Vector3d was = before.patch[size_t(side.patch)].control.col(control);
                after.patch[size_t(side.patch)].control.col(control) != was) {
                ++moved;
                EXPECT_NEAR(was.x(), 100, 9); // beside the joint, not at it
                EXPECT_NE(was.x(), 100);
            }
    EXPECT_EQ(moved, 4); // two beside each end of the join
    EXPECT_NE(after.patch[1].control, before.patch[1].control);
}

TEST(SmoothJoins, LeavePatchesThatAreSmooth)
{
    const MultiPatch before = two([](double x, double y) { return 0.002 * x * y + 0.1 * x; });
    ASSERT_LT(greatest_angle(before), 1e-9);
    const SmoothJoins smooth = smooth_joins(before);
    EXPECT_EQ(smooth.greatest_move, 0);
    EXPECT_EQ(smooth.patches.patch[0].control, before.patch[0].control);
}

TEST(SmoothJoins, LeaveEdgesOfThePart)
{
    const MultiPatch roof = two([](double x, double) { return 50 - std::abs(x - 100) / 2; });
    ASSERT_GT(greatest_angle(roof), 50 * degree);
    const SmoothJoins smooth = smooth_joins(roof);
    EXPECT_EQ(smooth.edges, smooth.places);
    EXPECT_GT(smooth.edges, 0);
    EXPECT_EQ(smooth.greatest_move, 0);
    EXPECT_EQ(smooth.angle_before, 0);
}

TEST(SmoothJoins, WorkHoweverParametersRunAndAroundACorner)
{
    int tried = 0;
    for (const auto& [name, patches] : patches::samples()) {
        const bool rational = std::any_of(patches.patch.begin(), patches.patch.end(),
                                          [](const NurbsSurface& s) { return (s.weight.array() != 1).any(); });
        if (patches.interfaces.empty() || rational)
            continue;
        const SmoothJoins smooth = smooth_joins(patches, {.sharp = 100 * degree, .tolerance = 10});
        require_watertight(smooth.patches);
        EXPECT_LT(smooth.angle_after, smooth.angle_before / 100) << name;
        EXPECT_LT(greatest_angle(smooth.patches), 0.02 * degree) << name;
        ++tried;
    }
    EXPECT_GE(tried, 5);
}

TEST(SmoothJoins, RefuseWeightsAndGaps)
{
    MultiPatch patches = bent_joint();
    patches.patch[0].weight[8] = 2;
    EXPECT_THROW(smooth_joins(patches), InputError);
    patches = bent_joint();
    patches.patch[0].control(2, patches.patch[0].index(6, 3)) += 1e-9;
    EXPECT_THROW(smooth_joins(patches), InputError);
}

} // namespace spia
