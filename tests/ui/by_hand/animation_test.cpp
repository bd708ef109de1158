// An animation of the unfolding, by mouse.
#include <fstream>
#include <gtest/gtest.h>
#include <memory>

#include "tests/ui/by_hand/hands.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

TEST(AnimationByHand, TheWayFromPartToBlankBecomesAGif)
{
    const fs::path folder = scratch_folder("animation-by-hand");
    Hands hands(folder, {"assets/parts/dome.obj"});
    hands.size(1280, 800);
    hands.keys("F5");
    hands.see_that("the blank",
                   [](const Json& now) { return now["job"]["running"] == false && now["stages"]["solve"] == true; });
    hands.menu("File", "Animation...");
    hands.click("960 x 640");
    hands.click("640 x 480");
    hands.double_click("48");
    hands.keys("ctrl+a");
    hands.type("8");
    hands.keys("Tab");
    hands.click("Make the animation");
    hands.see_part_of_line("dome-unfolding.gif"); // in the message that it is written
    const fs::path file = folder / "dome-unfolding.gif";
    hands.see_that("the file", [&](const Json&) { return fs::exists(file); });
    char head[6] = {};
    std::ifstream(file, std::ios::binary).read(head, 6);
    EXPECT_EQ(std::string(head, 6), "GIF89a");
}

} // namespace
} // namespace spia::viewer
