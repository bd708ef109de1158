#include "engine/layout/smooth_fit.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "engine/layout/simplify/simplify_layout.h"
#include "engine/nurbs/certificate.h"
#include "tests/support/joined_patches.h"
#include "tests/support/shapes.h"

namespace spia::smooth_fit_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

using patches::greatest_angle;

/// A plate of 120 x 80 mm with two holes, lifted by a height; its projection is its blank
/// (one-to-one is all that counts here).
struct Sheet {
    TriMesh part = shapes::plate({120, 80, {{{35, 40}, 12}, {{85, 45}, 10}}, 6000});
    Blank blank;

    template <class Height> explicit Sheet(const Height& height)
    {
        blank.position = part.position.topRows(2);
        for (int v = 0; v < part.vertices(); ++v)
            part.position(2, v) = height(part.position(0, v), part.position(1, v));
    }
};

double dome(double x, double y) { return 12 * std::sin(x / 40) * std::cos((y - 40) / 35); }

PatchesFit fitted(const Sheet& sheet, bool smooth, double tolerance = 0.05)
{
    PatchesFitOptions options;
    options.tolerance = tolerance;
    options.smooth_joins = smooth;
    return blank_patches(sheet.part, sheet.blank, {}, options);
}

} // namespace

TEST(SmoothFit, JoinsPatchesOfACurvedSheetWithoutAngleWithinTheTolerance)
{
    const Sheet sheet(dome);
    const PatchesFit plain = fitted(sheet, false), smooth = fitted(sheet, true);
    EXPECT_FALSE(plain.joins);
    ASSERT_TRUE(smooth.joins);
    EXPECT_TRUE(smooth.reached);
    EXPECT_EQ(smooth.joins->kept, 0);
    EXPECT_EQ(smooth.joins->edges, 0);
    EXPECT_GT(greatest_angle(plain.patches), 0.3 * degree);
    EXPECT_LT(greatest_angle(smooth.patches), 0.05 * degree);
    EXPECT_TRUE(certify(smooth.patches).suited());
    require_watertight(smooth.patches);
    // What is reported is what the patches are: judged anew.
    const PatchesJudge judge(sheet.part, sheet.blank, smooth.layout, 0.05);
    EXPECT_EQ(judge.judge(smooth.patches.patch).max(), smooth.deviation_max());
}

TEST(SmoothFit, LeavesTheEdgesOfAPart)
{
    // A roof, divided along its ridge of 2 x 30 degrees, whose sides are arched a little.
    const TriMesh flat = shapes::rectangle(120, 80, 48, 32);
    TriMesh part = flat;
    for (int v = 0; v < part.vertices(); ++v)
        part.position(2, v) =
            60 - std::abs(flat.position(0, v) - 60) * std::tan(30 * degree) + 5 * std::sin(flat.position(1, v) / 25);
    const Blank blank{flat.position.topRows(2)};
    const auto at = [&](double x, double y) {
        Eigen::Index v;
        (blank.position.colwise() - Eigen::Vector2d(x, y)).colwise().norm().minCoeff(&v);
        return int(v);
    };
    LayoutOptions layout;
    layout.cuts = {{at(60, 0), at(60, 40), at(60, 80)}, {at(0, 40), at(60, 40)}, {at(120, 40), at(60, 40)}};
    PatchesFitOptions options;
    options.tolerance = 0.05;
    options.smooth_joins = true;
    const PatchesFit smooth = blank_patches(part, blank, layout, options);
    ASSERT_TRUE(smooth.joins);
    EXPECT_GT(smooth.joins->edges, 0);
    EXPECT_LT(smooth.joins->edges, smooth.joins->places);
    EXPECT_NEAR(greatest_angle(smooth.patches), 60 * degree, 3 * degree); // the ridge
    EXPECT_LT(smooth.joins->angle_after, smooth.joins->angle_before / 2); // across it
    EXPECT_TRUE(smooth.reached);
}

TEST(SmoothFit, KeepsPatchesThatWouldBeWorse)
{
    const Sheet sheet(dome);
    PatchesFitOptions options;
    options.tolerance = 0.05;
    PatchesFit fit = fit_patches(sheet.part, sheet.blank, make_layout(sheet.part, sheet.blank), options);
    const MultiPatch before = fit.patches;
    // By a tolerance that none of them keeps, a patch may only come nearer to the part: some do,
    // the others stay as they were.
    constexpr double none = 1e-4;
    const PatchesJudge judge(sheet.part, sheet.blank, fit.layout, none);
    const PatchesJudgement now = judge.judge(before.patch);
    const PatchesJudgement after = smooth_fit(fit, judge, now, none);
    ASSERT_TRUE(fit.joins);
    EXPECT_GT(fit.joins->kept, 0);
    int same = 0;
    for (size_t p = 0; p < now.patch.size(); ++p) {
        EXPECT_LE(after.patch[p].max, now.patch[p].max) << "patch " << p;
        same += fit.patches.patch[p].control == before.patch[p].control;
    }
    EXPECT_GE(same, fit.joins->kept);
    EXPECT_EQ(judge.judge(fit.patches.patch).max(), after.max());
    require_watertight(fit.patches);
}

TEST(SmoothFit, MakesNoPatchIllShaped)
{
    const Sheet sheet(dome);
    PatchesFitOptions options;
    options.tolerance = 0.05;
    const PatchesFit plain = fit_patches(sheet.part, sheet.blank, make_layout(sheet.part, sheet.blank), options);
    constexpr double any = 50;                // mm
    for (const unsigned seed : {6, 10, 13}) { // of those that ask for it
        constexpr double most = 0.5;          // mm, by which control points inside are off
        std::mt19937 random(seed);
        PatchesFit fit = plain;
        std::uniform_real_distribution<double> off(-most, most);
        for (NurbsSurface& patch : fit.patches.patch)
            for (int j = 1; j < patch.count_v - 1; ++j)
                for (int i = 1; i < patch.count_u - 1; ++i)
                    for (int k = 0; k < 3; ++k)
                        patch.control(k, patch.index(i, j)) += off(random);
        const Certificate before = certify(fit.patches);
        const PatchesJudge judge(sheet.part, sheet.blank, fit.layout, any);
        smooth_fit(fit, judge, judge.judge(fit.patches.patch), any);
        const Certificate after = certify(fit.patches);
        for (size_t p = 0; p < before.patch.size(); ++p)
            EXPECT_GE(after.patch[p].least_scaled, std::min(before.patch[p].least_scaled, well_shaped_jacobian))
                << "patch " << p << " of seed " << seed;
    }
}

} // namespace spia::smooth_fit_test
