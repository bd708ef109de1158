// Preferences and the unit of lengths, by mouse and keyboard.
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <regex>

#include "tests/ui/by_hand/hands.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

class PreferencesByHand : public testing::Test {
protected:
    fs::path folder = scratch_folder(std::string("preferences-by-hand-") +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
    std::unique_ptr<Hands> hands;

    void start()
    {
        hands = nullptr; // the one before ends first
        hands = std::make_unique<Hands>(folder, std::vector<std::string>{"assets/parts/dome.obj"});
        hands->size(1600, 1000);
        hands->see_that("the part", [](const Json& now) { return now["stages"]["read"] == true; });
    }
    Json value(const char* pointer, const Json& wanted)
    {
        return hands->see_that(std::string(pointer) + " is " + wanted.dump(),
                               [&](const Json& now) { return now.at(Json::json_pointer(pointer)) == wanted; });
    }
    Json in_dialog()
    {
        hands->keys("ctrl+comma");
        return hands->see("Interface size");
    }
};

TEST_F(PreferencesByHand, LengthsInInchAreShownTypedAndKept)
{
    start();
    hands->keys("F5");
    hands->see_that("blank, grid and surface",
                    [](const Json& now) { return now["job"]["running"] == false && now["stages"]["fit"] == true; });
    hands->see("Deviation, mm");
    in_dialog();
    hands->click("inch");
    hands->click("Save");
    hands->see("Deviation, in"); // the legend of the surface
    hands->see("Thickness, in");
    value("/preferences/lengths", "inch");
    value("/options/thickness", 1); // shown otherwise, it is the same
    hands->see("0.0394");           // 1 mm, in its field
    hands->click("0.0394");
    hands->keys("Return"); // nothing typed, nothing changed
    value("/options/thickness", 1);
    hands->double_click("0.0394");
    hands->keys("ctrl+a");
    hands->type("0.05");
    hands->keys("Return");
    const Json now = hands->see_that("another thickness", [](const Json& r) { return r["options"]["thickness"] != 1; });
    EXPECT_NEAR(now["options"]["thickness"].get<double>(), 0.05 * 25.4, 1e-9);
    const Json place = now["window"]["views"]["part"];
    hands->viewer().move(place["at"][0].get<double>() + 0.5 * place["size"][0].get<double>(),
                         place["at"][1].get<double>() + 0.5 * place["size"][1].get<double>());
    hands->see_that("the place under the mouse in the status line, in inch", [](const Json& report) {
        const std::regex in_inch(R"(-?\d+\.\d{4}, -?\d+\.\d{4}, -?\d+\.\d{4} in)");
        const Json& texts = report["window"]["texts"];
        return std::any_of(texts.begin(), texts.end(), [&](const Json& text) {
            return std::regex_match(text["text"].get<std::string>(), in_inch);
        });
    });
    start();
    hands->see("Thickness, in");
    value("/preferences/lengths", "inch");
}

TEST_F(PreferencesByHand, SizeThemeAndTheSheetOfNewPartsAreKept)
{
    start();
    const Json before = in_dialog();
    hands->click("100 %");
    hands->click("125 %");
    hands->click("Light");
    hands->click("None chosen: mild_steel is assumed");
    hands->click("dp600");
    hands->click("of all parts");
    hands->click("Save");
    value("/preferences/interface_percent", 125);
    value("/view/dark", false);
    value("/preferences/material", "dp600");
    value("/options/material", "mild_steel"); // the part that is open keeps its sheet
    start();
    hands->see("Grade and thickness from preferences");
    value("/options/material", "dp600");
    const Json now = value("/view/dark", false);
    for (const Json& doubt : now["doubts"])
        EXPECT_NE(doubt["step"], "sheet") << "a sheet that was chosen is no doubt: " << doubt["text"];
    hands->menu("View", "Dark theme"); // as by its key
    value("/preferences/dark", true);
    start();
    value("/view/dark", true);
    hands->menu("Edit", "Preferences...");
    hands->see("125 %");
    hands->click("Cancel");
    hands->see_no("Interface size");
}

TEST_F(PreferencesByHand, AFileAtFaultIsToldAndTheRestTaken)
{
    fs::create_directories(folder / "config" / "spia");
    std::ofstream(folder / "config" / "spia" / "preferences.json")
        << R"({"schema": "spia-preferences/1", "dark": false, "interface_percent": -7, "material": "no such grade"})";
    start();
    hands->see_part_of_line("there is no grade \"no such grade\" any more");
    hands->see_part_of_line("interface_percent");
    value("/view/dark", false);
    value("/preferences/interface_percent", 100);
    value("/preferences/material", "");
}

} // namespace
} // namespace spia::viewer
