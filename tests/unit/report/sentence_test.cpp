#include "engine/report/text/sentence.h"

#include <gtest/gtest.h>

namespace spia {

TEST(Sentence, BeginsWithACapitalLetterAndEndsWithAFullStop)
{
    EXPECT_EQ(as_sentence("two pieces; one is left out"), "Two pieces; one is left out");
    EXPECT_EQ(as_sentence("3 pieces"), "3 pieces");
    EXPECT_EQ(as_sentence("n = 0.252 is above 0.21"), "n = 0.252 is above 0.21") << "a symbol";
    EXPECT_EQ(as_sentence("a hole stays"), "A hole stays");
    EXPECT_EQ(as_sentence("\u00e9 stays"), "\u00e9 stays"); // not cut within a letter
    EXPECT_EQ(as_sentence("torn.stl, line 4: cut off"), "torn.stl, line 4: cut off") << "the name of a file";
    EXPECT_EQ(as_sentence("parts/torn: cut off"), "parts/torn: cut off");
    EXPECT_EQ(as_sentence("assets: no file"), "assets: no file") << "a folder";
    EXPECT_EQ(as_sentence("word"), "Word");
    EXPECT_EQ(as_sentence("opened."), "Opened.");
    EXPECT_EQ(as_sentence(""), "");
    EXPECT_EQ(sentence("two pieces"), "Two pieces.");
    EXPECT_EQ(sentence("is that in mm?"), "Is that in mm?");
    EXPECT_EQ(sentence(""), "");
}

} // namespace spia
