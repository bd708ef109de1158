#include "engine/core/text.h"

#include <gtest/gtest.h>

namespace spia {
namespace {

TEST(Text, OnlyLettersOfAsciiAreMadeSmall)
{
    EXPECT_EQ(lower_case("AbZ@[`{19 \xc3\x84\xc3\x9c"), "abz@[`{19 \xc3\x84\xc3\x9c");
    EXPECT_EQ(lower_case(""), "");
}

TEST(Text, CharactersAreAsLongAsUtf8Says)
{
    EXPECT_EQ(utf8_length("a"), 1u);
    EXPECT_EQ(utf8_length("\xc3\xbc!"), 2u);        // u umlaut
    EXPECT_EQ(utf8_length("\xe2\x82\xac"), 3u);     // euro
    EXPECT_EQ(utf8_length("\xf0\x9f\x98\x80"), 4u); // beyond 16 bits
    // Alone, cut off, longer than needed, a half of a pair, beyond the last one, nothing.
    for (const char* none :
         {"\x80", "\xc3", "\xe2\x82", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff"})
        EXPECT_EQ(utf8_length(none), 0u) << none;
}

} // namespace
} // namespace spia
