#include "app/viewer/model/reports/typed_number.h"

#include <gtest/gtest.h>

namespace spia::viewer {

TEST(TypedNumber, HasAPointOrACommaBeforeItsDecimals)
{
    for (const auto& [text, value] : {std::pair{"0,8", 0.8},
                                      {"0.8", 0.8},
                                      {" ,5 ", 0.5},
                                      {"-1,25", -1.25},
                                      {"+3", 3.},
                                      {"12", 12.},
                                      {"1e-7", 1e-7},
                                      {"1,5E+3", 1500.},
                                      {"0.42137", 0.42137}})
        EXPECT_EQ(typed_number_of(text), value) << text;
}

TEST(TypedNumber, IsNoneWhereACharacterWouldBePassedOver)
{
    for (const char* text : {"", " ", "abc", "0,8,1", "1.000,5", "1,000.5", "1 000", "1'000", "0.8x", "nan", "inf",
                             "1e999", "--1", "1-3", "1d3", "2*3", "mm", "0,8 inch"})
        EXPECT_FALSE(typed_number_of(text, {"mm"})) << text;
}

TEST(TypedNumber, MayHaveItsUnitBehindIt)
{
    EXPECT_EQ(typed_number_of("0,8 mm", {"mm"}), 0.8);
    EXPECT_EQ(typed_number_of("0.8mm", {"", "mm"}), 0.8);
    EXPECT_EQ(typed_number_of("15 %", {"mm", "%"}), 15);
    EXPECT_FALSE(typed_number_of("15 % %", {"%"}));
}

TEST(TypedNumber, IsRefusedWithWhatWasTyped)
{
    EXPECT_EQ(refused_number(" 0,8,1", "Thickness, mm", "1"), "\"0,8,1\" is not a number. Thickness stays 1.");
    EXPECT_EQ(refused_number("x", "", "0.5"), "\"x\" is not a number. The value stays 0.5.");
    EXPECT_EQ(field_name("Thickness, mm").unit, "mm");
    EXPECT_EQ(field_name("K").unit, "");
}

} // namespace spia::viewer
