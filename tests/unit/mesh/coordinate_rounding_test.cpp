#include "engine/mesh/solid/fit/coordinate_rounding.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/seeded_random.h"

namespace spia {
namespace {

const double of_cube = std::sqrt(3.) / 2; // half the diagonal of one whose side is a step

Eigen::Matrix3Xd places(double away = 0)
{
    shapes::SeededRandom random(1);
    Eigen::Matrix3Xd x(3, 100);
    for (double& c : x.reshaped())
        c = away + random.between(-50, 50);
    return x;
}

Eigen::Matrix3Xd decimals(const Eigen::Matrix3Xd& x, int count)
{
    const double scale = std::pow(10., count);
    return (x * scale).array().round() / scale;
}

Eigen::Matrix3Xd single(const Eigen::Matrix3Xd& x) { return x.cast<float>().cast<double>(); }

} // namespace

TEST(CoordinateRounding, IsHalfTheLastDecimal)
{
    EXPECT_EQ(coordinate_rounding(places(), 1), 0) << "double precision";
    for (int count = 0; count <= 4; ++count) {
        const Eigen::Matrix3Xd x = decimals(places(), count);
        EXPECT_NEAR(coordinate_rounding(x, 1), of_cube * std::pow(10., -count), 1e-9) << count;
        EXPECT_NEAR(coordinate_rounding(single(x), 1), of_cube * std::pow(10., -count), 1e-9) << count;
        EXPECT_NEAR(coordinate_rounding(25.4 * x, 25.4), 25.4 * of_cube * std::pow(10., -count), 1e-8) << "inch";
    }
}

TEST(CoordinateRounding, IsThatOfSinglePrecisionWhereThePartLies)
{
    EXPECT_NEAR(coordinate_rounding(single(places()), 1), of_cube * std::pow(2., -18), 1e-9) << "32 to 64 mm";
    EXPECT_NEAR(coordinate_rounding(single(places(1e4)), 1), of_cube * std::pow(2., -10), 1e-9);
    const Eigen::Matrix3Xd far = decimals(single(places(2e5)), 3);
    EXPECT_NEAR(coordinate_rounding(far, 1), of_cube * std::pow(2., -6), 1e-9) << "written with more decimals";
}

TEST(CoordinateRounding, IsThatOfTheLastSignificantDigitOfTheLargest)
{
    Eigen::Matrix3Xd x = places();
    for (double& c : x.reshaped()) {
        const double step = std::pow(10., std::floor(std::log10(std::abs(c))) - 4);
        c = step * std::round(c / step);
    }
    EXPECT_NEAR(coordinate_rounding(x, 1), of_cube * 1e-3, 1e-9);
}

} // namespace spia
