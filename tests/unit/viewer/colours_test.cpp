#include "app/viewer/views/colours.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/palette.h"
#include "engine/core/colour_map.h"

namespace spia::viewer {
namespace {

double difference(const Oklab& a, const Oklab& b) { return std::hypot(a.L - b.L, std::hypot(a.a - b.a, a.b - b.b)); }

/// What is left of a colour for somebody without the long- or medium-wave cones: the mean of those
/// two, roughly.
Oklab without_red_and_green(const Oklab& colour) { return {colour.L, 0, colour.b}; }

TEST(Oklab, AgreesWithThePublishedValuesOfWhiteRedAndBlue)
{
    // [Ottosson 2020]: white and the primaries of sRGB.
    const Oklab white = oklab({1, 1, 1}), red = oklab({1, 0, 0}), blue = oklab({0, 0, 1});
    EXPECT_LT(difference(white, {1, 0, 0}), 1e-4);
    EXPECT_LT(difference(red, {0.62796, 0.22486, 0.12585}), 1e-4);
    EXPECT_LT(difference(blue, {0.45201, -0.03246, -0.31153}), 1e-4);
}

TEST(Oklab, GoesThereAndBack)
{
    for (const Eigen::Vector3d& rgb : {Eigen::Vector3d(0.2, 0.5, 0.9), Eigen::Vector3d(0.01, 0.99, 0.4)})
        EXPECT_LT((srgb(oklab(rgb)) - rgb).norm(), 1e-6);
}

TEST(DivergingMap, IsEquallyLightOnBothSidesAndLightestInTheMiddle)
{
    for (double away = 0.02; away <= 0.5; away += 0.02) {
        const double below = oklab(map_colour(ColourMap::diverging, 0.5 - away)).L;
        EXPECT_NEAR(below, oklab(map_colour(ColourMap::diverging, 0.5 + away)).L, 0.004)
            << away; // not cut at the gamut
        EXPECT_LT(below, oklab(map_colour(ColourMap::diverging, 0.5 - away + 0.02)).L);
    }
    const Oklab middle = oklab(map_colour(ColourMap::diverging, 0.5));
    EXPECT_LT(std::hypot(middle.a, middle.b), 1e-6) << "the middle is grey";
}

TEST(DivergingMap, StepsOfEqualLengthLookSimilarlyLarge)
{
    double least = 1, greatest = 0;
    for (int i = 0; i < 20; ++i) {
        const double step = difference(oklab(map_colour(ColourMap::diverging, i / 20.0)),
                                       oklab(map_colour(ColourMap::diverging, (i + 1) / 20.0)));
        least = std::min(least, step);
        greatest = std::max(greatest, step);
    }
    EXPECT_LT(greatest / least, 1.5);
}

TEST(DivergingMap, ItsSidesDifferEvenForEyesWithoutRedAndGreen)
{
    for (double away = 0.1; away <= 0.5; away += 0.1)
        EXPECT_GT(difference(without_red_and_green(oklab(map_colour(ColourMap::diverging, 0.5 - away))),
                             without_red_and_green(oklab(map_colour(ColourMap::diverging, 0.5 + away)))),
                  0.35 * away);
}

TEST(ColourOf, ClampsToTheRangeAndPutsEveryValueOfABandInOneColour)
{
    const ColourScale smooth{.least = 2, .greatest = 4};
    const auto rgb = [](const Colour& c) { return Eigen::Vector3d(c[0], c[1], c[2]); };
    EXPECT_LT((rgb(colour_of(smooth, 2.5f)) - viridis(0.25)).norm(), 1e-6);
    EXPECT_LT((rgb(colour_of(smooth, -7)) - viridis(0)).norm(), 1e-6);
    EXPECT_LT((rgb(colour_of(smooth, 9)) - viridis(1)).norm(), 1e-6);
    ColourScale bands = smooth;
    bands.bands = 4; // of 0.5
    EXPECT_EQ(colour_of(bands, 2.51f), colour_of(bands, 2.99f));
    EXPECT_NE(colour_of(bands, 2.99f), colour_of(bands, 3.01f));
    EXPECT_LT((rgb(colour_of(bands, 4)) - viridis(1)).norm(), 1e-6);
    EXPECT_EQ(colour_of(smooth, std::numeric_limits<float>::quiet_NaN()), no_value);
}

TEST(RoundRange, HoldsTheValuesInRoundIntervalsOfWhichThereAreFourToTen)
{
    for (const double least : {-317.2, -0.034, 0.0, 0.97, 12.5, 1e5})
        for (const double length : {1e-4, 0.031, 1.0, 7.77, 420.0, 9.9e5}) {
            if (length < 1e-4 * std::abs(least))
                continue; // beyond the digits of a float
            const RoundRange range = round_range(least, least + length);
            EXPECT_LE(range.least, least + 1e-8 * length);
            EXPECT_GE(range.greatest, least + length - 1e-8 * length);
            EXPECT_GE(range.intervals, 4);
            EXPECT_LE(range.intervals, 10);
            const double step = (range.greatest - range.least) / range.intervals;
            const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
            EXPECT_LT(std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 2.5),
                                std::abs(mantissa - 5)}),
                      1e-6)
                << step;
            EXPECT_NEAR(range.least / step, std::round(range.least / step), 1e-4) << "a tick is at a round value";
        }
}

