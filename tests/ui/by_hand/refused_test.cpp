// A file that is refused while a part is open: the part stays, the faults are shown on request, and
// back. By mouse and keyboard.
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/mesh_file.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"
#include "tests/ui/by_hand/hands.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

bool has_error(const Json& report, const std::string& words)
{
    const Json& said = report["messages"];
    return std::any_of(said.begin(), said.end(), [&](const Json& message) {
        return message["severity"] == "error" && message["text"].get<std::string>().find(words) != std::string::npos;
    });
}

struct RefusedByHand : testing::Test {
    fs::path folder =
        scratch_folder(std::string("refused-by-hand-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::unique_ptr<Hands> hands;

    /// The dome, unfolded, its faces picked: unsaved work.
    void start_with_unfolded_dome()
    {
        hands = std::make_unique<Hands>(folder, std::vector<std::string>{"assets/parts/dome.obj"});
        hands->size(1280, 720);
        hands->see_that("the part", [](const Json& r) { return r["stages"]["read"] == true; });
        hands->keys("F6");
        hands->see_that("the blank", [](const Json& r) { return r["stages"]["solve"] == true; });
        hands->keys("F4");
        hands->keys("i");
        hands->see_that("picked faces", [](const Json& r) { return r["project"]["unsaved"] == true; });
    }
    void open(const fs::path& file)
    {
        hands->keys("ctrl+o");
        hands->see("Open a part");
        hands->type(file.string());
        hands->keys("Return"); // a file that cannot be read costs nothing: nobody is asked
    }
};

} // namespace

TEST_F(RefusedByHand, AFileThatIsNoMeshLeavesThePartAndItsResults)
{
    std::ofstream(folder / "torn.stl") << "solid torn\n facet normal 0 0 1\n  outer loop\n   vertex 0 0";
    start_with_unfolded_dome();
    open(folder / "torn.stl");
    const Json now =
        hands->see_that("the refusal", [](const Json& r) { return has_error(r, "torn.stl") && !r["job"]["running"]; });
    EXPECT_EQ(now["part"]["file"], "assets/parts/dome.obj");
    EXPECT_EQ(now["stages"]["solve"], true);
    EXPECT_EQ(now["project"]["unsaved"], true);
    EXPECT_EQ(hands->viewer().title(), "dome* - SPIA");
    hands->see_part_of_line("dome.obj is still open");

    hands->click("File");
    hands->click("Recent");
    EXPECT_FALSE(hands->sees_now("torn.stl"));
    hands->keys("Escape");
}

TEST_F(RefusedByHand, TheFaultsOfAnotherFileAreShownAndMended)
{
    shapes::write_mesh(folder / "two.obj", shapes::two_rectangles());
    start_with_unfolded_dome();
    open(folder / "two.obj");
    hands->see("two.obj was refused.");
    const Json before = hands->viewer().report();
    EXPECT_EQ(before["part"]["file"], "assets/parts/dome.obj");
    hands->click("Show its faults");
    hands->see("Refused: two.obj");
    hands->click("Show");
    hands->see_that("a place of the fault", [](const Json& r) { return r["doctor"].contains("shown"); });
    hands->click("Shown");
    hands->see_that("no place", [](const Json& r) { return !r["doctor"].contains("shown"); });
    hands->click("Back to dome.obj");
    Json now = hands->see_that("the part", [](const Json& r) { return !r["doctor"].contains("refused_file"); });
    EXPECT_EQ(now["view"]["camera"], before["view"]["camera"]);
    EXPECT_EQ(now["stages"]["solve"], true);

    open(folder / "two.obj");
    hands->click("Show its faults");
    hands->click("Keep the largest piece");
    hands->see("Unsaved changes");
    hands->click("Continue without saving");
    now = hands->see_that("the mended part", [&](const Json& r) {
        return r["part"].is_object() && r["part"]["file"] == (folder / "two.obj").string();
    });
    EXPECT_EQ(hands->viewer().title(), "two - SPIA");
}

} // namespace spia::viewer
