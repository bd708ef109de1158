#include <gtest/gtest.h>

#include "tests/ui/viewer_process.h"

namespace spia::viewer {
namespace {

/// A part whose file says nothing of the sheet: its light is amber, and so is the one at the foot
/// of the window.
TEST(LightsByMouse, WhatIsAssumedIsListedAndConfirmedByClicks)
{
    const std::filesystem::path folder = scratch_folder("lights-mouse");
    OpenViewer viewer(folder, {SPIA_SOURCE_DIR "/assets/parts/inner-panel.obj", "--width", "1280", "--height", "720"});
    viewer.wait("the part", [](const Json& now) { return now["stages"]["read"] == true; });
    const auto click = [&](const std::string& item) {
        const Json now =
            viewer.wait(item, [&](const Json& report) { return report["window"]["items"].contains(item); });
        const Json &at = now["window"]["items"][item]["at"], &size = now["window"]["items"][item]["size"];
        viewer.click(at[0].get<double>() + size[0].get<double>() / 2, at[1].get<double>() + size[1].get<double>() / 2);
    };
    EXPECT_EQ(viewer.report()["ready"]["text"], "1 thing to look at");
    click("things to look at");
    click(viewer.report()["doubts"][0]["button"]);
    const Json now = viewer.wait("a green light", [](const Json& report) { return report["ready"]["fine"] == true; });
    EXPECT_EQ(now["ready"]["text"], "Ready");
    EXPECT_EQ(now["options"]["thickness_from"], "chosen");
    EXPECT_EQ(now["options"]["material_from"], "chosen");
    EXPECT_FALSE(now["window"]["items"].contains("things to look at"));
    viewer.keys("ctrl+z");
    viewer.wait("the word taken back", [](const Json& report) { return report["ready"]["fine"] == false; });
}

} // namespace
} // namespace spia::viewer
