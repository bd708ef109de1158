#include "app/viewer/model/reports/viewer_words.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <regex>

#include "tests/unit/exchange/scratch_folder.h"

namespace spia::viewer {

TEST(ViewerWords, ASentenceBeginsWithACapitalLetter)
{
    EXPECT_EQ(as_sentence("two pieces; one is left out"), "Two pieces; one is left out");
    EXPECT_EQ(as_sentence("3 pieces"), "3 pieces");
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

TEST(ViewerWords, NameButtonsInPlaceOfFlags)
{
    EXPECT_EQ(in_viewer_words("close the crack (--weld 0.0062); keep one"),
              "close the crack (\"Close the crack\" in the step Part); keep one");
    EXPECT_EQ(in_viewer_words("join them (--weld); keep one (--keep-largest)"),
              "join them (\"Weld vertices\" in the step Part); keep one (\"Keep the largest piece\" in the step Part)");
    EXPECT_EQ(in_viewer_words("nothing -- to say"), "nothing -- to say");
}

TEST(ViewerWords, LeaveNoFlagOfTheEngineAsItIs)
{
    const std::regex flag(R"re("[^"\n]*(--[a-z][a-z-]*)[^"\n]*")re");
    int found = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(SPIA_SOURCE_DIR "/engine")) {
        // read by the command line alone
        if (file.path().extension() != ".cpp" || file.path().stem() == "tensile_test")
            continue;
        const std::string text = content_of(file.path());
        for (std::sregex_iterator at(text.begin(), text.end(), flag), end; at != end; ++at, ++found)
            EXPECT_EQ(in_viewer_words((*at)[1]).find("--"), std::string::npos) << file.path() << ": " << at->str();
    }
    EXPECT_GE(found, 4) << "the doctor advises flags of the command line";
}

} // namespace spia::viewer
