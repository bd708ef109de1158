// What the program says of its result, in Export and in Inspect: by mouse, with no other eyes than
// the texts on the screen.
#include <gtest/gtest.h>
#include <memory>

#include "tests/support/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/ui/by_hand/hands.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

class VerdictByHand : public testing::Test {
protected:
    fs::path folder =
        scratch_folder(std::string("verdict-by-hand-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::unique_ptr<Hands> hands;

    void start(const std::string& part)
    {
        hands = std::make_unique<Hands>(folder, std::vector<std::string>{part});
        hands->size(1280, 720);
        hands->see_that("the part", [](const Json& now) { return now["stages"]["read"] == true; });
    }
    void run()
    {
        hands->keys("F5");
        hands->see_that("blank, grid and surface", all_fresh);
    }
    void click_item(const std::string& item)
    {
        const Json now = hands->see_that(item, [&](const Json& r) { return r["window"]["items"].contains(item); });
        const Json& place = now["window"]["items"][item];
        hands->click_at(place["at"][0].get<double>() + place["size"][0].get<double>() / 2,
                        place["at"][1].get<double>() + place["size"][1].get<double>() / 2);
    }
};

TEST_F(VerdictByHand, ExportListsWhatTheLightsHoldAndStaysWhileAllIsUpdated)
{
    start("assets/parts/dome.obj");
    run();
    hands->keys("ctrl+e");
    // nobody has given the sheet
    hands->see("The surface is out of tolerance; 3 things to look at");
    hands->see_part_of_line("The thickness 1 mm is assumed");
    click_item("Confirm 1 mm of mild_steel");
    hands->see("The surface is out of tolerance; 2 things to look at");
    click_item("close dialog");
    hands->see_no("The surface is out of tolerance");
    hands->click("+"); // a little thicker
    hands->see_that("another thickness", [](const Json& r) { return r["options"]["thickness"] != 1; });
    hands->keys("ctrl+e");
    hands->see_part_of_line("Out of date from the step \"Unfold\" on");
    hands->click("Update all first");
    hands->see_no("Update all first");
    hands->see_that("new results", all_fresh);
    hands->see_part_of_line("The surface is out of tolerance"); // in the dialog, which has stayed
    hands->keys("Escape");
}

TEST_F(VerdictByHand, WhereTheSurfaceIsFarIsShownAndEscapeGoesBack)
{
    start("assets/parts/dome.obj");
    run();
    const Json before = hands->see_that("no spot", [](const Json& r) { return r["spot"].is_null(); });
    hands->scroll_to("Fit it within 0.1 mm", 150, 400); // beside it
    click_item("show NURBS surface");
    Json now = hands->see_that("a spot", [](const Json& r) { return r["spot"].is_number(); });
    EXPECT_NE(now["view"]["camera"], before["view"]["camera"]);
    hands->keys("Escape");
    now = hands->see_that("no spot", [](const Json& r) { return r["spot"].is_null(); });
    EXPECT_EQ(now["view"]["camera"], before["view"]["camera"]);
}

TEST_F(VerdictByHand, WhetherItCracksIsInSightAndAMiniatureIsDoubted)
{
    start("assets/parts/dome.obj");
    run();
    hands->see_part_of_line("No cracks expected");
    hands->scroll_to("Step by step", 150, 400); // far down in the panel of the steps; the next part
                                                // begins at its top
    hands->keys("ctrl+o");
    hands->see("Open a part");
    const fs::path miniature = folder / "metres.obj"; // a sheet of 0.6 m, read as 0.6 mm
    shapes::write_mesh(miniature, shapes::rectangle(0.6, 0.45, 8, 6));
    hands->type(miniature.string());
    hands->keys("Return");
    hands->see("Read it in m");
    hands->click("Read it in m");
    hands->see_no("Read it in m");
}

} // namespace
} // namespace spia::viewer
