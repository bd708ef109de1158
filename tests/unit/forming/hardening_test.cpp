#include "engine/forming/hardening.h"

#include <cmath>
#include <gtest/gtest.h>

namespace spia {
namespace {

const std::vector<Hardening> laws = {
    Swift{565.32, 0.007117, 0.2589},
    Hollomon{530, 0.23},
    Voce{130, 290, 12},
    HardeningTable{{0, 0.02, 0.1, 0.3, 0.8}, {200, 260, 330, 390, 430}},
};

} // namespace

TEST(StressCurve, SlopeAndWorkAreDerivativeAndIntegralOfTheStress)
{
    for (const Hardening& law : laws) {
        const StressCurve curve(law, 206000, {});
        double work = 0, before = 0;
        const double step = 1e-5;
        for (double strain = 0; strain < 1.2; strain += step) {
            const double middle = strain + 0.5 * step;
            work += curve(middle).stress * step; // midpoint rule
            before = middle;
        }
        EXPECT_NEAR(curve(before + 0.5 * step).work, work, 1e-5 * work) << law.index();
        for (double strain : {0.0003, 0.0009, 0.0015, 0.05, 0.4, 0.55, 0.7, 1.0}) {
            const double d = 1e-8;
            EXPECT_NEAR(curve(strain).slope, (curve(strain + d).stress - curve(strain - d).stress) / (2 * d),
                        1e-3 * curve(strain).slope + 1e-3)
                << law.index() << " at " << strain;
        }
    }
}

TEST(StressCurve, IsTheGivenLawBetweenYieldAndTrustedStrain)
{
    for (const Hardening& law : laws) {
        const StressCurve curve(law, 206000, {});
        for (double strain : {2 * curve.yield_strain(), 0.1, 0.3, 0.4999})
            EXPECT_DOUBLE_EQ(curve(strain).stress, flow_stress(law, strain).stress);
        EXPECT_DOUBLE_EQ(curve(0.5 * curve.yield_strain()).stress, 206000 * 0.5 * curve.yield_strain());
    }
}

TEST(StressCurve, GrowsAtLeastExponentiallyBeyondTheTrustedStrain)
{
    const StressCurve curve(laws[0], 206000, {});
    const double far = curve(1.0).stress;
    EXPECT_NEAR(curve(1.5).stress / far, std::exp(2 * 0.5), 1e-12);
    EXPECT_GT(curve(0.6).slope, flow_stress(laws[0], 0.6).slope);
}

TEST(StressCurve, HasNoJumpInStressOrSlope)
{
    for (const Hardening& law : {laws[0], laws[2]}) {
        const StressCurve curve(law, 206000, {});
        const double y = curve.yield_strain();
        for (double strain : {0.7 * y, 1.3 * y, 0.5, 0.75}) {
            const FlowStress below = curve(strain * (1 - 1e-12)), above = curve(strain * (1 + 1e-12));
            EXPECT_NEAR(below.stress, above.stress, 1e-6);
            EXPECT_NEAR(below.slope, above.slope, 1e-4 * (1 + below.slope));
            EXPECT_NEAR(below.work, above.work, 1e-6);
        }
    }
}

TEST(UniformStrain, IsWhereTheSlopeHasFallenToTheStress)
{
    EXPECT_NEAR(uniform_strain(Swift{565.32, 0.007117, 0.2589}, 1), 0.2589 - 0.007117, 1e-12);
    EXPECT_NEAR(uniform_strain(Hollomon{500, 0.21}, 1), 0.21, 1e-12);
    // Voce: c (s - s0) e = s - (s - s0) e for e = exp(-c eps)
    EXPECT_NEAR(uniform_strain(Voce{200, 400, 12}, 1), std::log((400 - 200) * (12 + 1) / 400.0) / 12, 1e-12);
    EXPECT_EQ(uniform_strain(Hollomon{500, 0.6}, 0.5), 0.5);
    EXPECT_LT(uniform_strain(Voce{300, 310, 1}, 0.5), 1e-12); // never hardens enough
}

} // namespace spia
