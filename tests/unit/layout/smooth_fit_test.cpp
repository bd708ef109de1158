#include "engine/layout/smooth_fit.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/nurbs/certificate.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

constexpr double degree = std::numbers::pi / 180;

double greatest_angle(const MultiPatch& patches)
{
    double greatest = 0;
    for (const InterfaceCertificate& joint : certify(patches).interfaces)
        greatest = std::max(greatest, joint.greatest_angle);
    return greatest;
}

/// A plate of 120 x 80 mm with two holes, lifted by a height; its projection is its blank (one-to-one is all that counts here).
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
    // A roof: its ridge of 2 x 30 degrees is an edge wherever a join runs along it; a flat sheet beside it has no angles.
    const Sheet roof([](double x, double) { return 60 - std::abs(x - 60) * std::tan(30 * degree); });
    const PatchesFit smooth = fitted(roof, true, 0.5);
    ASSERT_TRUE(smooth.joins);
    EXPECT_LE(smooth.joins->angle_after, smooth.joins->angle_before);
    EXPECT_LE(smooth.deviation_max(), std::max(0.5, fitted(roof, false, 0.5).deviation_max()));
}

TEST(SmoothFit, KeepsPatchesThatWouldLeaveTheTolerance)
{
    const Sheet sheet(dome);
    PatchesFit fit = fitted(sheet, false);
    const MultiPatch before = fit.patches;
    // Judged by a little more than it is, smoothing spoils some patches: they stay, the others join smoothly.
    const PatchesJudge coarse(sheet.part, sheet.blank, fit.layout, 0.05);
    const PatchesJudgement now = coarse.judge(before.patch);
    const PatchesJudgement after = smooth_fit(fit, coarse, now, 1e-4);
    ASSERT_TRUE(fit.joins);
    EXPECT_GT(fit.joins->kept, 0);
    for (size_t p = 0; p < now.patch_max.size(); ++p)
        EXPECT_LE(after.patch_max[p], std::max(1e-4, now.patch_max[p])) << "patch " << p;
    EXPECT_EQ(coarse.judge(fit.patches.patch).max(), after.max());
    require_watertight(fit.patches);
}

} // namespace spia
