#include "engine/limits/forming_limit_curve.h"

#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string complaint(const std::function<void()>& act)
{
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no InputError";
}

} // namespace

TEST(KeelerBrazier, Flc0IsThatComputedByHandForThreeThicknessesAndThreeExponents)
{
    struct Case {
        double thickness, n, percent;
    };
    // (23.3 + 14.13 t) n / 0.21: 34.604, 37.43 and 51.56 at n = 0.21, times 5/7 and 10/21
    for (const Case& c : {Case{0.8, 0.21, 34.604}, Case{0.8, 0.15, 24.717143}, Case{0.8, 0.10, 16.478095},
                          Case{1.0, 0.21, 37.43}, Case{1.0, 0.15, 26.735714}, Case{1.0, 0.10, 17.823810},
                          Case{2.0, 0.21, 51.56}, Case{2.0, 0.15, 36.828571}, Case{2.0, 0.10, 24.552381}}) {
        const FormingLimitCurve curve = keeler_brazier(c.thickness, c.n);
        EXPECT_NEAR(100 * engineering_strain(curve.at_plane_strain()), c.percent, 1e-5) << c.thickness << " " << c.n;
        EXPECT_TRUE(curve.notes.empty());
    }
}

TEST(KeelerBrazier, BranchesKeepTheThicknessOnTheLeftAndRiseByThreeFifthsOnTheRight)
{
    const FormingLimitCurve curve = keeler_brazier(1.0, 0.21); // FLC0 37.43 %
    // thickness strain at necking: -ln 1.3743
    for (const double minor : {-0.5, -0.3, -0.1, -0.01})
        EXPECT_NEAR(curve(minor) + minor, std::log(1.3743), 1e-12);
    // By hand: e2 = -20 %: 1.3743 / 0.8 - 1 = 71.79 %, e2 = 10 %: 43.43 %, e2 = 20 %: 49.43 %
    EXPECT_NEAR(engineering_strain(curve(logarithmic_strain(-0.2))), 0.717875, 1e-9);
    EXPECT_NEAR(engineering_strain(curve(logarithmic_strain(0.1))), 0.4343, 1e-9);
    EXPECT_NEAR(engineering_strain(curve(logarithmic_strain(0.2))), 0.4943, 1e-9);
    for (double e2 = 0.003; e2 < 0.2; e2 += 0.007) // between the points of the right branch
        EXPECT_NEAR(engineering_strain(curve(logarithmic_strain(e2))), 0.3743 + 0.6 * e2, 2e-5);
}

TEST(KeelerBrazier, FallsToPlaneStrainRisesFromThereAndHasNoJump)
{
    for (const double thickness : {0.5, 1.0, 3.0})
        for (const double n : {0.05, 0.15, 0.3}) {
            const FormingLimitCurve curve = keeler_brazier(thickness, n);
            for (double minor = -0.6; minor < 0.599; minor += 0.01) {
                const double here = curve(minor), next = curve(minor + 0.01);
                EXPECT_GT((next - here) * (minor < -0.005 ? -1 : 1), 0) << minor;
                EXPECT_LT(std::abs(next - here), 0.0101);
            }
            EXPECT_NEAR(curve(-1e-12), curve(1e-12), 1e-11);
        }
}

TEST(KeelerBrazier, SaysWhereItIsAnExtrapolationAndRefusesNonsense)
{
    EXPECT_THAT(keeler_brazier(1, 0.25).notes, testing::ElementsAre(HasSubstr("0.21")));
    EXPECT_EQ(keeler_brazier(1, 0.25).at_plane_strain(), keeler_brazier(1, 0.21).at_plane_strain());
    EXPECT_THAT(keeler_brazier(3.5, 0.2).notes, testing::ElementsAre(HasSubstr("3 mm")));
    EXPECT_THAT(keeler_brazier(1, 0.01).notes, testing::ElementsAre(HasSubstr("n = 0.01")));
    EXPECT_THAT(keeler_brazier(1, 0.2).formula, AllOf(HasSubstr("Keeler-Brazier"), HasSubstr("35.65 %")));
    for (const double bad : {0.0, -1.0, double(INFINITY), std::nan("")})
        EXPECT_THROW(keeler_brazier(bad, 0.2), InputError);
    for (const double bad : {0.0, -0.1, 1.0, std::nan("")})
        EXPECT_THROW(keeler_brazier(1, bad), InputError);
}

