// Menus, panels and tools beside the path of by_hand_test.cpp: each does what it says, pressed by
// mouse and keyboard.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>

#include "tests/ui/by_hand/hands.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

constexpr double panel_x = 150, panel_y = 400; // in the panel of the steps

class PanelsByHand : public testing::Test {
protected:
    fs::path folder =
        scratch_folder(std::string("panels-by-hand-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::unique_ptr<Hands> hands;

    void SetUp() override
    {
        hands = std::make_unique<Hands>(folder, std::vector<std::string>{"assets/parts/dome.obj"});
        hands->size(1600, 1000);
        hands->see_that("the part", [](const Json& now) { return now["stages"]["read"] == true; });
    }
    Json unfold()
    {
        hands->keys("F5");
        return hands->see_that("blank, grid and surface", [](const Json& now) {
            return now["job"]["running"] == false && now["stages"]["fit"] == true;
        });
    }
    Json value(const char* pointer, const Json& wanted)
    {
        return hands->see_that(std::string(pointer) + " is " + wanted.dump(),
                               [&](const Json& now) { return now.at(Json::json_pointer(pointer)) == wanted; });
    }
    std::pair<double, double> in_part(double x, double y) const
    {
        const Json place = hands->viewer().report()["window"]["views"]["part"];
        return {place["at"][0].get<double>() + x * place["size"][0].get<double>(),
                place["at"][1].get<double>() + y * place["size"][1].get<double>()};
    }
    void click_in_part(double x, double y)
    {
        const auto at = in_part(x, y);
        hands->click_at(at.first, at.second);
    }
    OpenViewer& viewer() { return hands->viewer(); }
};

TEST_F(PanelsByHand, AllIsDrawnWithoutAnotherKeyOrTheMouse)
{
    for (int times = 0; times < 3; ++times) {
        unfold();
        hands->see_no("Drawing...");
        hands->keys("ctrl+z");
        hands->see_that("no blank", [](const Json& r) { return r["stages"]["solve"] == false; });
        hands->see_no("Drawing...");
    }
}

TEST_F(PanelsByHand, TheSheetIsChosen)
{
    hands->click("mild_steel");
    hands->click("dp600");
    value("/options/material", "dp600");
    hands->click_beside("Thickness, mm", -60, 0); // the button +
    value("/options/thickness", 1.05);
    hands->click_beside("Direction", -85, 0);
    hands->click("z");
    value("/options/direction", {0, 0, 1});
    hands->click("Strains of both skins");
    value("/options/skins", true);
    hands->scroll_to("Process", panel_x, panel_y);
    hands->click("Process");
    hands->click_part("Curve: ");
    hands->click_part("Keeler-Brazier");
    value("/limits/curve", "keeler_brazier");
    unfold();
    hands->menu("Edit", "Keep result as reference");
    hands->see_that("a reference", [](const Json& now) { return now["comparison"].is_object(); });
    hands->menu("Edit", "Remove reference");
    hands->see_that("no reference", [](const Json& now) { return now["comparison"].is_null(); });
}

TEST_F(PanelsByHand, FacesArePickedAndMadeRegions)
{
    hands->tool("Brush");
    click_in_part(0.5, 0.55);
    Json now = hands->see_that("painted faces", [](const Json& r) { return r["selection"]["faces"] > 0; });
    const int painted = now["selection"]["faces"];
    hands->click("Grow");
    now = hands->see_that("more faces", [&](const Json& r) { return r["selection"]["faces"] > painted; });
    const int grown = now["selection"]["faces"];
    hands->click("Shrink");
    hands->see_that("fewer faces", [&](const Json& r) { return r["selection"]["faces"] < grown; });
    hands->click("Invert");
    now = hands->see_that("the other faces", [&](const Json& r) { return r["selection"]["faces"] > painted; });
    const int rest = now["selection"]["faces"];
    hands->menu("Edit", "Make a region of the selection", "binder");
    now = hands->see_that("a binder that presses", [](const Json& r) {
        return r["regions"].size() == 1 && r["regions"][0]["contact"].is_object();
    });
    EXPECT_EQ(now["regions"][0]["faces"], rest);
    hands->click("Clear");
    value("/selection/faces", 0);
}

TEST_F(PanelsByHand, ViewsAndMarks)
{
    const Json before = hands->viewer().report();
    hands->menu("View", "Look from", "Top");
    Json now = hands->see_that("the part from above", [&](const Json& r) {
        return r["view"]["camera"]["part"]["turn"] != before["view"]["camera"]["part"]["turn"];
    });
    hands->menu("View", "Fit all");
    hands->see_that("fit_view", [](const Json& r) {
        const Json& pushed = r["window"]["pushed"];
        return std::find(pushed.begin(), pushed.end(), "fit_view") != pushed.end();
    });
    unfold();
    hands->tool("Probe");
    click_in_part(0.5, 0.5);
    hands->see_that("a probe", [](const Json& r) { return r["probes"].size() == 1; });
    hands->tool("Section");
    const auto from = in_part(0.3, 0.5), to = in_part(0.7, 0.5);
    viewer().drag(from.first, from.second, to.first, to.second);
    hands->scroll_to("Remove section", 1450, 500);
    hands->click("Remove section");
    hands->see_no("Remove section");
    hands->menu("File", "Picture...");
    hands->click("Save the picture");
    hands->see_that("the picture", [&](const Json&) {
        return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                           [](const fs::directory_entry& entry) { return entry.path().extension() == ".png"; });
    });
}

TEST_F(PanelsByHand, AWorstSpotHasAMarkAndEscapeGoesBack)
{
    const Json before = unfold();
    hands->scroll_to("Worst spots", 1450, 500);
    hands->viewer().wheel(-2); // its rows may be below the edge
    hands->click_part("1. ");
    Json now = hands->see_that("a spot", [](const Json& r) { return r["spot"].is_number(); });
    EXPECT_EQ(now["selection"], before["selection"]) << "what is selected is the user's";
    EXPECT_NE(now["view"]["camera"], before["view"]["camera"]);
    hands->keys("Escape");
    now = hands->see_that("no spot", [](const Json& r) { return r["spot"].is_null(); });
    EXPECT_EQ(now["view"]["camera"], before["view"]["camera"]);
}

TEST_F(PanelsByHand, ATickMovesNothing)
{
    unfold();
    const auto y_of = [](const Json& report, const char* line) {
        for (const Json& text : report["window"]["texts"])
            if (text["text"] == line)
                return text["at"][1].get<double>();
        return -1.;
    };
    for (const char* tick : {"Within a tolerance", "Square cells", "Improve cell angles"}) {
        hands->scroll_to(tick, panel_x, panel_y);
        for (int time = 0; time < 2; ++time) { // on and off
            hands->rest_on(tick);
            const double before = y_of(viewer().report(), tick);
            viewer().press(1);
            viewer().release(1);
            viewer().wait( // a fit within a tolerance may take longer than a step
                "a window at rest", [](const Json& r) { return r["job"]["running"] == false; },
                std::chrono::seconds(60));
            hands->see_that("the tick where it was",
                            [&](const Json& r) { return std::abs(y_of(r, tick) - before) <= 1; });
        }
    }
}

TEST_F(PanelsByHand, WhatThereIsToLookAtStaysWhileTheMouseIsOverThePart)
{
    unfold();
    const auto seen = [](const Json& r, const char* part) {
        const Json& texts = r["window"]["texts"];
        return std::any_of(texts.begin(), texts.end(), [&](const Json& text) {
            return text["text"].get<std::string>().find(part) != std::string::npos;
        });
    };
    hands->see_part_of_line("to look at");
    const auto at = in_part(0.55, 0.5);
    viewer().move(at.first, at.second);
    hands->see_that("both", [&](const Json& r) { return seen(r, "to look at") && seen(r, "Face "); });
}

TEST_F(PanelsByHand, AMenuNamesTheKeysThatActInAViewAsSuch)
{
    hands->click("View");
    hands->see("T in a view");
    hands->see("F in a view");
    hands->keys("Escape");
    hands->click("Edit");
    hands->see("I in a view");
    hands->keys("Escape");
}

TEST_F(PanelsByHand, AGradeOfOnesOwn)
{
    hands->menu("Edit", "Materials...");
    hands->see("Materials");
    hands->click("Copy as my own...");
    hands->see_part_of_line("not saved");
    hands->click("Save");
    hands->see_that("a grade of one's own", [](const Json& r) { return r["grades"]["own"].size() == 1; });
    hands->click("Remove...");
    hands->click("Delete the file permanently");
    hands->see_that("none of one's own", [](const Json& r) { return r["grades"]["own"].empty(); });
    hands->click("Close");
    hands->see_no("Built in");
}

} // namespace
} // namespace spia::viewer
