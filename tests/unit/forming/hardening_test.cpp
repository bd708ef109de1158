#include "engine/forming/material/hardening.h"

#include <cmath>
#include <gtest/gtest.h>

namespace spia {
namespace {

const std::vector<Hardening> laws = {
    Swift{565.32, 0.007117, 0.2589},
    Hollomon{530, 0.23},
    Voce{130, 290, 12},
    HardeningTable{{0, 0.02, 0.1, 0.3, 0.8}, {200, 260, 330, 390, 430}},
    Ludwik{150, 420, 0.45},
    HockettSherby{140, 420, 4, 0.7},
    HockettSherby{140, 420, 9, 1}, // Voce's law
    SwiftVoce{0.4, {565.32, 0.007117, 0.2589}, {130, 290, 12}},
};

/// Integral of the stress from 0, by Simpson's rule in eps = u^4: that tames the infinite slopes at
/// 0.
double area_under(const Hardening& law, double end)
{
    const int pieces = 2000;
    const double h = std::pow(end, 0.25) / pieces;
    double sum = 0;
    for (int i = 0; i <= pieces; ++i) {
        const double u = i * h, weight = i == 0 || i == pieces ? 1 : i % 2 ? 4 : 2;
        sum += weight * flow_stress(law, std::pow(u, 4)).stress * 4 * std::pow(u, 3);
    }
    return sum * h / 3;
}

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

TEST(FlowStress, WorkAndSlopeAreIntegralAndDerivativeOfEveryLaw)
{
    for (const Hardening& law : laws) {
        if (std::holds_alternative<HardeningTable>(law))
            continue; // its kinks spoil Simpson's rule; the curve test has it
        for (const double strain : {1e-6, 1e-3, 0.02, 0.3, 1.5}) {
            const FlowStress f = flow_stress(law, strain);
            EXPECT_NEAR(f.work, area_under(law, strain), 1e-8 * f.work) << describe(law) << " at " << strain;
            const double d = 1e-4 * strain;
            const double difference =
                (flow_stress(law, strain + d).stress - flow_stress(law, strain - d).stress) / (2 * d);
            EXPECT_NEAR(f.slope, difference, 1e-6 * f.slope) << describe(law) << " at " << strain;
        }
    }
}

TEST(FlowStress, StartsAtTheYieldStressWithAnInfiniteSlopeWhereThePowerIsBelowOne)
{
    EXPECT_EQ(flow_stress(Ludwik{150, 420, 0.45}, 0).stress, 150);
    EXPECT_TRUE(std::isinf(flow_stress(Ludwik{150, 420, 0.45}, 0).slope));
    EXPECT_EQ(flow_stress(HockettSherby{140, 420, 4, 0.7}, 0).stress, 140);
    EXPECT_TRUE(std::isinf(flow_stress(HockettSherby{140, 420, 4, 0.7}, 0).slope));
    EXPECT_DOUBLE_EQ(flow_stress(HockettSherby{140, 420, 4, 1}, 0).slope, 280 * 4);
    EXPECT_TRUE(std::isinf(flow_stress(Hollomon{530, 0.23}, 0).slope));
    for (const Hardening& law : laws)
        EXPECT_NEAR(flow_stress(law, 0).work, 0, 1e-12) << describe(law); // MPa; rounding
}

TEST(FlowStress, SpecialCasesOfTheLawsAreOneAnother)
{
    for (const double strain : {1e-4, 0.01, 0.2, 0.8}) {
        const auto same = [&](const Hardening& a, const Hardening& b) {
            const FlowStress p = flow_stress(a, strain), q = flow_stress(b, strain);
            EXPECT_NEAR(p.stress, q.stress, 1e-9 * q.stress) << describe(a);
            EXPECT_NEAR(p.slope, q.slope, 1e-9 * q.slope) << describe(a);
            EXPECT_NEAR(p.work, q.work, 1e-9 * q.work) << describe(a);
        };
        same(HockettSherby{130, 290, 12, 1}, Voce{130, 290, 12});
        same(Ludwik{0, 530, 0.23}, Hollomon{530, 0.23});
        same(SwiftVoce{1, {565, 0.007, 0.26}, {130, 290, 12}}, Swift{565, 0.007, 0.26});
        same(SwiftVoce{0, {565, 0.007, 0.26}, {130, 290, 12}}, Voce{130, 290, 12});
    }
    // By hand: 140 + 280 (1 - exp(-4 * 0.25^0.5)) = 140 + 280 (1 - e^-2)
    EXPECT_NEAR(flow_stress(HockettSherby{140, 420, 4, 0.5}, 0.25).stress, 382.1061207, 1e-6);
    EXPECT_NEAR(flow_stress(Ludwik{150, 400, 0.5}, 0.25).stress, 350, 1e-12);
}

TEST(StressCurve, YieldsWhereHookesLineMeetsTheLawHoweverSteepItStarts)
{
    for (const Hardening& law : laws) {
        const StressCurve curve(law, 206000, {});
        const double y = curve.yield_strain();
        EXPECT_NEAR(flow_stress(law, y).stress, 206000 * y, 1e-6) << describe(law);
        // The rounded knee rises, from the line to the law, and stays finite.
        double before = 0;
        for (double strain = 0.5 * y; strain < 1.6 * y; strain += 0.01 * y) {
            const FlowStress f = curve(strain);
            EXPECT_GT(f.stress, before) << describe(law);
            EXPECT_TRUE(std::isfinite(f.slope) && f.slope >= 0 && f.slope <= 206000 * 1.01) << describe(law);
            before = f.stress;
        }
    }
    // Ludwik by hand: 100 + 1000 sqrt(e) = 200000 e at u = sqrt(e) = (1000 + sqrt(1e6 + 8e7)) / 4e5
    // = 0.025
    EXPECT_NEAR(StressCurve(Ludwik{100, 1000, 0.5}, 200000, {}).yield_strain(), 0.025 * 0.025, 1e-15);
}

TEST(UniformStrain, IsWhereTheSlopeHasFallenToTheStress)
{
    EXPECT_NEAR(uniform_strain(Swift{565.32, 0.007117, 0.2589}, 1), 0.2589 - 0.007117, 1e-12);
    EXPECT_NEAR(uniform_strain(Hollomon{500, 0.21}, 1), 0.21, 1e-12);
    // Voce: c (s - s0) e = s - (s - s0) e for e = exp(-c eps)
    EXPECT_NEAR(uniform_strain(Voce{200, 400, 12}, 1), std::log((400 - 200) * (12 + 1) / 400.0) / 12, 1e-12);
    for (const Hardening& law : {laws[4], laws[5], laws[7]}) {
        const FlowStress f = flow_stress(law, uniform_strain(law, 1));
        EXPECT_NEAR(f.slope, f.stress, 1e-9 * f.stress) << describe(law);
    }
    EXPECT_EQ(uniform_strain(Hollomon{500, 0.6}, 0.5), 0.5);
    EXPECT_LT(uniform_strain(Voce{300, 310, 1}, 0.5), 1e-12); // never hardens enough
}

} // namespace spia
