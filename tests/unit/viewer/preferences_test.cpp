#include "app/viewer/model/document/preferences.h"

#include <fstream>
#include <gmock/gmock.h>

#include "app/viewer/model/actions/script.h"
#include "app/viewer/model/document/recent_files.h"
#include "app/viewer/model/jobs/viewer_model.h"
#include "app/viewer/model/reports/lights.h"
#include "engine/core/error.h"
#include "tests/unit/viewer/action_as.h"
#include "tests/unit/viewer/model_fixture.h"
#include "tests/unit/viewer/own_home.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class KeptPreferencesFile : public OwnHome {
protected:
    void put_file(const std::string& text)
    {
        fs::create_directories(config_folder());
        std::ofstream(config_folder() / "preferences.json") << text;
    }
};

Preferences all_changed()
{
    return {false, 150, LengthUnit::inch, "dp600", 0.8, ColourMap::grey, true, 0.05, MouseStyle::nx};
}

TEST_F(KeptPreferencesFile, ComeBackAsTheyWereKept)
{
    EXPECT_EQ(read_preferences().preferences, Preferences{}) << "nobody has kept any";
    EXPECT_TRUE(read_preferences().left_out.empty());
    keep_preferences(all_changed());
    EXPECT_EQ(read_preferences().preferences, all_changed());
    EXPECT_TRUE(read_preferences().left_out.empty());
    keep_preferences({});
    EXPECT_EQ(read_preferences().preferences, Preferences{});
}

TEST_F(KeptPreferencesFile, WhatIsAtFaultIsLeftOutAndTheRestTaken)
{
    put_file(R"({"schema": "spia-preferences/1", "dark": false, "interface_percent": 1e9, "lengths": "cm",
                 "thickness_mm": -1, "map": "rainbow", "tolerance_mm": "small", "material": "dp600",
                 "colour of the mouse": 3})");
    const KeptPreferences kept = read_preferences();
    Preferences expected;
    expected.dark = false;
    expected.material = "dp600";
    EXPECT_EQ(kept.preferences, expected);
    ASSERT_EQ(kept.left_out.size(), 6u);
    std::string all;
    for (const std::string& text : kept.left_out)
        all += text + "\n";
    for (const char* name :
         {"interface_percent", "lengths", "thickness_mm", "map", "tolerance_mm", "colour of the mouse"})
        EXPECT_THAT(all, HasSubstr(name));
}

TEST_F(KeptPreferencesFile, AnyFileWhateverItHoldsLeavesTheStandardOnes)
{
    for (const char* text :
         {"", "{", "[1, 2]", "null", "\x80\xff", R"({"schema": "spia-preferences/2", "dark": false})",
          R"({"dark": false})", R"({"schema": 1})"}) {
        put_file(text);
        const KeptPreferences kept = read_preferences();
        EXPECT_EQ(kept.preferences, Preferences{}) << text;
        EXPECT_EQ(kept.left_out.size(), 1u) << text;
    }
    fs::remove(config_folder() / "preferences.json");
    fs::create_directory(config_folder() / "preferences.json");
    EXPECT_EQ(read_preferences().preferences, Preferences{});
    EXPECT_THROW(keep_preferences({}), ExchangeError);
}

class Preferring : public ModelFixture {
protected:
    std::string sheet_doubts() const
    {
        std::string all;
        for (const Doubt& doubt : *state.doubts)
            if (doubt.step == ChainStep::sheet)
                all += doubt.text + "\n";
        return all;
    }
};

TEST_F(Preferring, ASheetOfThePreferencesIsAChoice)
{
    model.apply(SetPreferences{all_changed()});
    open();
    EXPECT_EQ(document.material, "dp600");
    EXPECT_THAT(document.session.options.flatten.material.name, HasSubstr("DP600"));
    EXPECT_EQ(document.session.options.flatten.thickness, 0.8);
    EXPECT_EQ(document.session.options.tolerance, 0.05);
    EXPECT_EQ(document.display.map, ColourMap::grey);
    EXPECT_EQ(document.thickness_from, SheetSource::preference);
    EXPECT_EQ(sheet_doubts(), "") << "nothing was assumed";
    open("square-cup.obj");
    EXPECT_EQ(document.thickness_from, SheetSource::preference) << "nor is it that of the part before";
    EXPECT_EQ(sheet_doubts(), "");
}

TEST_F(Preferring, OneOfBothLeavesTheOtherADoubt)
{
    Preferences some;
    some.thickness_mm = 1.2;
    model.apply(SetPreferences{some});
    open();
    EXPECT_THAT(sheet_doubts(), HasSubstr("The grade mild_steel is assumed"));
    EXPECT_THAT(sheet_doubts(), testing::Not(HasSubstr("thickness")));
    some = {};
    some.lengths = LengthUnit::inch;
    model.apply(SetPreferences{some});
    open();
    EXPECT_THAT(sheet_doubts(), HasSubstr("0.0472 in is that of the previous part")) << "in the unit that is shown";
}

TEST_F(Preferring, AThemeThatIsChosenStaysOne)
{
    ViewSettings view = state.view;
    view.dark = !view.dark;
    model.apply(SetViewSettings{view});
    EXPECT_EQ(state.preferences.dark, view.dark);
    Preferences wanted = state.preferences;
    wanted.dark = !wanted.dark;
    model.apply(SetPreferences{wanted});
    EXPECT_EQ(state.view.dark, wanted.dark);
}

TEST_F(Preferring, RefusesWhatIsNone)
{
    for (const auto& spoil :
         {+[](Preferences& p) { p.interface_percent = 20; }, +[](Preferences& p) { p.lengths = LengthUnit::m; },
          +[](Preferences& p) { p.material = "unobtainium"; }, +[](Preferences& p) { p.thickness_mm = 0; }}) {
        const Preferences before = state.preferences;
        Preferences wrong = before;
        spoil(wrong);
        model.apply(SetPreferences{wrong});
        EXPECT_EQ(state.preferences, before);
        EXPECT_TRUE(std::any_of(state.messages.begin(), state.messages.end(),
                                [](const Message& m) { return m.severity == Severity::error; }));
        model.apply(DismissMessages{});
    }
}

TEST_F(Preferring, ScriptsChangeSomeOfThem)
{
    ViewerState present;
    present.preferences = all_changed();
    const Action action = action_from_json(Json{{"do", "set_preferences"}, {"lengths", "mm"}}, present, "script");
    Preferences expected = all_changed();
    expected.lengths = LengthUnit::mm;
    EXPECT_EQ(as<SetPreferences>(action).preferences, expected);
    EXPECT_THROW(action_from_json(Json{{"do", "set_preferences"}, {"lengths", "cm"}}, present, "script"), InputError);
}

} // namespace
} // namespace spia::viewer