TEST(RoundRange, WithANumberOfIntervalsItHasJustThose)
{
    for (const int intervals : {2, 3, 5, 8, 13}) {
        const RoundRange range = round_range(0.13, 0.91, intervals);
        EXPECT_EQ(range.intervals, intervals);
        EXPECT_LE(range.least, 0.13);
        EXPECT_GE(range.greatest, 0.91);
        const RoundRange both = round_range(-0.13, 0.91, intervals, true);
        EXPECT_EQ(both.least, -both.greatest);
        EXPECT_GE(both.greatest, 0.91);
    }
}

TEST(RoundRange, OfASingleValueHasALength)
{
    for (const double value : {-3.0, 0.0, 1e-9, 250.0})
        for (const bool about_zero : {false, true}) {
            const RoundRange range = round_range(value, value, 0, about_zero);
            EXPECT_GT(range.greatest, range.least);
            EXPECT_LE(range.least, value);
            EXPECT_GE(range.greatest, value);
        }
}

TEST(FieldScale, IsSymmetricWhereZeroMattersAndObeysTheUser)
{
    FieldDisplay display;
    display.field = Field::strain_minor;
    const ColourScale automatic = field_scale(display, {-0.31, 0.12});
    EXPECT_EQ(automatic.map, ColourMap::diverging);
    EXPECT_EQ(automatic.least, -automatic.greatest);
    display.range = {{-0.2, 0.4}};
    display.map = ColourMap::grey;
    display.bands = 7;
    const ColourScale asked = field_scale(display, {-0.31, 0.12});
    EXPECT_EQ(asked.map, ColourMap::grey);
    EXPECT_FLOAT_EQ(asked.least, -0.2f);
    EXPECT_FLOAT_EQ(asked.greatest, 0.4f);
    EXPECT_EQ(asked.ticks, 7);
    display.bands = 0;
    display.range = {{0, 20}};
    EXPECT_EQ(field_scale(display, {0, 1}).ticks, 8) << "of 2.5";
}

TEST(FieldScale, KeepsTheRangeOfTheUserWhateverTheBands)
{
    FieldDisplay display;
    display.field = Field::thinning;
    display.range = {{-3.3, 17.7}};
    for (const int bands : {0, 1, 3, 7, 20}) {
        display.bands = bands;
        const ColourScale scale = field_scale(display, {-40, 60}, 1000);
        EXPECT_FLOAT_EQ(scale.least, -3.3f) << bands;
        EXPECT_FLOAT_EQ(scale.greatest, 17.7f) << bands;
    }
    display.range = {{0, 1e-7}};
    EXPECT_FLOAT_EQ(field_scale(display, {0, 1}, 1000).greatest, 1e-7f) << "also a range of noise";
    EXPECT_EQ(noise_note(display, {0, 1e-9}, 1000), "");
}

