// The list of steps by mouse and keyboard: made by hand, changed, saved and opened.
#include <fmt/core.h>

#include "tests/support/bent_parts.h"
#include "tests/support/mesh_file.h"
#include "tests/ui/by_hand/on_part.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

/// A sharp-edged box without a lid whose walls hang on its bottom alone.
class StepsByHand : public OnPart {
protected:
    void SetUp() override
    {
        shapes::write_mesh(folder / "box.obj", shapes::lipped_box({.edge = 10, .joined = false}));
        start((folder / "box.obj").string());
    }
    void region_at(double x, double y)
    {
        hands->click("Flood");
        click_in(View::part, x, y);
        const Json now = hands->see_that("picked faces", [](const Json& r) { return r["selection"]["faces"] > 0; });
        click_left(fmt::format("Make region of {} faces", now["selection"]["faces"].get<int>()));
    }
};

TEST_F(StepsByHand, AStepIsAddedAimedSavedRemovedAndOpened)
{
    hands->menu("View", "Look from", "Top");
    region_at(0.5, 0.5); // the bottom
    Json now = count("/regions", 1);
    hands->menu("View", "Look from", "Front");
    hands->keys("Escape");
    click_in(View::part, 0.5, 0.5); // a wall
    now = hands->see_that("picked faces", [](const Json& r) { return r["selection"]["faces"] > 0; });
    const int wall = now["selection"]["faces"];
    click_left("Step by step");
    click_left("Add a step");
    click_left("Add step");
    now = count("/unfolding/steps", 1);
    EXPECT_EQ(now["unfolding"]["steps"][0]["freed"], wall);

    hands->scroll_to("Save steps...", left_x, left_y);
    hands->click("Save steps...");
    hands->see("Save the steps");
    hands->click("Save");
    hands->see_that("the file", [&](const Json&) { return fs::exists(folder / "box-steps.json"); });

    hands->scroll_to("not run yet", left_x, left_y);
    hands->click_part("faces onto"); // the name of the step, above it
    value("/view/step", 0);
    click_left("Plane of selection");
    hands->see_that("a plane", [](const Json& r) { return r["unfolding"]["steps"][0]["target"]["plane"].is_object(); });
    hands->keys("Escape");
    click_left("Select faces");
    value("/selection/faces", wall);
    hands->scroll_to("edit", left_x, left_y);
    hands->click_part(now["regions"][0]["name"].get<std::string>() + " (");
    hands->see_that("the bottom", [&](const Json& r) { return r["selection"]["faces"] == now["regions"][0]["faces"]; });
    click_left("Fit to selection");
    hands->see_that("a fitted target", [](const Json& r) {
        return !r["unfolding"]["steps"][0]["target"].contains("plane") ||
               r["unfolding"]["steps"][0]["target"]["plane"].is_null();
    });
    click_left("Remove");
    count("/unfolding/steps", 0);

    click_left("Open steps...");
    hands->see("Open the steps");
    hands->click("box-steps.json");
    hands->click("Open");
    count("/unfolding/steps", 1);
}

} // namespace
} // namespace spia::viewer
