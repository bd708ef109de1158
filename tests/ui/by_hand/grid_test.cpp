// Corners, grid, patches and the shape of the surface by mouse and keyboard.
#include "tests/ui/by_hand/on_part.h"

namespace spia::viewer {
namespace {

class GridByHand : public OnPart {
protected:
    void SetUp() override
    {
        start("assets/parts/dome.obj");
        unfold();
    }
    void pick_corners(std::initializer_list<size_t> which)
    {
        const Json now = hands->viewer().report();
        bool first = true;
        for (const size_t k : which) {
            const Json& place = now["corners"][k]["blank"];
            const glm::dvec2 at = on_screen(View::blank, {place[0].get<double>(), place[1].get<double>(), 0});
            if (!first)
                hands->viewer().hold("shift");
            hands->click_at(at.x, at.y);
            if (!std::exchange(first, false))
                hands->viewer().let_go("shift");
        }
        count("/vertices", which.size());
    }
};

TEST_F(GridByHand, PickedVerticesBecomeCornersAndTheGridIsChanged)
{
    hands->click("Outline");
    pick_corners({0, 1, 2, 3});
    hands->see_no("Finding the outline");
    click_right("Use as corners");
    hands->see_that("corners of one's own", [](const Json& r) {
        return r["options"]["corners"].is_array() && r["stages"]["fit"] == true && !r["job"]["running"];
    });
    click_left("Propose corners");
    value("/options/corners", nullptr);
    hands->see_that("a grid between them", [](const Json& r) { return r["stages"]["fit"] == true; });
    const Json before = hands->see_ready()["options"]["grid"];
    click_left("Square cells");
    hands->see_that("columns and rows", [&](const Json& r) {
        return r["options"]["grid"] != before && r["stages"]["fit"] == true && !r["job"]["running"];
    });
}

TEST_F(GridByHand, TheSurfaceIsCutIntoPatches)
{
    hands->click("Outline");
    pick_corners({0, 2});
    click_right("Cut into patches here");
    Json now = hands->see_that("two patches", [](const Json& r) {
        return r["options"]["patches"].is_object() && r["options"]["patches"]["cuts"].size() == 1 &&
               r["stages"]["fit"] == true && !r["job"]["running"];
    });
    hands->keys("Escape");
    count("/vertices", 0);
    hands->scroll_to("Smooth joins", left_x, left_y);
    hands->click("x");
    hands->see_that("no cut",
                    [](const Json& r) { return r["options"]["patches"]["cuts"].empty() && !r["job"]["running"]; });
    hands->scroll_to("several patches", left_x, left_y);
    hands->click("several patches");
    hands->click("one patch");
    value("/options/patches", nullptr);
    hands->see_ready();
    hands->scroll_to("one patch", left_x, left_y);
    hands->click("one patch");
    hands->click("automatic");
    value("/options/best_surface", true);
    hands->see_ready();
    hands->see_part_of_line("5 patches, because");
    hands->scroll_to("Patches, worst first", left_x, left_y);
    hands->click("Patches, worst first");
    hands->scroll_to("Add lattice", left_x, left_y); // which is below the list
    constexpr double below = 20;                     // pixels: the first patch below a head
    hands->click_beside("Least", 0, below);
    hands->see_that("where that patch is worst",
                    [](const Json& r) { return r["spot"].is_number() && r["display"]["field"] != "deviation"; });
    hands->keys("Escape");
    hands->see_that("no spot", [](const Json& r) { return r["spot"].is_null(); });
    hands->click("Off, mm");
    hands->click_beside("Off, mm", 0, below);
    hands->see_that("where that patch is farthest from the part",
                    [](const Json& r) { return r["spot"].is_number() && r["display"]["field"] == "deviation"; });
    hands->keys("Escape");
    hands->see_that("no spot", [](const Json& r) { return r["spot"].is_null(); });
}

TEST_F(GridByHand, TheSurfaceIsDeformedAndReset)
{
    hands->click("Shape");
    const Json before = hands->viewer().report();
    // A control point somewhere near the middle: the drag begins where one is picked.
    for (double y = 0.45; y < 0.65 && hands->viewer().report()["handles"]["picked"].empty(); y += 0.015)
        click_in(View::surface, 0.5, y);
    Json now = hands->see_that("a control point", [](const Json& r) { return r["handles"]["picked"].size() == 1; });
    click_left("Move by, mm");
    hands->click_beside("Move by, mm", -70, 0); // the third number
    hands->keys("ctrl+a");
    hands->type("2");
    hands->keys("Return");
    value("/options/moved_controls", 1);
    click_left("Reset control points");
    value("/options/moved_controls", 0);
    click_left("Add lattice");
    hands->see_that("a lattice", [](const Json& r) { return r["options"]["lattice"].is_array(); });
    click_left("Remove lattice");
    value("/options/lattice", nullptr);
}

} // namespace
} // namespace spia::viewer
