#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <optional>

#include "tests/ui/on_screen.h"
#include "tests/ui/viewer_process.h"

namespace spia::viewer {
namespace {

/// Where a corner of the grid lies on the blank; pixels of the window.
glm::dvec2 corner_on_screen(const Json& report, int corner)
{
    const Json& at = report["corners"][size_t(corner)]["blank"];
    return on_screen(report, View::blank, {at[0].get<double>(), at[1].get<double>(), 0});
}

/// A window of 1366 by 768 pixels with the sample part as a project, unfolded by key: every test
/// begins here.
struct Mouse : testing::Test {
    std::filesystem::path folder =
        scratch_folder(std::string("mouse-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::unique_ptr<OpenViewer> viewer;

    void SetUp() override
    {
        const std::filesystem::path script = folder / "make.json";
        std::ofstream(script) << R"({"schema": "spia-script/1", "actions": [
            {"do": "open_part", "file": "assets/parts/inner-panel.obj"}, {"do": "wait"}, {"do": "set_patches"},
            {"do": "save_project", "file": "panel.spia"}]})";
        const Ended made = run_viewer(folder, {"--script", script.string()});
        ASSERT_EQ(made.exit_code, 0) << made.errors;
        viewer = std::make_unique<OpenViewer>(
            folder, std::vector<std::string>{"panel.spia", "--width", "1366", "--height", "768"});
        viewer->wait("the part", [](const Json& now) { return now["stages"]["read"] == true; });
    }
    Json unfold()
    {
        viewer->keys("F5");
        return viewer->wait("the surface after F5", [](const Json& now) {
            return now["stages"]["fit"] == true && now["job"]["running"] == false;
        });
    }
    /// Letters act in the view that has the keyboard.
    void letter(const char* key)
    {
        if (viewer->report()["window"]["focus"].is_null()) {
            viewer->keys("F4");
            viewer->wait("a view with the keyboard",
                         [](const Json& now) { return now["window"]["focus"].is_string(); });
        }
        viewer->keys(key);
    }
    Json tool(const char* key, const char* name)
    {
        letter(key);
        return viewer->wait(name, [&](const Json& now) { return now["view"]["tool"] == name; });
    }
    /// On a line in the panel on the right.
    void click_text(const char* line)
    {
        constexpr double panel = 1050; // where it begins
        std::optional<Json> there;
        viewer->wait(line, [&](const Json& now) {
            for (const Json& text : now["window"]["texts"])
                if (text["text"] == line && text["at"][0] > panel)
                    there = text;
            return there.has_value();
        });
        const Json &at = (*there)["at"], &size = (*there)["size"];
        viewer->click(at[0].get<double>() + size[0].get<double>() / 2, at[1].get<double>() + size[1].get<double>() / 2);
    }
    Json wait_for(const char* pointer, const Json& value)
    {
        return viewer->wait(std::string(pointer) + " is " + value.dump(),
                            [&](const Json& now) { return now.at(Json::json_pointer(pointer)) == value; });
    }
};

TEST_F(Mouse, PicksFacesAndTakesItBack)
{
    tool("p", "pick");
    const glm::dvec2 first = in_view(viewer->report(), View::part, 0.5, 0.55);
    const Json hovered = viewer->move(first.x, first.y)["hovered"];
    ASSERT_TRUE(hovered.is_number()) << "the part is not in the middle of its view";
    viewer->press(1);
    viewer->release(1);
    Json now = wait_for("/selection/faces", 1);
    EXPECT_EQ(now["selection"]["first"][0], hovered) << "the face that lit up is the one a click takes";

    glm::dvec2 second = first;
    while (viewer->report()["hovered"].is_null() || viewer->report()["hovered"] == hovered) {
        second.x += 10;
        ASSERT_LT(second.x, in_view(now, View::part, 1, 1).x) << "there is no other face to the right";
        viewer->move(second.x, second.y);
    }
    viewer->hold("shift");
    viewer->click(second.x, second.y);
    viewer->let_go("shift");
    now = wait_for("/selection/faces", 2);

    tool("b", "box");
    const glm::dvec2 from = in_view(now, View::part, 0.3, 0.3), to = in_view(now, View::part, 0.7, 0.8);
    viewer->drag(from.x, from.y, to.x, to.y);
    now = viewer->wait("faces in a box", [](const Json& r) { return r["selection"]["faces"] > 100; });
    const Json in_box = now["selection"];
    EXPECT_EQ(now["history"]["undo"], "Select by box");
    viewer->keys("ctrl+z");
    now = wait_for("/selection/faces", 2);
    viewer->keys("ctrl+shift+z");
    now = wait_for("/selection/faces", in_box["faces"]);
    EXPECT_EQ(now["selection"], in_box);
    viewer->keys("ctrl+z");
    wait_for("/selection/faces", 2);
    viewer->keys("ctrl+y");
    wait_for("/selection/faces", in_box["faces"]);
    viewer->keys("Escape");
    wait_for("/selection/faces", 0);
}

TEST_F(Mouse, ADragFasterThanAFrameKeepsItsStart)
{
    tool("b", "box");
    const Json before = viewer->report();
    const glm::dvec2 from = in_view(before, View::part, 0.3, 0.3), to = in_view(before, View::part, 0.7, 0.8);
    viewer->drag(from.x, from.y, to.x, to.y);
    Json now = viewer->wait("faces in a box", [](const Json& r) { return r["selection"]["faces"] > 100; });
    const Json in_box = now["selection"];
    viewer->keys("Escape");
    wait_for("/selection/faces", 0);
    viewer->fling(from.x, from.y, to.x, to.y);
    now = viewer->wait("faces in the same box", [](const Json& r) { return r["selection"]["faces"] > 0; });
    EXPECT_EQ(now["selection"], in_box);

    const Json solved = unfold();
    tool("c", "corners");
    const glm::dvec2 corner = corner_on_screen(solved, 0), there = corner + glm::dvec2(60, 0);
    viewer->fling(corner.x, corner.y, there.x, there.y);
    viewer->wait("the corner where the mouse was let go", [&](const Json& r) {
        return r["options"]["corners"].is_array() && r["job"]["running"] == false && r["corners"].is_array() &&
               glm::length(corner_on_screen(r, 0) - there) < 25;
    });
}

TEST_F(Mouse, TurnsZoomsAndEnlargesViews)
{
    const Json before = viewer->report();
    const glm::dvec2 middle = in_view(before, View::part, 0.5, 0.5);
    viewer->drag(middle.x, middle.y, middle.x + 60, middle.y + 30, 3);
    Json now = viewer->wait("a turned part", [&](const Json& r) {
        return r["view"]["camera"]["part"]["turn"] != before["view"]["camera"]["part"]["turn"];
    });
    EXPECT_EQ(now["view"]["camera"]["quads"]["turn"], now["view"]["camera"]["part"]["turn"]) << "they are linked";
    EXPECT_EQ(now["view"]["camera"]["blank"], before["view"]["camera"]["blank"]);
    EXPECT_EQ(now["view"]["camera"]["part"]["height"], before["view"]["camera"]["part"]["height"]);

    viewer->move(middle.x, middle.y);
    const double height = now["view"]["camera"]["part"]["height"];
    viewer->wheel(2);
    now = viewer->wait("a nearer part", [&](const Json& r) {
        return std::abs(r["view"]["camera"]["part"]["height"].get<double>() / height - std::pow(1.15, -2)) < 1e-6;
    });
    viewer->wheel(-1);
    viewer->wait("a farther part", [&](const Json& r) {
        return std::abs(r["view"]["camera"]["part"]["height"].get<double>() / height - 1 / 1.15) < 1e-6;
    });

    for (const Json& wanted : {Json("blank"), Json(nullptr)}) {
        const glm::dvec2 title = in_view(viewer->report(), View::blank, 0.3, 0) - glm::dvec2(0, 12);
        for (int tries = 0; tries < 8; ++tries) { // a double click is a matter of time: 0.3 s, yet
                                                  // in two frames
            viewer->move(title.x, title.y);
            viewer->double_click(50 + 30 * tries);
            if (viewer->move(title.x + 1, title.y)["view"]["maximised"] == wanted)
                break;
        }
        now = viewer->report();
        ASSERT_EQ(now["view"]["maximised"], wanted) << "after a double click on the title";
        EXPECT_EQ(now["window"]["views"].size(), wanted.is_null() ? 4 : 1);
    }
}

TEST_F(Mouse, ResizesTheWindowFromSmallToLarge)
{
    letter("f"); // the views of a project are kept as they were
    const Json before = viewer->move(5, 300);
    for (const auto& [width, height] : {std::pair(800, 600), std::pair(3840, 2160), std::pair(1366, 768)}) {
        viewer->resize(width, height);
        viewer->move(5, 300);
        const Json now = wait_for("/window/size", {float(width), float(height)});
        ASSERT_EQ(now["window"]["views"].size(), 4);
        for (const auto& [name, place] : now["window"]["views"].items()) {
            const double x = place["at"][0], y = place["at"][1], w = place["size"][0], h = place["size"][1];
            EXPECT_GT(w, 0.25 * width) << name << " in " << width;
            EXPECT_GT(h, 0.25 * height) << name << " in " << width;
            EXPECT_LE(x + w, width) << name;
            EXPECT_LE(y + h, height) << name;
        }
        letter("f");
        EXPECT_EQ(viewer->move(6, 300)["view"]["camera"], now["view"]["camera"])
            << "the views fill again what they have at " << width;
    }
    EXPECT_EQ(viewer->report()["view"]["camera"]["part"], before["view"]["camera"]["part"]) << "there and back";
}

TEST_F(Mouse, DragsACornerChoosesAFieldAndSaves)
{
    const Json solved = unfold();
    EXPECT_EQ(solved["options"]["corners"], nullptr) << "they are proposed";
    tool("c", "corners");
    const glm::dvec2 from = corner_on_screen(solved, 0), to = from + glm::dvec2(60, 0);
    viewer->move(from.x, from.y);
    viewer->press(1);
    for (const double x : {20., 40., 60.})
        viewer->move(from.x + x, from.y);
    Json now = viewer->wait("the grid follows the mouse", [&](const Json& r) {
        return r["corners"].is_array() && glm::length(corner_on_screen(r, 0) - to) < 25;
    });
    viewer->release(1);
    now = viewer->wait("a fine grid", [&](const Json& r) {
        return r["job"]["running"] == false && r["stages"]["fit"] == true && r["figures"]["grid"]["columns"] > 30;
    });
    EXPECT_EQ(now["history"]["undo"], "Move corner 1");
    EXPECT_TRUE(now["options"]["corners"].is_array());
    EXPECT_LT(glm::length(corner_on_screen(now, 0) - to), 25);
    for (int k = 1; k < 4; ++k)
        EXPECT_EQ(now["corners"][size_t(k)]["vertex"], solved["corners"][size_t(k)]["vertex"]) << "corner " << k + 1;
    const Json moved = now["corners"];
    viewer->keys("ctrl+z");
    now = wait_for("/corners/0/vertex", solved["corners"][0]["vertex"]);
    EXPECT_EQ(now["options"]["corners"], nullptr) << "one drag is one step of undo";
    viewer->keys("ctrl+y");
    wait_for("/corners/0/vertex", moved[0]["vertex"]);

    ASSERT_EQ(now["display"]["field"], "thinning");
    click_text("Thinning");
    click_text("Major strain");
    now = wait_for("/display/field", "strain_major");
    EXPECT_LT(now["field"]["least"], now["field"]["greatest"]);

    EXPECT_TRUE(now["project"]["unsaved"]);
    viewer->keys("ctrl+q"); // asks, for there is unsaved work
    viewer->move(5, 300);
    viewer->keys("Escape");
    viewer->move(6, 300);
    viewer->keys("ctrl+s");
    wait_for("/project/unsaved", false);
    viewer->keys("ctrl+q");
    EXPECT_EQ(viewer->wait_for_end(), 0);

    const Ended reopened = run_viewer(folder, {"panel.spia"});
    EXPECT_EQ(reopened.exit_code, 0) << reopened.errors;
    EXPECT_EQ(reopened.report["corners"][0]["vertex"], moved[0]["vertex"]);
    EXPECT_EQ(reopened.report["display"]["field"], "strain_major");
}

TEST_F(Mouse, DragsAControlPointAndALatticePointAndTakesThemBack)
{
    unfold();
    Json now = tool("k", "shape");
    const auto on_surface = [](const Json& report, const Json& at) {
        return on_screen(report, View::surface, {at[0].get<double>(), at[1].get<double>(), at[2].get<double>()});
    };
    const auto drag = [&](const char* undo_name) {
        const glm::dvec2 middle = in_view(viewer->report(), View::surface, 0.45, 0.55);
        for (double right = 0; viewer->report()["handles"]["picked"].empty() && right < 120; right += 12) {
            viewer->click(middle.x + right, middle.y); // a lattice is wide: look for a point
        }
        now = viewer->report();
        ASSERT_EQ(now["handles"]["picked"].size(), 1u);
        const Json before = now["handles"]["picked"][0];
        const glm::dvec2 from = on_surface(now, before["at"]), to = from + glm::dvec2(40, -25);
        viewer->drag(from.x, from.y, to.x, to.y);
        now = viewer->wait("the handle under the mouse", [&](const Json& r) {
            return glm::length(on_surface(r, r["handles"]["picked"][0]["at"]) - to) < 2;
        });
        EXPECT_EQ(now["handles"]["picked"][0]["number"], before["number"]);
        EXPECT_EQ(now["history"]["undo"], undo_name);
        EXPECT_FALSE(now["figures"]["deformation"]["largest_mm"].is_null());
        EXPECT_TRUE(now["figures"]["certificate"]["patches"].is_array()) << "judged when the drag has ended";
        viewer->keys("ctrl+z");
        viewer->wait("the handle where it was", [&](const Json& r) { return r["handles"]["picked"][0] == before; });
        viewer->keys("Escape");
        viewer->wait("nothing picked", [&](const Json& r) { return r["handles"]["picked"].empty(); });
    };
    drag("Move control points");
    const std::filesystem::path script = folder / "lattice.json";
    std::ofstream(script) << R"({"schema": "spia-script/1", "actions": [
        {"do": "open_project", "file": "panel.spia"}, {"do": "wait"}, {"do": "run_to", "stage": "fit"}, {"do": "wait"},
        {"do": "set_lattice", "lattice": {"count": [9, 9, 2]}}, {"do": "save_project", "file": "lattice.spia"}]})";
    viewer.reset();
    ASSERT_EQ(run_viewer(folder, {"--script", script.string()}).exit_code, 0);
    viewer = std::make_unique<OpenViewer>(
        folder, std::vector<std::string>{"lattice.spia", "--width", "1366", "--height", "768"});
    viewer->wait("the surface",
                 [](const Json& r) { return r["stages"]["fit"] == true && r["job"]["running"] == false; });
    tool("k", "shape");
    drag("Move lattice points");
}

} // namespace
} // namespace spia::viewer
