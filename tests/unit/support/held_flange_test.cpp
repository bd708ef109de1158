#include "tests/support/held_flange.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace spia {

TEST(HeldFlange, AnUprightWallHasTheClosedFormOfTheCup)
{
    const double r = 1.77, m = r / (1 + r);
    const auto wall = [&](double height) {
        return shapes::HeldFlange{shapes::Profile({40, 0}, -std::numbers::pi / 2).straight(height),
                                  {565.32, 0.007117, 0.2589},
                                  206000,
                                  r,
                                  0.8};
    };
    const shapes::FlangeBlank blank = shapes::held_flange_blank(wall(15));
    for (const int k : {100, 200, 400}) {
        const double R = 40 * std::pow(1 + (1 + m) * blank.s[k] / 40, 1 / (1 + m));
        EXPECT_NEAR(blank.R[k], R, 1e-5);
        EXPECT_NEAR(blank.thickness[k], 0.8 * std::pow(R / 40, 1 / (1 + r)), 1e-6);
    }
}

TEST(HeldFlange, AFlatRingIsItself)
{
    const shapes::FlangeBlank blank = shapes::held_flange_blank(
        {shapes::Profile({40, 0}, std::numbers::pi).straight(12), {565.32, 0.007117, 0.2589}, 206000, 1, 0.8});
    EXPECT_NEAR(blank.R.tail(1)[0], 28, 1e-6);
}

} // namespace spia
