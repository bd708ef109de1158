#include "engine/options/option.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "engine/options/advice.h"
#include "engine/options/all_options.h"
#include "engine/options/command_line_json.h"
#include "engine/options/part_options.h"
#include "engine/options/surface_options.h"

namespace spia {
namespace {

using testing::HasSubstr;

std::string text_of(const std::filesystem::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

template <class Use> void for_each_source(const std::string& folder, const Use& use)
{
    for (const auto& file : std::filesystem::recursive_directory_iterator(SPIA_SOURCE_DIR "/engine" + folder))
        if (file.path().extension() == ".cpp" || file.path().extension() == ".h")
            use(file.path(), text_of(file.path()));
}

/// All matches of an expression in a text.
std::vector<std::smatch> matches(const std::string& text, const std::regex& expression)
{
    return {std::sregex_iterator(text.begin(), text.end(), expression), std::sregex_iterator()};
}

} // namespace

TEST(Option, IsMentionedInTheWordsOfTheCommandLineAndOfTheWindow)
{
    const std::string text = "close the crack (" + mention(option::weld, "0.0062") + "); weld vertices (" +
                             mention(option::weld) + "); keep one (" + mention(option::keep_largest) + ")";
    EXPECT_EQ(command_line_text(text),
              "close the crack (--weld 0.0062); weld vertices (--weld); keep one (--keep-largest)");
    EXPECT_EQ(window_text(text),
              "close the crack (\"Close the crack\" in the step Part); weld vertices (\"Weld "
              "vertices\" in the step Part); keep one (\"Keep the largest piece\" in the step Part)");
}

TEST(Option, MayHaveAnotherPlaceForEachOfItsChoices)
{
    EXPECT_EQ(window_text(mention(option::patches, "one")), "\"one patch\" in the step NURBS surface");
    EXPECT_EQ(window_text(mention(option::patches, "FILE")), "pick their ends with the tool Vertex");
    EXPECT_EQ(window_text(mention(option::patches)), "\"Made of\" in the step NURBS surface");
    EXPECT_EQ(window_text(mention(option::skin, "middle")), "\"Skin\" in the step Part");
    EXPECT_EQ(window_text(mention(option::part, "0-17, 19")), "\"Import options...\" in the step Part");
}

TEST(Option, LeavesOtherTextsAsTheyAre)
{
    for (const std::string text : {"", "nothing -- to say", "a file \x02 of its own \x03", "\x02", "\x03\x02weld"}) {
        EXPECT_EQ(command_line_text(text), text);
        EXPECT_EQ(window_text(text), text);
    }
    EXPECT_EQ(command_line_text("\x02\x02weld\x03"), "\x02--weld");
}

TEST(Option, IsMentionedInJsonAsOnTheCommandLine)
{
    const Json json =
        with_command_line_texts({{"notes", {"weld (" + mention(option::weld) + ")", 7}}, {"none", nullptr}});
    const Json told = {{"notes", {"weld (--weld)", 7}}, {"none", nullptr}};
    EXPECT_EQ(json, told);
}

TEST(Option, IsListedWithNamesOfItsOwn)
{
    std::set<std::string_view> names;
    size_t named = 0;
    for (const Option* each : all_options()) {
        names.insert(each->name);
        named += !each->name.empty();
        EXPECT_FALSE(each->help.empty()) << each->name;
        EXPECT_FALSE(each->name.empty() && each->key.empty()) << each->help;
    }
    for (const Advice* each : all_advice())
        named += names.insert(each->name).second;
    names.erase("");
    EXPECT_EQ(names.size(), named);
}

TEST(Option, IsInTheListOfItsFile)
{
    size_t described = 0;
    for_each_source("/options", [&](const auto& file, const std::string& text) {
        for (const std::smatch& at : matches(text, std::regex(R"(constexpr (Option|Advice) (\w+)\{)"))) {
            ++described;
            EXPECT_TRUE(std::regex_search(text, std::regex("&" + at[2].str() + "\\b")))
                << file << ": " << at[2] << " is missing in the list at the end of the file";
        }
    });
    EXPECT_EQ(all_options().size() + all_advice().size(), described) << "a list is missing in all_options.cpp";
}

TEST(Option, IsNamedInTheWordsOfEachProgram)
{
    for (const Option* each : all_options())
        if (!each->name.empty()) {
            EXPECT_EQ(command_line_text("(" + mention(*each) + ")"), "(--" + std::string(each->name) + ")");
            EXPECT_EQ(window_text(mention(*each)).find_first_of("\x02\x03"), std::string::npos) << each->name;
        }
    for (const Advice* each : all_advice()) {
        EXPECT_EQ(command_line_text(mention(*each)), each->on_command_line);
        EXPECT_EQ(window_text(mention(*each)), each->in_window);
    }
}

TEST(Option, IsSpelledAsAFlagByNoTextOfTheEngine)
{
    const std::regex flag(R"re("[^"\n]*--[a-z][a-z-]*[^"\n]*")re");
    for_each_source("", [&](const auto& file, const std::string& text) {
        for (const std::smatch& at : matches(text, flag))
            ADD_FAILURE() << file << ": " << at.str();
    });
}

TEST(Option, HasAPlaceInTheWindowWhereATextMentionsIt)
{
    std::map<std::string, std::string> name;
    for_each_source("/options", [&](const auto&, const std::string& text) {
        for (const std::smatch& at : matches(text, std::regex(R"re(constexpr Option (\w+)\{\s*\.name = "([^"]*)")re")))
            name[at[1]] = at[2];
    });
    int found = 0;
    for_each_source("", [&](const auto& file, const std::string& text) {
        for (const std::smatch& at : matches(text, std::regex(R"(mention\(option::(\w+))"))) {
            ++found;
            const auto all = all_options();
            const auto option =
                std::find_if(all.begin(), all.end(), [&](const Option* each) { return each->name == name[at[1]]; });
            ASSERT_NE(option, all.end()) << file << ": " << at[1];
            EXPECT_FALSE((*option)->name.empty()) << file << ": " << at[1];
            EXPECT_FALSE((*option)->place.empty()) << file << ": " << at[1];
            EXPECT_THAT(window_text(mention(**option)), HasSubstr(std::string((*option)->place)));
        }
    });
    EXPECT_GE(found, 40) << "the engine advises options";
}

} // namespace spia
