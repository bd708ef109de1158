// How a file is read, by mouse and keyboard: its unit, its triangles, its faults.
#include "tests/support/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/ui/by_hand/on_part.h"

namespace spia::viewer {
namespace {

class ReadingByHand : public OnPart {};

TEST_F(ReadingByHand, TheUnitAndTheTrianglesAreChosen)
{
    start("assets/parts/dome.obj");
    const Json before = hands->viewer().report();
    hands->click("mm");
    hands->click("inch");
    value("/part/unit", "inch");
    hands->keys("ctrl+z");
    value("/part/unit", "mm");
    click_left("Remesh");
    hands->see_that("other triangles", [&](const Json& r) {
        return r["part"].is_object() && r["part"]["triangles"] != before["part"]["triangles"] && !r["job"]["running"];
    });
}

TEST_F(ReadingByHand, ARefusedPartShowsItsFaultAndIsMended)
{
    shapes::write_mesh(folder / "two.obj", shapes::two_rectangles());
    start((folder / "two.obj").string());
    hands->see("Refused: 1 fault");
    hands->click("Show");
    hands->see_that("a place of the fault", [](const Json& r) { return r["doctor"].contains("shown"); });
    hands->click("Shown");
    hands->see_that("no place", [](const Json& r) { return !r["doctor"].contains("shown"); });
    hands->click("Keep the largest piece");
    hands->see_that("the part", [](const Json& r) { return r["part"].is_object() && !r["job"]["running"]; });
}

} // namespace
} // namespace spia::viewer
