// Regions, probes and picked vertices by mouse and keyboard.
#include <fmt/core.h>

#include "tests/ui/by_hand/on_part.h"

namespace spia::viewer {
namespace {

class RegionsByHand : public OnPart {};

TEST_F(RegionsByHand, ARegionIsNamedBecomesAPieceOfATailoredBlankAndGoes)
{
    start("assets/parts/dome.obj");
    hands->click("Brush");
    click_in(View::part, 0.5, 0.55);
    Json now = hands->see_that("painted faces", [](const Json& r) { return r["selection"]["faces"] > 0; });
    const int faces = now["selection"]["faces"];
    click_left(fmt::format("Make region of {} faces", faces));
    now = count("/regions", 1);
    const std::string name = now["regions"][0]["name"];
    hands->keys("Escape");
    value("/selection/faces", 0);

    hands->scroll_to("edit", left_x, left_y);
    hands->click_part(name + " (fixed");
    value("/selection/faces", faces);
    hands->keys("Escape");
    hands->click("edit");
    hands->keys("ctrl+a");
    hands->type("bottom");
    hands->keys("Return");
    value("/regions/0/name", "bottom");
    hands->click("edit");
    hands->click("fixed");
    hands->click("material");
    value("/regions/0/kind", "material");
    click_left("Different sheet (tailored blank)");
    hands->see_that("a sheet of its own", [](const Json& r) { return r["regions"][0]["sheet"].is_object(); });
    hands->click("ok");
    hands->click("x");
    count("/regions", 0);
}

TEST_F(RegionsByHand, ProbesAndWorstSpotsAreGoneTo)
{
    start("assets/parts/dome.obj");
    hands->keys("F6");
    hands->see_that("the blank", [](const Json& r) { return r["stages"]["solve"] == true; });
    hands->click("Probe");
    click_in(View::part, 0.5, 0.5);
    count("/probes", 1);
    click_in(View::part, 0.55, 0.45);
    Json now = count("/probes", 2);
    const auto row = [&](int probe) { return fmt::format("face {}", now["probes"][size_t(probe)]["face"].get<int>()); };
    hands->scroll_to("Remove all", right_x, right_y);
    hands->click(row(1));
    now = hands->see_that("a spot", [](const Json& r) { return r["spot"].is_number(); });
    EXPECT_EQ(now["spot"], now["probes"][1]["face"]);
    EXPECT_EQ(now["selection"]["faces"], 0);
    const Json first = now["probes"][0]["face"];
    hands->click("x"); // of the last one
    now = count("/probes", 1);
    EXPECT_EQ(now["probes"][0]["face"], first);
    hands->click("Remove all");
    count("/probes", 0);
    hands->keys("F6"); // again
    hands->see_part_of_line("up to date");
    hands->click("Dismiss");
    pushed("dismiss_messages");
}

TEST_F(RegionsByHand, FacesOfAZoneAreSelected)
{
    start("assets/parts/dome.obj");
    hands->keys("F6");
    hands->see_that("the blank", [](const Json& r) { return r["stages"]["solve"] == true; });
    click_right("Safe");
    hands->see_that("its faces", [](const Json& r) { return r["selection"]["faces"] > 10; });
}

TEST_F(RegionsByHand, PickedVerticesAreListedAndBecomePilots)
{
    start("assets/parts/dome.obj");
    hands->click("Vertex");
    // one is near somewhere
    for (double y = 0.5; y < 0.7 && hands->viewer().report()["vertices"].empty(); y += 0.015)
        click_in(View::part, 0.5, y);
    Json now = count("/vertices", 1);
    hands->click_beside("x, y, z, mm", 0, 18); // the first row
    pushed("fly_to_vertex");
    click_left("Process");
    click_left("Pin 1 picked vertex");
    now = count("/lines", 1);
    EXPECT_EQ(now["lines"][0]["kind"], "pilot");
    hands->scroll_to("x, y, z, mm", right_x, right_y);
    const Json report = hands->viewer().report();
    for (const Json& text : report["window"]["texts"]) // the button at the end of the row of the
                                                       // vertex
        if (text["text"] == "x" && text["at"][0].get<double>() > 1300) {
            hands->click_at(text["at"][0].get<double>() + 3, text["at"][1].get<double>() + 6);
            break;
        }
    count("/vertices", 0);
}

} // namespace
} // namespace spia::viewer