TEST(FormingLimitCurve, StrainsGoThereAndBack)
{
    for (const double e : {-0.6, -0.1, 0.0, 1e-12, 0.2, 1.7})
        EXPECT_NEAR(engineering_strain(logarithmic_strain(e)), e, 1e-15 * (1 + std::abs(e)));
    EXPECT_NEAR(logarithmic_strain(1), std::log(2), 1e-15);
}

TEST(FormingLimitCurve, PassesThroughMeasuredPointsHoweverTheyAreWritten)
{
    const ScratchFolder folder;
    const std::vector<double> minor = {-0.2, 0, 0.1}, major = {0.6, 0.35, 0.4}; // engineering
    const FormingLimitCurve straight = curve_through(minor, major, true, "here");
    for (size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(straight(std::log1p(minor[i])), std::log1p(major[i]), 1e-15);
    EXPECT_TRUE(straight.notes.empty());
    // Prolonged with the last slopes, in logarithmic strains.
    const double slope = (std::log(1.4) - std::log(1.35)) / std::log(1.1);
    EXPECT_NEAR(straight(0.3), std::log(1.4) + slope * (0.3 - std::log(1.1)), 1e-12);
    const FormingLimitCurve steep = curve_through({-0.001, 0, 0.001}, {0.9, 0.1, 0.09}, false, "steep");
    EXPECT_EQ(steep(-9), 5); // a number whatever comes
    EXPECT_EQ(steep(9), 0);
    const auto read = [&](const std::string& text) {
        put(folder / "flc.csv", text);
        return read_forming_limit_curve(folder / "flc.csv");
    };
    for (const char* text :
         {"# engineering\n-0.2;0.6\n0;0.35\n0.1;0.4\n", "engineering\nminor %,major %\n-20,60\n0,35\n10,40\n",
          "engineering strain in points\n-20\t60\n0\t35\n10\t40\n",
          "engineering\nmajor;minor\n0,6;-0,2\n0,35;0\n0,4;0,1\n"}) {
        const FormingLimitCurve curve = read(text);
        EXPECT_EQ(curve.minor.size(), 3u);
        for (size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(curve(std::log1p(minor[i])), std::log1p(major[i]), 1e-12) << text;
    }
    EXPECT_NEAR(read("true\n-0.2;0.6\n0.1;0.4\n")(-0.2), 0.6, 1e-15);
}

TEST(FormingLimitCurve, PointsThatAreNoCurveAreRefusedByFileAndPoint)
{
    const ScratchFolder folder;
    const auto refused = [&](const std::string& text) {
        put(folder / "flc.csv", text);
        return complaint([&] { read_forming_limit_curve(folder / "flc.csv"); });
    };
    EXPECT_EQ(refused("true\n-0.2;0.6\n0;0.4\n"), "no InputError");
    EXPECT_THAT(refused("-0.2;0.6\n0;0.4\n"), AllOf(HasSubstr("flc.csv"), HasSubstr("engineering")));
    EXPECT_THAT(refused("true and engineering\n-0.2;0.6\n0;0.4\n"), HasSubstr("both"));
    EXPECT_THAT(refused("true\n0;0.4\n"), HasSubstr("two points"));
    EXPECT_THAT(refused("true\n0;0.4\n0;0.5\n"), HasSubstr("point 2"));
    EXPECT_THAT(refused("true\n0.1;0.4\n0;0.5\n"), HasSubstr("point 2"));
    EXPECT_THAT(refused("true\n0;-0.4\n0.1;0.5\n"), HasSubstr("point 1"));
    EXPECT_THAT(refused("true\n0;0.4\n0.5;0.3\n"), HasSubstr("point 2")); // major below minor
    EXPECT_THAT(refused("engineering\n-300;40\n0;30\n"), HasSubstr("point 1"));
    EXPECT_THAT(refused("true\n0;0.4\n0.1;x\n"), HasSubstr("line 3"));
    EXPECT_THAT(refused(""), HasSubstr("no row"));
    EXPECT_THAT(complaint([&] { read_forming_limit_curve(folder / "none.csv"); }), HasSubstr("none.csv"));
}

TEST(FormingLimitCurve, AnOddShapeIsNoted)
{
    EXPECT_THAT(curve_through({-0.2, -0.1, 0}, {0.4, 0.6, 0.3}, false, "x").notes,
                testing::ElementsAre(HasSubstr("rises")));
    EXPECT_THAT(curve_through({0.1, 0.2}, {0.4, 0.5}, false, "x").notes,
                testing::ElementsAre(HasSubstr("plane strain")));
}

} // namespace spia