TEST(FieldScale, DoesNotMakeALandscapeOfNoise)
{
    FieldDisplay display;
    const double size = 500, noise = 1e-9;
    const struct {
        Field field;
        double base, shortest;
    } cases[] = {{Field::strain_major, 0, 1e-4}, {Field::strain_minor, 0, 1e-4}, {Field::thinning, 0, 1e-2},
                 {Field::thickness, 1, 1e-4},    {Field::deviation, 0, 5e-4},    {Field::stress_equivalent, 240, 0.1}};
    for (const auto& [field, base, shortest] : cases) {
        display.field = field;
        const ColourScale scale = field_scale(display, {base - noise, base + noise}, size);
        EXPECT_GE(scale.greatest - scale.least, 0.99 * shortest) << info(field).name;
        const auto t = [&](double v) { return (v - scale.least) / (double(scale.greatest) - double(scale.least)); };
        EXPECT_LT(std::abs(t(base + noise) - t(base - noise)), 1e-3) << "one colour: " << info(field).name;
        EXPECT_NE(noise_note(display, {base - noise, base + noise}, size), "") << info(field).name;
        const double wide = 10 * shortest; // what is no noise is coloured as ever
        EXPECT_EQ(noise_note(display, {base - wide, base + wide}, size), "") << info(field).name;
        const ColourScale full = field_scale(display, {base - wide, base + wide}, size);
        const RoundRange range = round_range(base - wide, base + wide, 0, info(field).diverging);
        EXPECT_FLOAT_EQ(full.least, float(range.least));
        EXPECT_FLOAT_EQ(full.greatest, float(range.greatest));
    }
}

TEST(DivergingMap, IsLightestAtZeroInEveryRange)
{
    for (const auto& [least, greatest] : {std::pair(-0.2f, 0.4f), {-3.f, 1.f}, {-1.f, 1.f}}) {
        const ColourScale scale{.map = ColourMap::diverging, .least = least, .greatest = greatest};
        const auto rgb = [&](float v) {
            const Colour c = colour_of(scale, v);
            return Eigen::Vector3d(c[0], c[1], c[2]);
        };
        EXPECT_LT((rgb(0) - map_colour(ColourMap::diverging, 0.5)).norm(), 1e-6);
        EXPECT_LT((rgb(least) - map_colour(ColourMap::diverging, 0)).norm(), 1e-6);
        EXPECT_LT((rgb(greatest) - map_colour(ColourMap::diverging, 1)).norm(), 1e-6);
        EXPECT_LT((rgb(least / 2) - map_colour(ColourMap::diverging, 0.25)).norm(), 1e-5);
        EXPECT_LT((rgb(greatest / 2) - map_colour(ColourMap::diverging, 0.75)).norm(), 1e-5);
    }
    // no zero: one half of the map
    const ColourScale above{.map = ColourMap::diverging, .least = 5, .greatest = 20};
    EXPECT_NEAR(place_in_map(above, 1), 1, 1e-12);
    EXPECT_NEAR(place_in_map(above, 0), 0.5 + 0.5 * 5 / 20, 1e-12);
    // of 0.5, zero between two
    ColourScale bands{.map = ColourMap::diverging, .least = -1, .greatest = 3, .bands = 8};
    for (const float v : {-0.9f, -0.3f})
        EXPECT_GT(colour_of(bands, v)[2], colour_of(bands, v)[0]) << "blue below zero: " << v;
    for (const float v : {0.6f, 2.9f})
        EXPECT_GT(colour_of(bands, v)[0], colour_of(bands, v)[2]) << "orange above: " << v;
}

TEST(LegendTicks, OfANarrowRangeFarFromZeroAreDifferent)
{
    const SceneLegend legend{"Thickness", "mm", {.least = 0.99995f, .greatest = 1.00005f, .ticks = 4}};
    std::set<std::string> texts;
    for (const LegendTick& tick : legend_ticks(legend, 9))
        texts.insert(tick.text);
    EXPECT_EQ(texts.size(), 5u);
}

