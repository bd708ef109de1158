#include "engine/forming/process/drawbead.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "tests/support/shapes.h"

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

TEST(Drawbead, TheForceGrowsSteadilyFromZeroWithTheDepth)
{
    const Material steel{"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""};
    for (const double t : {0.5, 1., 2.}) {
        const auto force = [&](double depth) { return drawbead_force({5, 3, depth, 0.12}, steel, t); };
        EXPECT_EQ(force(1e-6), 0);
        double before = 0;
        const double deep = force(10);
        for (double depth = 1e-3; depth < 6; depth += 1e-3) {
            const double now = force(depth);
            ASSERT_GE(now, before) << depth;
            ASSERT_LT(now - before, 1e-3 * deep) << depth;
            before = now;
        }
    }
}

TEST(Drawbead, AShallowOneBendsTheSheetAsABeamThatStaysLevelAtItsEnds)
{
    // Ideally plastic, without friction: six times the moment's work over the curvature beyond the
    // elastic one.
    const double t = 1, stress = 200, plane = 2 / std::sqrt(3.0), moment = plane * stress * t * t / 4, span = 9;
    const double elastic = 2 * plane * (stress / 206000) * (1 - 0.09) / t;
    const auto force = [&](double depth) { return drawbead_force({5, 3, depth, 0}, plastic(stress), t); };
    for (const double depth : {0.2, 0.5, 1., 2.})
        EXPECT_NEAR(force(depth), 6 * moment * (6 * depth / (span * span) - elastic), 1e-3 * moment) << depth;
    const double first = elastic * span * span / 6; // depth at which the outer fibre yields: 0.03
                                                    // mm
    EXPECT_EQ(force(0.999 * first), 0);
    EXPECT_GT(force(1.1 * first), 0);
    EXPECT_NEAR(force(4), 2 * moment * (2 / 3.5 + 1 / 5.5), 1e-4 * moment); // it lies on the tools
}

TEST(Drawbead, AShapeTakesTheSheetInWhichTheMiddleOfItsLineLies)
{
    const TriMesh part = shapes::rectangle(100, 40, 10, 4);
    std::vector<int> left, most;
    for (int f = 0; f < part.triangles(); ++f) {
        const double x = part.position(0, Eigen::all)(part.triangle.col(f)).mean();
        if (x < 50)
            left.push_back(f);
        if (x < 80)
            most.push_back(f);
    }
    const Material base = plastic(200), strong = plastic(400);
    const BeadShape bead{5, 3, 6, 0.1};
    const std::vector<TailoredPiece> pieces{{"most", most, strong, 1.5}, {"left", left, strong, 2}};
    const auto force = [&](const std::vector<Eigen::Vector3d>& line) {
        return drawbead_force(bead, line, part, base, 1, pieces);
    };
    // the later one
    EXPECT_EQ(force({{5, 20, 0}, {30, 20, 0}, {40, 20, 0}}), drawbead_force(bead, strong, 2));
    // middle at 52
    EXPECT_EQ(force({{5, 20, 0}, {15, 20, 0}, {99, 20, 1}}), drawbead_force(bead, strong, 1.5));
    EXPECT_EQ(force({{75, 20, 0}, {99, 20, 0}}), drawbead_force(bead, base, 1));
    EXPECT_EQ(drawbead_force(bead, {{5, 20, 0}, {9, 20, 0}}, part, base, 1, {}), drawbead_force(bead, base, 1));
}

} // namespace spia
