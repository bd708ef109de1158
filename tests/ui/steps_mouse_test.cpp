// The section "Step by step" by mouse.
#include <gtest/gtest.h>
#include <memory>

#include "tests/ui/viewer_process.h"

namespace spia::viewer {
namespace {

/// A window of 1366 by 768 pixels with a channel whose flanges have lips.
struct MouseOnSteps : testing::Test {
    std::unique_ptr<OpenViewer> viewer;

    void SetUp() override
    {
        const std::filesystem::path folder = scratch_folder("mouse-on-steps");
        viewer = std::make_unique<OpenViewer>(folder, std::vector<std::string>{SPIA_SOURCE_DIR
                                                                               "/assets/parts/lipped-channel.obj",
                                                                               "--width", "1366", "--height", "768"});
        viewer->wait("the part", [](const Json& now) { return now["stages"]["read"] == true; });
    }
    /// Where an item lies, by shares of its width and height; scrolls the panel until it is in
    /// sight.
    std::pair<double, double> place_of(const std::string& item, double x = 0.5, double y = 0.5)
    {
        constexpr double over_panel_x = 150, over_panel_y = 400, top = 60, bottom = 690;
        Json now = viewer->wait(item, [&](const Json& r) { return r["window"]["items"].contains(item); });
        for (int tries = 0; tries < 60; ++tries) {
            const Json& place = now["window"]["items"][item];
            const double from = place["at"][1], height = place["size"][1], middle = from + y * height;
            if (middle > top && middle < bottom)
                return {place["at"][0].get<double>() + x * place["size"][0].get<double>(), middle};
            viewer->move(over_panel_x + tries % 2, over_panel_y);
            viewer->wheel(middle < top ? 1 : -1);
            now = viewer->wait("a scrolled panel", [&](const Json& r) {
                return r["window"]["items"].contains(item) && r["window"]["items"][item]["at"][1] != from;
            });
        }
        ADD_FAILURE() << item << " does not come into sight";
        return {0, 0};
    }
    /// Waits until no job runs, for it disables buttons, and until the item stands still under the
    /// mouse: what a slow machine draws late moves it.
    void click(const std::string& item)
    {
        viewer->wait("no job before a click on " + item,
                     [](const Json& now) { return now["job"]["running"] == false; });
        for (int tries = 0; tries < 20; ++tries) {
            const auto [x, y] = place_of(item);
            viewer->move(x, y);
            if (place_of(item) == std::pair(x, y)) {
                viewer->press(1);
                viewer->release(1);
                return;
            }
        }
        ADD_FAILURE() << item << " does not stand still";
    }
    Json wait_for(const char* pointer, const Json& value)
    {
        return viewer->wait(
            std::string(pointer) + " is " + value.dump(),
            [&](const Json& now) {
                const Json::json_pointer at(pointer);
                return now.contains(at) && now.at(at) == value && now["job"]["running"] == false;
            },
            std::chrono::seconds(150));
    }
};

TEST_F(MouseOnSteps, ProposesRunsShowsChangesAndRunsAgain)
{
    click("step by step");
    click("propose steps");
    Json now = viewer->wait("five steps", [](const Json& r) { return r["unfolding"]["steps"].size() == 5; });
    EXPECT_EQ(now["unfolding"]["done"], 0);
    EXPECT_FALSE(now["window"]["items"].contains("slider")) << "there is nothing to play yet";
    click("run steps");
    now = wait_for("/unfolding/done", 5);
    EXPECT_EQ(now["unfolding"]["position"], 5.0);
    EXPECT_FALSE(now["window"]["items"].contains("run steps")) << "all is done";

    click("step 2");
    now = wait_for("/view/step", 1);
    EXPECT_EQ(now["unfolding"]["position"], 2.0) << "a row shows the part after its step";

    const auto [from, y] = place_of("slider", 0.4);
    const double to = place_of("slider", 0.65).first;
    viewer->drag(from, y, to, y);
    now = viewer->wait("the slider where it was let go", [](const Json& r) {
        const double position = r["unfolding"]["position"];
        return position > 2.6 && position < 3.9;
    });
    EXPECT_EQ(now["view"]["step"], 3 - (now["unfolding"]["position"] <= 3.0)) << "the step it is in is marked";
    EXPECT_EQ(now["history"]["undo"], "Run the steps") << "looking is no change";

    const Json before = now["unfolding"]["steps"];
    click("step 2");
    wait_for("/view/step", 1);
    click("down");
    now = wait_for("/unfolding/done", 1);
    EXPECT_EQ(now["unfolding"]["steps"][2]["name"], before[1]["name"]);
    EXPECT_EQ(now["unfolding"]["steps"][1]["status"], "out of date");
    click("run steps"); // from step 2 on
    now = wait_for("/unfolding/done", 5);
    viewer->keys("ctrl+z");
    wait_for("/unfolding/done", 1);
    viewer->keys("ctrl+z");
    now = wait_for("/unfolding/done", 5);
    EXPECT_EQ(now["unfolding"]["steps"], before);
    viewer->keys("ctrl+y");
    wait_for("/unfolding/done", 1);
    viewer->keys("ctrl+y");
    wait_for("/unfolding/done", 5);

    click("use this blank");
    now = wait_for("/stages/fit", true);
    EXPECT_EQ(now["figures"]["source"]["from"], "steps");
    EXPECT_FALSE(now["window"]["items"].contains("use this blank")) << "it is in use";
}

} // namespace
} // namespace spia::viewer
