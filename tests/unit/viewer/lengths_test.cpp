#include "app/viewer/model/lengths.h"

#include <cmath>
#include <gtest/gtest.h>

#include "app/viewer/views/colour_scale.h"

namespace spia::viewer {
namespace {

constexpr LengthUnit mm = LengthUnit::mm, inch = LengthUnit::inch;

TEST(Lengths, AnInchIs25Point4Millimetres) // by definition of 1959
{
    EXPECT_EQ(shown_length(25.4, inch), 1);
    EXPECT_EQ(shown_length(25.4, mm), 25.4);
    EXPECT_EQ(kept_length(0.5, inch), 12.7);
    EXPECT_EQ(length_text(25.4, inch), "1 in");
    EXPECT_EQ(length_text(12.345, mm), "12.35 mm");
    EXPECT_EQ(in_unit("Offset", inch), "Offset, in");
}

TEST(Lengths, AreasAndCurvaturesGoWithTheirPower)
{
    EXPECT_NEAR(as_shown("mm\u00b2", inch).factor, 1 / 645.16, 1e-15);
    EXPECT_EQ(as_shown("mm\u00b2", inch).unit, "in\u00b2");
    EXPECT_NEAR(as_shown("1/mm", inch).factor, 25.4, 1e-14);
    EXPECT_EQ(as_shown("1/mm\u00b2", inch).unit, "1/in\u00b2");
    EXPECT_NEAR(as_shown("1/mm\u00b2", inch).factor, 645.16, 1e-12);
    for (const char* unit : {"MPa", "%", "", "\u00b0", "zone"}) {
        EXPECT_EQ(as_shown(unit, inch).factor, 1) << unit;
        EXPECT_EQ(as_shown(unit, inch).unit, unit);
    }
    for (const char* unit : {"mm", "mm\u00b2", "1/mm", "1/mm\u00b2"})
        EXPECT_EQ(as_shown(unit, mm).factor, 1) << unit;
}

TEST(Lengths, GaugesOfSheetStayApartInInch)
{
    // Manufacturers' standard gauges 20 and 21 of steel sheet: 0.0359 and 0.0329 in.
    EXPECT_EQ(thickness_text(0.0359 * 25.4, inch), "0.0359 in");
    EXPECT_EQ(thickness_text(0.0329 * 25.4, inch), "0.0329 in");
    EXPECT_EQ(thickness_text(0.8, mm), "0.8 mm");
    EXPECT_EQ(thickness_text(0.8, inch), "0.0315 in");
    EXPECT_EQ(fixed_length(1, inch, 2), "0.0394 in");
    EXPECT_EQ(fixed_length(1, mm, 2, true), "+1.00 mm");
    EXPECT_EQ(plain_length(0, inch), "0 in");
}

TEST(Lengths, ValuesOfFieldsAreShownInTheUnit)
{
    EXPECT_EQ(value_text(25.4, "mm", inch), "1.00 in");
    EXPECT_EQ(value_text(0.01, "1/mm", inch), "0.254 1/in");
    EXPECT_EQ(value_text(12.345, "%", inch), "12.3 %");
    EXPECT_EQ(value_text(1234.5, "mm", mm), "1234 mm");
}

/// The values written beside the colours are round in the unit in which they are written, whichever that is.
TEST(Lengths, LegendsAreRoundInInch)
{
    FieldDisplay display;
    display.field = Field::thickness;
    const double factor = as_shown("mm", inch).factor;
    const ColourScale scale = field_scale(display, {0.71, 1.09}, 200, factor);
    EXPECT_LE(scale.least, 0.71f);
    EXPECT_GE(scale.greatest, 1.09f);
    const double step = factor * (double(scale.greatest) - double(scale.least)) / scale.ticks;
    const double power = std::pow(10, std::floor(std::log10(step) + 1e-9)), leading = step / power;
    EXPECT_TRUE(std::abs(leading - 1) < 1e-4 || std::abs(leading - 2) < 1e-4 || std::abs(leading - 2.5) < 1e-4 ||
                std::abs(leading - 5) < 1e-4)
        << step;
    for (const double value : tick_values(scale))
        EXPECT_NEAR(std::stod(tick_text(scale, value)), factor * value, 1e-6) << "no digits are lost";
}

} // namespace
} // namespace spia::viewer
