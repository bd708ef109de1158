#include "engine/exchange/text/fixed_number.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "engine/core/error.h"
#include "engine/core/read_number.h"

namespace spia {

TEST(FixedNumber, HasItsWidthABlankAPointAndReadsBackToThePrecisionPromised)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> mantissa(1, 10), exponent(-98, 98);
    for (const int width : {10, 16, 20}) {
        const double promised = 0.5 * std::pow(10, 8 - width);
        double worst = 0;
        for (int i = 0; i < 20000; ++i) {
            const double size = mantissa(random) * std::pow(10, i % 2 ? std::floor(exponent(random)) : i % 9 - 4);
            const double value = i % 3 ? size : -size;
            const std::string text = fixed_number(value, width);
            ASSERT_EQ(int(text.size()), width) << text;
            ASSERT_EQ(text[0], ' ') << text;
            ASSERT_NE(text.find('.'), text.npos) << text;
            const auto read = read_number(text);
            ASSERT_TRUE(read) << text;
            worst = std::max(worst, std::abs(*read / value - 1));
        }
        EXPECT_LE(worst, promised * (1 + 1e-6)) << width;
        EXPECT_GT(worst, promised / 10) << width; // no digit is given away
    }
}

TEST(FixedNumber, KeepsAllDigitsWhereTheyFit)
{
    EXPECT_EQ(fixed_number(-1226.6, 16), "         -1226.6");
    EXPECT_EQ(fixed_number(12.0, 10), "      12.0");
    EXPECT_EQ(fixed_number(1e20, 16), "         1.0E+20");
    EXPECT_EQ(fixed_number(-0.0, 10), "       0.0");
    EXPECT_EQ(fixed_number(1e-7, 16), "         1.0E-07");
    EXPECT_EQ(fixed_number(-1.2345678901234567e-103, 16), " -1.2345679E-103");
    EXPECT_THROW(fixed_number(std::numeric_limits<double>::quiet_NaN(), 16), InputError);
}

TEST(FixedNumber, IdsFillTheirColumnsAndNoMore)
{
    EXPECT_EQ(fixed_number(99999999, 8), "99999999");
    EXPECT_EQ(fixed_number(7, 8), "       7");
    EXPECT_THROW(fixed_number(100000000, 8), InputError);
}

} // namespace spia
