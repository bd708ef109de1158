#include "app/viewer/model/reports/manual.h"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <regex>
#include <set>
#include <sstream>

#include "engine/core/error.h"
#include "engine/options/all_options.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Kind = ManualBlock::Kind;

TEST(Manual, ReadsMarkdown)
{
    const ManualChapter chapter = manual_chapter("# First *steps*\n"
                                                 "Press **Open...** or\nsee [Export](export.md).\n\n"
                                                 "- one\n- two\n  - three\n\n"
                                                 "3. third\n4. fourth\n\n"
                                                 "| a | b |\n|---|---|\n| 1 | `2` |\n\n"
                                                 "![The window](pictures/window.png)\n",
                                                 "first.md", "manual");
    EXPECT_EQ(chapter.title, "First steps");
    ASSERT_EQ(chapter.blocks.size(), 9u);
    const auto& b = chapter.blocks;
    EXPECT_EQ(b[0].kind, Kind::heading);
    EXPECT_EQ(b[0].level, 1);
    EXPECT_EQ(b[1].kind, Kind::paragraph);
    EXPECT_EQ(b[1].plain(), "Press Open... or see Export.");
    const ManualText words = {
        {"Press "}, {"Open...", true}, {" or see "}, {"Export", false, false, "export.md"}, {"."}};
    EXPECT_EQ(b[1].text, words);
    EXPECT_EQ(b[2].kind, Kind::item);
    EXPECT_EQ(b[2].mark, "\u2022");
    EXPECT_EQ(b[4].plain(), "three");
    EXPECT_EQ(b[4].level, 2);
    EXPECT_EQ(b[5].mark, "3.");
    EXPECT_EQ(b[6].mark, "4.");
    EXPECT_EQ(b[6].level, 1);
    EXPECT_EQ(b[7].kind, Kind::table);
    ASSERT_EQ(b[7].rows.size(), 2u);
    EXPECT_EQ(b[7].rows[1][1], (ManualText{{"2", false, true}}));
    EXPECT_EQ(b[8].kind, Kind::picture);
    EXPECT_EQ(b[8].picture, fs::path("manual/pictures/window.png"));
    EXPECT_EQ(b[8].plain(), "The window");
    EXPECT_THROW(manual_chapter("no heading", "x.md", ""), InputError);
    EXPECT_THROW(manual_chapter("", "x.md", ""), InputError);
}

TEST(Manual, FindsWordsInAnyOrderAndCase)
{
    Manual manual;
    manual.chapters.push_back(
        manual_chapter("# Sheet\nThe *thickness* of the Sheet is typed.\n\n## Drawbeads\nOther.", "a.md", ""));
    manual.chapters.push_back(
        manual_chapter("# Files\n| what | how |\n|--|--|\n| blank | with thickness |\n", "b.md", ""));
    const auto found = places_of(manual, "THICKNESS");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].chapter, 0u);
    EXPECT_EQ(found[1].chapter, 1u) << "tables are searched";
    ASSERT_EQ(places_of(manual, "typed sheet").size(), 1u);
    EXPECT_EQ(places_of(manual, "sheet")[0].block, 0) << "headings first";
    EXPECT_TRUE(places_of(manual, "t").empty()) << "a letter is in everything";
    EXPECT_TRUE(places_of(manual, "zebra").empty());
}

/// All that the panels write on the screen: the labels of options, in percent and degrees as well,
/// and the string literals of the sources.
std::set<std::string> names_in_window()
{
    std::set<std::string> all;
    for (const Option* option : all_options()) {
        for (const char* unit : {"", ", %", ", degrees"})
            all.insert(std::string(option->label) + unit);
        for (const Choice& choice : option->choices)
            all.insert(std::string(label_of(choice)));
    }
    const std::regex literal(R"lit("((?:[^"\\\n]|\\.)*)")lit");
    for (const char* folder : {"panels", "model", "views"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(SPIA_SOURCE_DIR) / "app/viewer" / folder)) {
            std::ostringstream text;
            text << std::ifstream(entry.path()).rdbuf();
            const std::string source = text.str();
            for (std::sregex_iterator at(source.begin(), source.end(), literal), end; at != end; ++at) {
                const std::string found = (*at)[1];
                all.insert(found.substr(0, found.find("##"))); // what follows is not shown
                for (size_t from = 0; from < found.size();) {  // entries of a list
                    const size_t to = std::min(found.find("\\0", from), found.size());
                    all.insert(found.substr(from, to - from));
                    from = to + 2;
                }
            }
        }
    return all;
}

/// What the manual prints in bold is a button, a menu, a tool or a field: the program must have it.
TEST(Manual, NamesOnlyWhatTheWindowHas)
{
    const Manual manual = read_manual(SPIA_SOURCE_DIR "/assets/manual");
    ASSERT_GE(manual.chapters.size(), 12u);
    const std::set<std::string> known = names_in_window();
    int names = 0;
    const auto check = [&](const ManualText& text, const std::string& chapter) {
        for (const ManualSpan& span : text)
            if (span.bold) {
                ++names;
                EXPECT_TRUE(known.contains(span.text)) << chapter << ": **" << span.text << "**";
            }
    };
    for (const ManualChapter& chapter : manual.chapters)
        for (const ManualBlock& block : chapter.blocks) {
            check(block.text, chapter.file);
            for (const auto& row : block.rows)
                for (const ManualText& cell : row)
                    check(cell, chapter.file);
        }
    EXPECT_GT(names, 100);
}

TEST(Manual, LinksAndPicturesLeadSomewhere)
{
    const fs::path folder = SPIA_SOURCE_DIR "/assets/manual";
    const Manual manual = read_manual(folder);
    int links = 0;
    const auto follow = [&](const ManualText& text, const std::string& chapter) {
        for (const ManualSpan& span : text)
            if (!span.link.empty()) {
                ++links;
                EXPECT_GE(manual.chapter(span.link), 0) << chapter << ": " << span.link;
            }
    };
    std::set<fs::path> pictures;
    for (const ManualChapter& chapter : manual.chapters)
        for (const ManualBlock& block : chapter.blocks) {
            follow(block.text, chapter.file);
            for (const auto& row : block.rows)
                for (const ManualText& cell : row)
                    follow(cell, chapter.file);
            if (block.kind == Kind::picture) {
                ASSERT_TRUE(fs::exists(block.picture)) << block.picture;
                EXPECT_LT(fs::file_size(block.picture), 150'000u) << block.picture;
                EXPECT_NE(block.plain(), "") << "says what it shows";
                pictures.insert(block.picture);
            }
        }
    EXPECT_GT(links, 10);
    EXPECT_GE(pictures.size(), 4u);
    EXPECT_LE(pictures.size(), 12u);
    for (const auto& entry : fs::directory_iterator(folder)) // none is forgotten
        if (entry.path().extension() == ".md") {
            EXPECT_GE(manual.chapter(entry.path().filename().string()), 0) << entry.path();
        }
}

} // namespace
} // namespace spia::viewer
