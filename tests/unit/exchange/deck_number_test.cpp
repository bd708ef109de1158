#include "engine/core/read_number.h"

#include <gtest/gtest.h>

#include "engine/exchange/deck/node_numbers.h"
#include "engine/exchange/text/text_encoding.h"

namespace spia {
namespace {

TEST(ReadNumber, IsReadAsFortranWritesIt)
{
    const std::pair<const char*, double> known[] = {
        {"1", 1},         {" 12.5 ", 12.5}, {"\t-.5", -0.5},    {"+3.", 3},      {"1.5-3", 1.5e-3}, {"1.+5", 1e5},
        {"-7.5+2", -750}, {".25-1", 0.025}, {"1.5D-3", 1.5e-3}, {"2.d+04", 2e4}, {"1.e+06", 1e6},   {"8.64E8", 8.64e8},
        {"1D3", 1000},    {"7+3", 7000},    {"1e-400", 0},      {"1.-400", 0}};
    for (const auto& [text, value] : known) {
        const auto read = read_number(text);
        ASSERT_TRUE(read) << text;
        EXPECT_DOUBLE_EQ(*read, value) << text;
    }
    EXPECT_EQ(read_number("0.1"), 0.1); // the nearest double, not the sum of digits
    EXPECT_EQ(read_number("317.598037570512"), 317.598037570512);
}

TEST(ReadNumber, IsNothingIfItIsNoFiniteNumber)
{
    for (const char* text : {"",     " ",    "-",    "+",       ".",    "nan", "inf", "-inf", "1e999", "1.+999", "1,5",
                             "1.5x", "0x10", "1.5-", "1.5-3-2", "1.5D", "--1", "+-1", "1 2",  "e5",    "1.5e",   "&t"})
        EXPECT_FALSE(read_number(text)) << text;
    EXPECT_FALSE(read_number(std::string(100, '1') + "D2")); // longer than any that is written so
}

TEST(ReadNumber, WholeNumbersMayHaveAPointButNoFraction)
{
    EXPECT_EQ(read_whole_number(" 12 "), 12);
    EXPECT_EQ(read_whole_number("+12"), 12);
    EXPECT_EQ(read_whole_number("-3"), -3);
    EXPECT_EQ(read_whole_number("12."), 12);
    EXPECT_EQ(read_whole_number("12.00"), 12);
    EXPECT_EQ(read_whole_number("9999999999"), 9999999999);
    for (const char* text : {"", "+-1", "12.5", "1e3", "x", "99999999999999999999", "1 2", "- 3"})
        EXPECT_FALSE(read_whole_number(text)) << text;
}

TEST(NodeNumbers, AreTheSameByTableAndByBisection)
{
    const std::vector<std::int64_t> dense = {7, 5, 6, 9, 5},
                                    sparse = {7, 5'000'000'000, 6, -9'000'000'000'000'000'000, 6};
    const NodeNumbers by_table(dense, 10), by_bisection(sparse, 10);
    EXPECT_EQ(by_table[7], 10);
    EXPECT_EQ(by_table[5], 11); // the first of two
    EXPECT_EQ(by_table[9], 13);
    EXPECT_EQ(by_bisection[5'000'000'000], 11);
    EXPECT_EQ(by_bisection[6], 12);
    EXPECT_EQ(by_bisection[-9'000'000'000'000'000'000], 13);
    for (const std::int64_t none : {std::int64_t(8), std::int64_t(4), std::int64_t(10), INT64_MIN, INT64_MAX}) {
        EXPECT_EQ(by_table[none], -1);
        EXPECT_EQ(by_bisection[none], -1);
    }
    EXPECT_EQ(NodeNumbers({}, 0)[0], -1);
}

TEST(Readable, TextIsUtf8WhateverItWas)
{
    EXPECT_EQ(readable("T\xc3\xbcr"), "T\xc3\xbcr");
    EXPECT_EQ(readable("T\xfcr"), "T\xc3\xbcr"); // Latin-1
    EXPECT_EQ(readable("\xe2\x82\xac"), "\xe2\x82\xac");
    EXPECT_EQ(readable("a\tb\x01"), "a b ");
    EXPECT_EQ(readable("\xe2\x82"), "\xc3\xa2\xc2\x82"); // cut off
    EXPECT_EQ(readable("\xe0\x80\x80"), "\xc3\xa0\xc2\x80\xc2\x80");
    EXPECT_EQ(readable("\xc0\xaf"), "\xc3\x80\xc2\xaf");             // overlong
    EXPECT_EQ(readable("\xed\xa0\x80"), "\xc3\xad\xc2\xa0\xc2\x80"); // half a surrogate pair
    EXPECT_EQ(readable("\xf0\x9f\x9a\x97"), "\xf0\x9f\x9a\x97");
}

} // namespace
} // namespace spia
