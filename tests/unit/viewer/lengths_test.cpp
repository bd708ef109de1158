#include "engine/report/text/lengths.h"

#include <cmath>
#include <gtest/gtest.h>

#include "app/viewer/views/colour_scale.h"
#include "engine/report/text/shown_lengths.h"

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

/// The values written beside the colours are round in the unit in which they are written, whichever
/// that is.
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

TEST(Lengths, WhatTheEngineSaysIsToldInTheUnitOfTheScreen)
{
    const auto in = [](const char* text) { return in_shown_lengths(text, inch); };
    EXPECT_EQ(in("the surface deviates by 0.254 mm where 0.1 mm are allowed"),
              "the surface deviates by 0.01 in where 0.00394 in are allowed");
    EXPECT_EQ(in("it folds at u = 0.31, v = 0.5 (12.7, 25.4, -2.54 mm)"),
              "it folds at u = 0.31, v = 0.5 (0.5, 1, -0.1 in)");
    EXPECT_EQ(in("on 254 of 508 mm of the edge"), "on 10 of 20 in of the edge");
    EXPECT_EQ(in("a sheet of 25.4 x 50.8 mm."), "a sheet of 1 x 2 in.");
    EXPECT_EQ(in("1290.32 mm2, 645.16 mm^2 and 64.516 mm\u00b2"), "2 in\u00b2, 1 in\u00b2 and 0.1 in\u00b2");
    EXPECT_EQ(in("restrains with 120 N/mm, 1200 MPa"), "restrains with 120 N/mm, 1200 MPa");
    EXPECT_EQ(in("curvature 0.1 1/mm"), "curvature 0.1 1/mm");
    EXPECT_EQ(in("Opened plate 10 mm.stl, part_12.5 mm"), "Opened plate 10 mm.stl, part_12.5 mm");
    EXPECT_EQ(in("lengths in mm"), "lengths in mm");
    EXPECT_EQ(in("the sheet is 50.8 mm thick: is that in mm?"), "the sheet is 2 in thick: is that in inch?");
    EXPECT_EQ(in_shown_lengths("12.7 mm, 3 mm2", mm), "12.7 mm, 3 mm2");
}

TEST(Lengths, NoiseOfTheArithmeticIsNothing)
{
    EXPECT_EQ(in_shown_lengths("flat (within 6.4e-13 mm)", mm), "flat (within 0 mm)");
    EXPECT_EQ(in_shown_lengths("flat (within 6.4e-13 mm)", inch), "flat (within 0 in)");
    EXPECT_EQ(in_shown_lengths("within 2e-05 mm", mm), "within 2e-05 mm");
    EXPECT_EQ(length_text(6.7e-16, mm), "0 mm");
    EXPECT_EQ(plain_length(-6.7e-16, inch), "0 in");
    EXPECT_EQ(length_text(1e-5, mm), "1e-05 mm");
}

} // namespace
} // namespace spia::viewer
