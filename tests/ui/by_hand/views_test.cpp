// Habits of the trade in the views: mice of other programs, the view cube, measuring, clipping. By
// mouse and keyboard alone.
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>

#include "app/viewer/model/actions/script.h"
#include "tests/ui/by_hand/hands.h"

namespace spia::viewer {
namespace {

using std::numbers::pi;

/// A web and a flange of 40 x 60 mm with a bend of 90 degrees and 6 mm radius between them, as an
/// OBJ file.
struct Angle {
    static constexpr double radius = 6, flat = 40, depth = 60, arc = pi / 2 * radius;
    static constexpr int per_flat = 8, per_arc = 6, columns = 2 * per_flat + per_arc, rows = 12;

    /// @param c  column of vertices, 0 to columns
    static Eigen::Vector3d place(double c, double v)
    {
        const double y = depth * v;
        if (c <= per_flat)
            return {flat * c / per_flat, y, 0};
        if (c >= per_flat + per_arc)
            return {flat + radius, y, radius + flat * (c - per_flat - per_arc) / per_flat};
        const double turn = pi / 2 * (c - per_flat) / per_arc;
        return {flat + radius * std::sin(turn), y, radius - radius * std::cos(turn)};
    }
    static void write(const std::filesystem::path& file)
    {
        std::ofstream out(file);
        out.precision(12);
        for (int r = 0; r <= rows; ++r)
            for (int c = 0; c <= columns; ++c)
                out << "v " << place(c, double(r) / rows).transpose() << '\n';
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < columns; ++c) {
                const int a = r * (columns + 1) + c + 1, b = a + columns + 1;
                out << "f " << a << ' ' << a + 1 << ' ' << b + 1 << "\nf " << a << ' ' << b + 1 << ' ' << b << '\n';
            }
    }
};

Camera camera_of(const Json& report)
{
    Json action = report.at("view");
    action["do"] = "set_view";
    return action_from_json(action).as<SetViewSettings>()->view.camera[size_t(View::part)];
}

class ViewsByHand : public testing::Test {
protected:
    std::filesystem::path folder =
        scratch_folder(std::string("views-by-hand-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::unique_ptr<Hands> hands;

    void SetUp() override
    {
        Angle::write(folder / "angle.obj");
        hands = std::make_unique<Hands>(folder, std::vector<std::string>{"angle.obj"});
        hands->size(1280, 720);
        hands->see_that("the part", [](const Json& now) { return now["stages"]["read"] == true; });
        hands->see_ready();
    }
    OpenViewer& viewer() { return hands->viewer(); }
    glm::dvec2 view_corner() { return item(viewer().report()["window"]["views"]["part"], 0, 0); }
    glm::dvec2 view_size()
    {
        const Json size = viewer().report()["window"]["views"]["part"]["size"];
        return {size[0].get<double>(), size[1].get<double>()};
    }
    static glm::dvec2 item(const Json& place, double x, double y)
    {
        return {place["at"][0].get<double>() + x * place["size"][0].get<double>(),
                place["at"][1].get<double>() + y * place["size"][1].get<double>()};
    }
    glm::dvec2 middle() { return view_corner() + view_size() / 2.; }
    /// Where a place of the part lies in the window.
    glm::dvec2 at(const Eigen::Vector3d& place)
    {
        return view_corner() + glm::dvec2(pixel_of(camera_of(viewer().report()), place, view_size()));
    }
    void click(glm::dvec2 at) { hands->click_at(at.x, at.y); }
    Json drag(int button, glm::dvec2 by = {40, 30})
    {
        const glm::dvec2 from = middle(), to = from + by;
        return viewer().drag(from.x, from.y, to.x, to.y, button);
    }
    void choose_mouse(const char* title, const char* name)
    {
        hands->menu("View", "Mouse", title);
        hands->see_that(title, [&](const Json& now) { return now["view"]["mouse"] == name; });
    }
    Json turned_from(const Camera& before)
    {
        return hands->see_that("a turned part", [&](const Json& now) { return camera_of(now).turn != before.turn; });
    }
    Json value(const char* pointer, const Json& wanted)
    {
        return hands->see_that(std::string(pointer) + " is " + wanted.dump(),
                               [&](const Json& now) { return now.at(Json::json_pointer(pointer)) == wanted; });
    }
};

TEST_F(ViewsByHand, TheMouseHasTheHabitsOfNxAndOfCatia)
{
    choose_mouse("Siemens NX", "nx");
    Camera before = camera_of(viewer().report());
    drag(2); // the middle button turns
    turned_from(before);
    before = camera_of(viewer().report());
    viewer().hold("shift");
    drag(2); // and pans with Shift
    viewer().let_go("shift");
    Json now =
        hands->see_that("a moved part", [&](const Json& report) { return camera_of(report).target != before.target; });
    EXPECT_EQ(camera_of(now).turn, before.turn);
    before = camera_of(now);
    drag(3); // the right button is free for other things
    EXPECT_EQ(camera_of(viewer().report()), before);

    choose_mouse("CATIA", "catia");
    drag(2); // the middle button pans
    now =
        hands->see_that("a moved part", [&](const Json& report) { return camera_of(report).target != before.target; });
    EXPECT_EQ(camera_of(now).turn, before.turn);
    before = camera_of(now);
    // With the right one held as well it turns, and after that is let go it zooms.
    const glm::dvec2 from = middle();
    viewer().move(from.x, from.y);
    viewer().press(2);
    viewer().press(3);
    viewer().move(from.x + 30, from.y + 10);
    now = turned_from(before);
    EXPECT_EQ(camera_of(now).target, before.target);
    EXPECT_EQ(camera_of(now).height, before.height);
    const Camera turned = camera_of(now);
    viewer().release(3);
    viewer().move(from.x + 30, from.y - 40);
    viewer().release(2);
    now = hands->see_that("a larger part", [&](const Json& r) { return camera_of(r).height < turned.height; });
    EXPECT_EQ(camera_of(now).turn, turned.turn);
    EXPECT_EQ(now["selection"]["faces"], 0) << "no click of the gesture is one of a tool";
    hands->keys("F1");
    hands->see("as in CATIA; others in View > Mouse");
    hands->keys("Escape");
}

TEST_F(ViewsByHand, ACubeLooksFromItsSidesAndTurnsByADrag)
{
    hands->menu("View", "Look from", "Front");
    const auto viewer_at = [](const Json& now) { return camera_of(now).turn * glm::dvec3(0, 0, 1); };
    hands->see_that("the part from the front", [&](const Json& r) { return viewer_at(r).y < -0.999; });
    const auto cube = [&](double x, double y) { return item(viewer().report()["window"]["items"]["cube part"], x, y); };
    click(cube(0.5, 0.23)); // its upper edge, seen from the front
    Json now = hands->see_that("the part from the front above",
                               [&](const Json& r) { return std::abs(viewer_at(r).z - std::sqrt(0.5)) < 1e-6; });
    EXPECT_NEAR(viewer_at(now).y, -std::sqrt(0.5), 1e-6);
    click(cube(0.5, 0.3)); // the upper one of two faces
    now = hands->see_that("the part from above", [&](const Json& r) { return viewer_at(r).z > 0.999; });
    for (const char* other : {"quads", "surface"}) // linked as ever
        EXPECT_EQ(now["view"]["camera"][other]["turn"], now["view"]["camera"]["part"]["turn"]);
    const Camera before = camera_of(now);
    const glm::dvec2 from = cube(0.5, 0.5);
    viewer().drag(from.x, from.y, from.x + 30, from.y + 12);
    now = turned_from(before);
    EXPECT_EQ(camera_of(now).target, before.target);
    EXPECT_EQ(now["selection"]["faces"], 0);
    EXPECT_FALSE(now["window"]["items"].contains("cube blank")) << "a flat drawing is not turned";
}

TEST_F(ViewsByHand, ARadiusAnAngleAndADistanceAreMeasured)
{
    click(at(Angle::place(2, 0.5))); // the view gets the keyboard
    hands->keys("m");
    value("/view/tool", "measure");
    hands->click("Distance");
    hands->click("Radius of a fillet or bend");
    value("/view/measure", "rounding");
    click(at(Angle::place(Angle::per_flat + 4.5, 0.55)));
    hands->see("M1 R 6.00 mm");
    Json now = hands->see_part_of_line("Farthest from the cylinder");
    EXPECT_NEAR(now["measurements"][0]["value"].get<double>(), Angle::radius, 1e-4);
    EXPECT_LT(now["measurements"][0]["residual"].get<double>(), 1e-4);
    click(at(Angle::place(1.3, 0.3)));
    hands->see_part_of_line("is flat");
    EXPECT_EQ(viewer().report()["measurements"].size(), 1u);

    const auto choose = [&](const char* now_chosen,
                            const char* kind) { // above the views; the list of results has the
                                                // words, too
        double x = 0, y = 1e9;
        const Json report = viewer().report();
        for (const Json& text : report["window"]["texts"])
            if (text["text"] == now_chosen && text["at"][1].get<double>() < y) {
                x = text["at"][0].get<double>() + 5;
                y = text["at"][1].get<double>();
            }
        hands->click_at(x, y + 5);
        hands->click(kind);
    };
    choose("Radius of a fillet or bend", "Angle of two faces");
    click(at(Angle::place(2.3, 0.4)));
    click(at(Angle::place(Angle::per_flat + Angle::per_arc + 3.3, 0.4)));
    now = hands->see_that("an angle", [](const Json& r) { return r["measurements"].size() == 2; });
    EXPECT_NEAR(now["measurements"][1]["value"].get<double>(), 90, 1e-3);

    choose("Angle of two faces", "Distance");
    click(at(Angle::place(1, 1. / Angle::rows)));
    click(at(Angle::place(5, 1. / Angle::rows)));
    now = hands->see_that("a distance", [](const Json& r) { return r["measurements"].size() == 3; });
    EXPECT_NEAR(now["measurements"][2]["value"].get<double>(), Angle::flat * 4 / Angle::per_flat, 1e-3)
        << "clicks mean vertices near by";
    hands->scroll_to("Measurements", 1150, 500);
    hands->click("x"); // the last drawn
    hands->see_that("one less", [](const Json& r) { return r["measurements"].size() == 2; });
    hands->keys("ctrl+z");
    hands->see_that("all three", [](const Json& r) { return r["measurements"].size() == 3; });
    hands->scroll_to("Remove all", 1150, 500);
    hands->click("Remove all");
    hands->see_that("none", [](const Json& r) { return r["measurements"].empty(); });
}

TEST_F(ViewsByHand, TheBlankIsMeasuredInItsOwnView)
{
    hands->keys("F5");
    hands->see_that("all of it",
                    [](const Json& r) { return r["stages"]["fit"] == true && r["job"]["running"] == false; });
    click(at(Angle::place(2, 0.5)));
    hands->keys("m");
    value("/view/tool", "measure");
    const auto measure_in = [&](const char* view, size_t count) {
        const Json place = viewer().report()["window"]["views"][view];
        click(item(place, 0.75, 0.55));
        click(item(place, 0.62, 0.7));
        const Json now =
            hands->see_that("a distance", [&](const Json& r) { return r["measurements"].size() == count; });
        EXPECT_EQ(now["measurements"][count - 1]["on"], view);
        EXPECT_GT(now["measurements"][count - 1]["value"], 1);
    };
    measure_in("blank", 1);
    measure_in("quads", 2);
    measure_in("surface", 3);
}

TEST_F(ViewsByHand, APlaneCutsTheViewsAndWhatIsCutAwayIsNotPicked)
{
    const Eigen::Vector3d on_flange = Angle::place(Angle::columns - 1.3, 0.5), on_web = Angle::place(2.3, 0.5);
    click(at(on_web));
    hands->keys("p");
    value("/view/tool", "pick");
    click(at(on_flange));
    value("/selection/faces", 1);
    hands->keys("h");
    hands->see("Clipped");
    Json now =
        hands->see_that("a plane through the middle", [](const Json& r) { return r["view"]["clip"]["on"] == true; });
    EXPECT_NEAR(now["view"]["clip"]["place_mm"].get<double>(), (Angle::flat + Angle::radius) / 2, 1e-3);
    click(at(on_flange));
    value("/selection/faces", 0); // x > 23 mm is cut away: a click there takes nothing
    click(at(on_web));
    value("/selection/faces", 1);
    hands->click("Flip");
    value("/view/clip/flip", true);
    click(at(on_web));
    value("/selection/faces", 0);
    click(at(on_flange));
    value("/selection/faces", 1);
    hands->click("Off");
    hands->see_no("Clipped");
    hands->menu("View", "Clip");
    hands->see("Clipped");
    hands->click("view");
    value("/view/clip/axis", "view");
}

} // namespace
} // namespace spia::viewer
