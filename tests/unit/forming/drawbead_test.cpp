#include "engine/forming/drawbead.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"

namespace spia {
namespace {

/// Ideally plastic, isotropic: in plane strain at 2/sqrt(3) of its flow stress.
Material plastic(double stress) { return {"plastic", 206000, 0.3, 7850, Voce{stress, stress, 1}, 1, 1, 1, ""}; }

} // namespace

TEST(Drawbead, OfAnIdeallyPlasticSheetWithoutFrictionIsSixTimesTheWorkOfThePlasticMoment)
{
    // Moment sigma' t^2/4 times the curvature, at two shoulders and the bead, bent and unbent.
    const double t = 0.8, stress = 200, moment = 2 / std::sqrt(3.0) * stress * t * t / 4;
    const BeadShape bead{5, 3, 6, 0};
    EXPECT_NEAR(drawbead_force(bead, plastic(stress), t), 2 * moment * (2 / 3.4 + 1 / 5.4), 1e-4 * moment);
}

TEST(Drawbead, FrictionMultipliesWhatIsPulledAroundEachRadius)
{
    const double t = 0.8, stress = 200, moment = 2 / std::sqrt(3.0) * stress * t * t / 4, mu = 0.15;
    const BeadShape bead{5, 3, 20, mu}; // deep: right angles
    const double shoulder = moment / 3.4, crown = moment / 5.4, wrap = std::exp(mu * std::numbers::pi / 2);
    const double first = shoulder * wrap + shoulder;
    const double second = (first + crown) * wrap * wrap + crown;
    const double third = (second + shoulder) * wrap + shoulder;
    EXPECT_NEAR(drawbead_force(bead, plastic(stress), t), third, 1e-4 * third);
}

TEST(Drawbead, AFlatOneDoesNothingAndADeeperOneMore)
{
    const Material steel{"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""};
    EXPECT_EQ(drawbead_force({5, 3, 0, 0.12}, steel, 0.8), 0);
    double before = 0;
    for (const double depth : {1., 2., 4., 8.}) {
        const double force = drawbead_force({5, 3, depth, 0.12}, steel, 0.8);
        EXPECT_GT(force, before);
        before = force;
    }
    EXPECT_GT(before, 50); // of the order of measured ones: 50 to 200 N/mm for 0.8 mm steel
    EXPECT_LT(before, 300);
    EXPECT_THROW(drawbead_force({0, 3, 5, 0.1}, steel, 0.8), InputError);
    EXPECT_THROW(drawbead_force({5, 3, 5, -0.1}, steel, 0.8), InputError);
    EXPECT_THROW(drawbead_force({5, 3, 5, 0.1}, steel, NAN), InputError);
}

} // namespace spia