TEST(LegendTicks, AreRoundWithBothEndsAndTellOfValuesBeyond)
{
    SceneLegend legend{"Thinning", "%", {.least = -0.1f, .greatest = 0.3f, .ticks = 8}};
    const auto texts = [&](int most) {
        std::vector<std::string> result;
        for (const LegendTick& tick : legend_ticks(legend, most))
            result.push_back(tick.text);
        return result;
    };
    EXPECT_EQ(texts(20), (std::vector<std::string>{"-0.1", "-0.05", "0", "0.05", "0.1", "0.15", "0.2", "0.25", "0.3"}));
    legend.above = true;
    EXPECT_EQ(texts(5), (std::vector<std::string>{"-0.1", "0", "0.1", "0.2", "\u2265 0.3"}));
    legend.below = true;
    EXPECT_EQ(texts(4), (std::vector<std::string>{"\u2264 -0.1", "0", "0.15", "\u2265 0.3"}));
    // zero is what matters
    EXPECT_EQ(texts(3), (std::vector<std::string>{"\u2264 -0.1", "0", "\u2265 0.3"}));
    for (int most = 2; most < 12; ++most) {
        const auto ticks = legend_ticks(legend, most);
        EXPECT_LE(int(ticks.size()), most);
        EXPECT_EQ(ticks.front().share, 0);
        EXPECT_EQ(ticks.back().share, 1);
    }
}

TEST(LegendTicks, ValuesJustAtTheEndsAreNotBeyond)
{
    // not the same numbers in double precision
    const ColourScale scale{.least = 0.1f, .greatest = 0.7f};
    EXPECT_FALSE(below(scale, 0.1) || above(scale, 0.7));
    EXPECT_TRUE(below(scale, 0.099) && above(scale, 0.701));
}

TEST(ValueText, HasThreeDigitsAndTheUnit)
{
    EXPECT_EQ(value_text(12.345, "%"), "12.3 %");
    EXPECT_EQ(value_text(-0.01234, ""), "-0.0123");
    EXPECT_EQ(value_text(412.6, "MPa"), "413 MPa");
    EXPECT_EQ(value_text(1234.5, "mm"), "1234 mm");
    EXPECT_EQ(value_text(0, "mm"), "0 mm");
    EXPECT_EQ(value_text(15.2, "\u00b0"), "15.2\u00b0");
    EXPECT_EQ(value_text(std::numeric_limits<double>::quiet_NaN(), "mm"), "no value");
}

TEST(SideColours, TellTheFourSidesApartAndAreEquallyLight)
{
    const auto sides = palette::sides();
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < i; ++j) {
            const Oklab a = oklab({sides[i][0], sides[i][1], sides[i][2]});
            const Oklab b = oklab({sides[j][0], sides[j][1], sides[j][2]});
            EXPECT_GT(difference(a, b), 0.15);
            EXPECT_NEAR(a.L, b.L, 0.03);
        }
}

/// An engineer reads an axis by its round numbers, of which 0 is one.
TEST(AxisNumbers, AreWholeStepsFromZeroOfARoundLength)
{
    for (const auto& [least, greatest] : {std::pair(-0.13, 0.31), std::pair(-0.11, 0.11), std::pair(0., 0.42),
                                          std::pair(-3.7, 12.), std::pair(-0.7, 0.02), std::pair(-240., 910.)})
        for (int most = 2; most <= 9; ++most) {
            const std::vector<double> numbers = axis_numbers(round_range(least, greatest), most);
            ASSERT_FALSE(numbers.empty());
            EXPECT_TRUE(std::any_of(numbers.begin(), numbers.end(), [](double each) { return each == 0; }))
                << least << " to " << greatest << ", " << most;
            if (numbers.size() < 2)
                continue;
            const double step = numbers[1] - numbers[0],
                         digit = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
            EXPECT_TRUE(std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 || std::abs(digit - 2.5) < 1e-6 ||
                        std::abs(digit - 5) < 1e-6)
                << step;
            EXPECT_LE(int(numbers.size()), std::max(most, 3));
            for (size_t k = 1; k < numbers.size(); ++k)
                EXPECT_NEAR(numbers[k] - numbers[k - 1], step, 1e-9 * step);
        }
}

TEST(AxisNumbers, ThoseOfAStrainDiagramAreTenths) // not 0.3, 0.1, -0.1
{
    const std::vector<double> numbers = axis_numbers({-0.1, 0.4, 5}, 4);
    ASSERT_EQ(numbers.size(), 3u);
    EXPECT_EQ(numbers[0], 0);
    EXPECT_NEAR(numbers[1], 0.2, 1e-12);
    EXPECT_NEAR(numbers[2], 0.4, 1e-12);
}

} // namespace
} // namespace spia::viewer
