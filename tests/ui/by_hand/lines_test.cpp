// What is drawn on the part and what holds it, by mouse and keyboard.
#include "tests/support/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/ui/by_hand/on_part.h"

namespace spia::viewer {
namespace {

class LinesByHand : public OnPart {
protected:
    void draw(std::initializer_list<glm::dvec2> places)
    {
        for (const glm::dvec2& at : places)
            click_in(View::part, at.x, at.y);
        hands->keys("Return");
    }
};

TEST_F(LinesByHand, ADrawbeadGetsItsForceFromItsShapeAndGoes)
{
    start("assets/parts/dome.obj");
    hands->click("Line");
    draw({{0.4, 0.5}, {0.5, 0.55}, {0.6, 0.5}});
    Json now = count("/lines", 1);
    EXPECT_EQ(now["lines"][0]["kind"], "drawbead");
    click_left("Process");
    hands->scroll_to("Edge restraint", left_x, left_y);
    hands->click_beside("Edge restraint", -110, 0);
    now = hands->see_that("a held edge", [](const Json& r) { return r["process"]["edge_restraint"] > 0; });
    hands->click(now["lines"][0]["name"].get<std::string>()); // its row unfolds
    click_left("Force from the bead geometry");
    hands->see_that("a shape", [](const Json& r) { return r["lines"][0]["shape"].is_object(); });
    hands->click("x");
    count("/lines", 0);
}

TEST_F(LinesByHand, ASeamCutsThePart)
{
    shapes::write_mesh(folder / "sheet.obj", shapes::rectangle(100, 80, 20, 16));
    start((folder / "sheet.obj").string());
    hands->menu("View", "Look from", "Top");
    hands->click("Line");
    hands->click("drawbead");
    hands->click("seam");
    const Json before = hands->see_ready();
    for (const double x : {50., 100.}) { // from the middle of the sheet to that of its right side
        const glm::dvec2 at = on_screen(View::part, {x, 40, 0});
        hands->click_at(at.x, at.y);
    }
    hands->keys("Return");
    const Json now =
        hands->see_that("a seam", [](const Json& r) { return r["part"].is_object() && !r["part"]["seam"].empty(); });
    EXPECT_GT(now["part"]["vertices"], before["part"]["vertices"]) << "both sides of the cut have their own";
    click_left("Choose the seam automatically");
    hands->see_that("no seam", [](const Json& r) {
        return r["part"].is_object() && r["part"]["seam"].empty() && !r["job"]["running"];
    });
}

} // namespace
} // namespace spia::viewer
