#include <cmath>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/unfold/plan/k_factor.h"
#include "tests/support/seeded_random.h"

namespace spia::k_factor_test {
namespace {

std::string refusal(const std::string& table)
{
    try {
        parse_k_table(table, "k.txt");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(KFactor, OfDinIsItsFormulaAndHalfBeyondFive)
{
    const KFactor din = din6935_k();
    for (double ratio = 0.051; ratio < 5; ratio *= 1.003)
        EXPECT_NEAR(din.at(ratio), (0.65 + 0.5 * std::log10(ratio)) / 2, 1e-7) << ratio;
    EXPECT_NEAR(din.at(1), 0.325, 1e-7); // k = 0.65, as tables of the standard have it
    EXPECT_EQ(din.at(5.01), 0.5);
    EXPECT_EQ(din.at(20), 0.5);
    EXPECT_GE(din.at(0), 0);
    EXPECT_EQ(din.at(0), din.at(0.05));
}

TEST(KFactor, IsAShareOfTheThickness)
{
    EXPECT_EQ(constant_k(0.44).at(0.1), 0.44);
    EXPECT_EQ(constant_k(0.44).name, "0.44");
    EXPECT_EQ(constant_k(0.5), KFactor{});
    for (const double wrong : {0., 1., -0.3, 1.2, std::nan(""), HUGE_VAL})
        EXPECT_THROW(constant_k(wrong), InputError) << wrong;
}

TEST(KFactor, OfATableIsLinearBetweenRowsAndConstantBeyond)
{
    for (const char* text : {"# R/t K\n0.5 0.33\n1.5\t0.39 # here\n\n3 0.45\n",
                             "R/t;K\r\n0.5;0.33\r\n1.5 ; 0.39\r\n3;0.45", "ratio, K\n0.5,0.33\n1.5, 0.39\n3 ,0.45\n"}) {
        const KFactor k = parse_k_table(text, "k.txt");
        EXPECT_EQ(k.at(0.1), 0.33) << text;
        EXPECT_EQ(k.at(0.5), 0.33);
        EXPECT_NEAR(k.at(1), 0.36, 1e-15);
        EXPECT_NEAR(k.at(2.25), 0.42, 1e-15);
        EXPECT_EQ(k.at(3), 0.45);
        EXPECT_EQ(k.at(30), 0.45);
    }
    EXPECT_EQ(parse_k_table("2 0.4", "k.txt").at(9), 0.4);
}

TEST(KFactor, ATableAtFaultIsRefusedWithItsLine)
{
    EXPECT_NE(refusal("").find("no row"), std::string::npos);
    EXPECT_NE(refusal("R/t K\n").find("no row"), std::string::npos);
    EXPECT_NE(refusal("1 0.4\n1 0.5").find("line 2"), std::string::npos);
    EXPECT_NE(refusal("1 0.4\n0.5 0.5").find("ascend"), std::string::npos);
    EXPECT_NE(refusal("1 0.4\nK R").find("line 2"), std::string::npos) << "a head is above the rows";
    for (const char* wrong : {"1", "1 0.4 0.5", "1 0", "1 1", "1 -0.4", "-1 0.4", "nan 0.4", "1 nan", "1 inf", "1,,0.4",
                              "1 0.4x", "0x1 0.4", "1e999 0.4", "1;0,4"})
        EXPECT_NE(refusal(wrong), "") << wrong;
    std::string long_one;
    for (int i = 0; i < 10'001; ++i)
        long_one += std::to_string(i) + " 0.4\n";
    EXPECT_NE(refusal(long_one).find("rows at most"), std::string::npos);
}

TEST(KFactor, ATableOfAnyBytesIsReadOrRefused)
{
    shapes::SeededRandom random(7);
    const std::string letters = "0123456789.eE+-,; \t\r\n#RKt/\xff";
    for (int trial = 0; trial < 20'000; ++trial) {
        std::string text;
        const int length = random.whole(0, 40);
        for (int i = 0; i < length; ++i)
            text += random.whole(0, 30) == 0 ? char(random.whole(-128, 127))
                                             : letters[size_t(random.whole(0, int(letters.size()) - 1))];
        try {
            const KFactor k = parse_k_table(text, "k.txt");
            for (const double ratio : {0., 0.3, 1., 10.}) {
                EXPECT_GT(k.at(ratio), 0);
                EXPECT_LT(k.at(ratio), 1);
            }
        } catch (const InputError&) {
        }
    }
}

} // namespace spia::k_factor_test
