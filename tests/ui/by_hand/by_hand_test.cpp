// The window as its users have it: from a start without a file to the files of the export, by mouse
// and keyboard alone.
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <thread>

#include "engine/exchange/cad/write_step.h"
#include "tests/support/known_surfaces.h"
#include "tests/ui/by_hand/drop_source.h"
#include "tests/ui/by_hand/hands.h"
#include "tests/ui/on_screen.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

using std::numbers::pi;

NurbsSurface moved(NurbsSurface surface, const Vector3d& by)
{
    surface.control.colwise() += by;
    return surface;
}

/// A channel as a CAD system gives it: five faces, a web of 80 x 60 mm (x, z) between two flanges
/// of 25 mm that taper to 20 mm, radius 6 mm. Its blank has eight corners.
struct Channel {
    static constexpr double length = 60, web = 80, flange = 25, tip = 20, radius = 6;
    static constexpr double area =
        // unrolled, mm2
        web * length + 2 * (pi / 2 * radius * length + flange * (length + tip) / 2);
    // of the blank, to where the flanges begin, mm
    static constexpr double half = web / 2 + pi / 2 * radius;

    static void write(const fs::path& file)
    {
        const double right = web / 2 + radius, low = (length - tip) / 2, high = (length + tip) / 2;
        const auto on = [](double x, double y, double z) { return Vector3d(x, y, z); };
        write_step(file,
                   std::vector<NurbsSurface>{
                       surfaces::bilinear(on(-web / 2, 0, 0), on(web / 2, 0, 0), on(-web / 2, 0, length),
                                          on(web / 2, 0, length)),
                       moved(surfaces::cylinder(radius, length, -pi / 2, 0), {web / 2, radius, 0}),
                       surfaces::bilinear(on(right, radius, 0), on(right, radius + flange, low),
                                          on(right, radius, length), on(right, radius + flange, high)),
                       moved(surfaces::cylinder(radius, length, -pi, -pi / 2), {-web / 2, radius, 0}),
                       surfaces::bilinear(on(-right, radius + flange, low), on(-right, radius, 0),
                                          on(-right, radius + flange, high), on(-right, radius, length)),
                   },
                   "channel");
    }
};

/// A place of the blank; pixels of the window. @param at  mm
glm::dvec2 of_blank(const Json& report, glm::dvec2 at) { return on_screen(report, View::blank, {at.x, at.y, 0}); }

/// Where a corner of the grid lies on the blank, mm.
glm::dvec2 corner_of(const Json& report, int corner)
{
    const Json& at = report["corners"][size_t(corner)]["blank"];
    return {at[0].get<double>(), at[1].get<double>()};
}

/// The corner of the channel's blank on the same flange and the same side as a corner of the grid:
/// where the flange begins for one at its tip, and the other way round. mm
glm::dvec2 beside(const Json& report, int corner)
{
    glm::dvec2 middle(0);
    for (int k = 0; k < 4; ++k)
        middle += corner_of(report, k) / 4.;
    double xx = 0, xy = 0, yy = 0; // the blank is longer than wide: its axis is that of the
                                   // greatest moment
    for (int k = 0; k < 4; ++k) {
        const glm::dvec2 r = corner_of(report, k) - middle;
        xx += r.x * r.x;
        xy += r.x * r.y;
        yy += r.y * r.y;
    }
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
    const glm::dvec2 r = corner_of(report, corner) - middle;
    const double a = glm::dot(r, along), b = glm::dot(r, across);
    const bool at_tip = std::abs(a) > Channel::half + Channel::flange / 2;
    return middle + along * std::copysign(Channel::half + (at_tip ? 0 : Channel::flange), a) +
           across * std::copysign((at_tip ? Channel::length : Channel::tip) / 2, b);
}

/// Of work that is not saved in a project.
size_t kept_files(const fs::path& folder)
{
    if (!fs::exists(folder / "state"))
        return 0;
    return size_t(std::count_if(fs::recursive_directory_iterator(folder / "state"), fs::recursive_directory_iterator(),
                                [](const fs::directory_entry& entry) { return entry.path().extension() == ".spia"; }));
}

/// What must be the same after a project was saved and opened again.
Json kept_state(const Json& report)
{
    Json kept;
    for (const char* key :
         {"part", "regions", "options", "corners", "unfolding", "display", "lines", "process", "limits"})
        kept[key] = report[key];
    kept["part"].erase("file");
    return kept;
}

struct Screen {
    int width, height;
    bool dark;
};

std::ostream& operator<<(std::ostream& out, const Screen& screen)
{
    return out << screen.width << "x" << screen.height << (screen.dark ? "-dark" : "-light");
}

class ByHand : public testing::Test {
protected:
    Screen screen{1280, 720, false};
    fs::path folder = scratch_folder("by-hand-" + name_of_test());
    std::unique_ptr<Hands> hands;

    static std::string name_of_test()
    {
        std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        std::replace(name.begin(), name.end(), '/', '-');
        return name;
    }
    void start(const std::vector<std::string>& arguments = {})
    {
        hands = std::make_unique<Hands>(folder, arguments);
        hands->size(screen.width, screen.height);
    }
    /// @returns the report when the part is there
    Json start_with(const std::string& part)
    {
        start({part});
        return hands->see_that("the part", [](const Json& now) { return now["stages"]["read"] == true; });
    }
    /// Work of the user's, which would be lost.
    void pick_all()
    {
        hands->keys("F4");
        hands->keys("i");
        hands->see_that("picked faces", [](const Json& r) { return r["project"]["unsaved"] == true; });
    }
    void choose_theme()
    {
        if (hands->viewer().report()["view"]["dark"] != screen.dark)
            hands->menu("View", "Dark theme");
        hands->see_that("the theme", [&](const Json& now) { return now["view"]["dark"] == screen.dark; });
    }
    void TearDown() override
    {
        if (hands)
            std::printf("longest wait of a step: %.1f s\n", hands->longest_wait());
    }
};

/// The whole path on a small and a large screen, light and dark.
class ByHandOnScreens : public ByHand, public testing::WithParamInterface<Screen> {
protected:
    void SetUp() override { screen = GetParam(); }
};

TEST_P(ByHandOnScreens, FromAnEmptyStartToFilesAndBack)
{
    Channel::write(folder / "channel.step");
    start();
    choose_theme();

    hands->keys("ctrl+o");
    hands->see("Open a part");
    hands->click("channel.step");
    hands->click("Open");
    hands->see("Import a part");
    hands->see_part_of_line("STEP, lengths in mm");
    hands->click("Open");
    Json now = hands->see_that("the part", [](const Json& r) { return r["part"].is_object(); });
    hands->see_no("Import a part");

    hands->keys("F5");
    now = hands->see_that("blank, grid and surface", all_fresh);
    EXPECT_NEAR(now["figures"]["blank"]["area_mm2"].get<double>(), Channel::area, 0.005 * Channel::area)
        << "but for the chords of the bends";
    hands->see_part_of_line("Thinning");
    EXPECT_EQ(now["display"]["field"], "thinning");

    // The web stays: what is flat in the middle of the view.
    hands->tool("Smooth");
    const glm::dvec2 middle = in_view(hands->viewer().report(), View::part, 0.5, 0.5);
    hands->click_at(middle.x, middle.y);
    now = hands->see_that("picked faces", [](const Json& r) { return r["selection"]["faces"] > 0; });
    const std::string make = fmt::format("Make region of {} faces", now["selection"]["faces"].get<int>());
    constexpr double panel_x = 150, panel_y = 400; // in the panel of the steps
    hands->scroll_to(make, panel_x, panel_y);
    hands->click(make);
    now = hands->see_that("a region", [](const Json& r) { return r["regions"].size() == 1; });
    EXPECT_EQ(now["regions"][0]["kind"], "fixed");

    hands->scroll_to("Step by step", panel_x, panel_y);
    hands->click("Step by step");
    hands->scroll_to("Propose steps", panel_x, panel_y);
    hands->click("Propose steps");
    hands->scroll_to("Unfold step by step", panel_x, panel_y);
    hands->click("Unfold step by step");
    now = hands->see_that("the part laid flat by steps", [](const Json& r) {
        return r["job"]["running"] == false && r["unfolding"]["done"] == r["unfolding"]["steps"].size() &&
               r["unfolding"]["steps"].size() > 0;
    });
    hands->scroll_to("Blank of the steps", panel_x, panel_y);

    hands->tool("Corners");
    now = hands->see_that("the tool for corners", [](const Json& r) { return r["view"]["tool"] == "corners"; });
    const int before = now["corners"][0]["vertex"];
    const glm::dvec2 corner = of_blank(now, corner_of(now, 0)), to = of_blank(now, beside(now, 0));
    hands->viewer().drag(corner.x, corner.y, to.x, to.y);
    now = hands->see_that("a grid from the corner where it was let go", [&](const Json& r) {
        return r["options"]["corners"].is_array() && r["corners"].is_array() && r["corners"][0]["vertex"] != before &&
               all_fresh(r);
    });
    hands->keys("ctrl+z");
    hands->see_that("the corner where it was", [&](const Json& r) {
        return r["corners"].is_array() && r["corners"][0]["vertex"] == before && all_fresh(r);
    });

    hands->scroll_to("Within a tolerance", panel_x, panel_y);
    hands->click("Within a tolerance");
    hands->see_that("a surface within a tolerance",
                    [](const Json& r) { return r["options"]["fit"]["tolerance"].is_number() && all_fresh(r); });

    hands->keys("ctrl+e");
    hands->see("Export");
    hands->click_part("STEP AP242"); // not wanted
    hands->see("3 files");
    hands->keys("Return");
    hands->see("3 files written");
    hands->see_no("Writing the files");
    EXPECT_GT(fs::file_size(folder / "channel-out" / "channel.iges"), 1000);
    EXPECT_GT(fs::file_size(folder / "channel-out" / "channel.glb"), 1000);
    EXPECT_GT(fs::file_size(folder / "channel-out" / "channel.dxf"), 1000);
    hands->keys("Return");
    hands->see_no("files written");

    hands->menu("File", "Report (HTML)...");
    hands->see("Report");
    hands->click("Write the report");
    hands->see_that("the report", [&](const Json&) { return fs::exists(folder / "channel.html"); });

    hands->keys("ctrl+s");
    hands->see("Save the project");
    hands->click("Save");
    now = hands->see_that("saved work", [](const Json& r) { return r["project"]["unsaved"] == false; });
    const Json kept = kept_state(now);
    hands->keys("ctrl+q");
    EXPECT_EQ(hands->viewer().wait_for_end(), 0);

    start();
    hands->menu("File", "Recent");
    hands->click_part("channel.spia");
    now = hands->see_that("the project", all_fresh);
    EXPECT_EQ(kept_state(now).flatten(), kept.flatten());
    EXPECT_FALSE(now["project"]["unsaved"]);
}

class KeyboardByHandOnScreens : public ByHandOnScreens {};

TEST_P(KeyboardByHandOnScreens, TheSameWithoutTheMouse)
{
    Channel::write(folder / "channel.step");
    start();
    hands->keys("ctrl+o");
    hands->see("Open a part");
    for (int rows = 0; rows < 5 && !hands->sees_chosen("channel.step"); ++rows) { // beside folders
        hands->keys("Down");
        // nobody presses keys faster than the list follows
        std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    hands->keys("Return");
    hands->see("Import a part");
    hands->keys("Return");
    hands->see_that("the part", [](const Json& r) { return r["part"].is_object(); });
    hands->see_no("Import a part");
    if (screen.dark != hands->viewer().report()["view"]["dark"]) {
        hands->keys("F4"); // letters act in a view
        hands->see_that("a view with the keyboard", [](const Json& r) { return r["window"]["focus"] == "part"; });
        hands->keys("t");
    }
    hands->see_that("the theme", [&](const Json& r) { return r["view"]["dark"] == screen.dark; });
    hands->keys("F5");
    Json now = hands->see_that("blank, grid and surface", all_fresh);

    const auto to_view = [&](const char* view) {
        for (int k = 0; k < 6 && hands->viewer().report()["window"]["focus"] != view; ++k) {
            const Json before = hands->viewer().report()["window"]["focus"];
            hands->keys("F4");
            hands->see_that("another view", [&](const Json& r) { return r["window"]["focus"] != before; });
        }
    };
    to_view("part");
    hands->keys("n");
    hands->keys("Return"); // at the cross in the middle
    hands->see_that("picked faces", [](const Json& r) { return r["selection"]["faces"] > 0; });
    hands->menu_by_keys("Edit", "Make a region of the selection", "fixed");
    hands->see_that("a region", [](const Json& r) { return r["regions"].size() == 1; });

    hands->menu_by_keys("Run", "Propose steps");
    hands->see_that("steps",
                    [](const Json& r) { return r["unfolding"]["steps"].size() > 0 && r["job"]["running"] == false; });
    hands->menu_by_keys("Run", "Unfold step by step");
    hands->see_that("the part laid flat by steps", [](const Json& r) {
        return r["job"]["running"] == false && r["unfolding"]["done"] == r["unfolding"]["steps"].size();
    });

    to_view("blank");
    hands->keys("c");
    now = hands->see_that("the tool for corners", [](const Json& r) { return r["view"]["tool"] == "corners"; });
    const int corner = now["corners"][0]["vertex"];
    hands->keys("Up"); // to the next sharp turn
    hands->see_that("a moved corner", [&](const Json& r) {
        return r["corners"].is_array() && r["corners"][0]["vertex"] != corner && all_fresh(r);
    });
    hands->keys("ctrl+z");
    hands->see_that("the corner where it was", [&](const Json& r) {
        return r["corners"].is_array() && r["corners"][0]["vertex"] == corner && all_fresh(r);
    });

    hands->keys("ctrl+e");
    hands->see("4 files");
    hands->keys("Return");
    hands->see("4 files written");
    hands->keys("Return");
    hands->see_no("files written");
    EXPECT_GT(fs::file_size(folder / "channel-out" / "channel.iges"), 1000);

    hands->menu_by_keys("File", "Report (HTML)...");
    hands->see("Write the report");
    hands->keys("Return");
    hands->see_that("the report", [&](const Json&) { return fs::exists(folder / "channel.html"); });
    hands->keys("ctrl+s");
    hands->see("Save the project");
    hands->keys("Return");
    now = hands->see_that("saved work", [](const Json& r) { return r["project"]["unsaved"] == false; });
    const Json kept = kept_state(now);
    hands->keys("ctrl+q");
    EXPECT_EQ(hands->viewer().wait_for_end(), 0);

    start();
    hands->menu_by_keys("File", "Recent", "channel.spia");
    now = hands->see_that("the project", all_fresh);
    EXPECT_EQ(kept_state(now).flatten(), kept.flatten());
}

TEST_F(ByHand, AFileThatIsDroppedOpens)
{
    Channel::write(folder / "channel.step");
    start();
    const Json before = hands->viewer().report();
    const glm::dvec2 at = in_view(before, View::part, 0.5, 0.5);
    drop_files(hands->viewer().window(), {folder / "channel.step"}, int(at.x), int(at.y));
    hands->see("Import a part");
    hands->keys("Return");
    hands->see_that("the part", [&](const Json& r) {
        return r["part"].is_object() && r["part"]["file"] == (folder / "channel.step").string();
    });
}

TEST_F(ByHand, WhatIsTypedIntoNoFieldChangesNothing)
{
    const Json before = start_with("assets/parts/dome.obj");
    hands->type("bracket-v2.step");
    hands->keys("F1"); // whatever was typed has been taken when its window comes
    const Json now = hands->see("Keyboard and mouse");
    EXPECT_EQ(now["selection"], before["selection"]);
    EXPECT_EQ(now["view"], before["view"]);
    hands->see_part_of_line("click into one, or press F4");
    hands->keys("Escape");

    hands->keys("F4");
    hands->keys("i");
    hands->see_that("all faces picked, for the view has the keyboard",
                    [&](const Json& r) { return r["selection"]["faces"] == before["part"]["triangles"]; });
}

TEST_F(ByHand, AnotherFileWhileThereIsUnsavedWork)
{
    Channel::write(folder / "channel.step");
    start_with("assets/parts/dome.obj");
    hands->keys("F6");
    hands->see_that("the blank, which comes again by one key",
                    [](const Json& r) { return r["stages"]["solve"] == true && r["project"]["unsaved"] == false; });
    pick_all();
    const auto open_channel = [&] {
        hands->keys("ctrl+o");
        hands->see("Open a part");
        hands->type((folder / "channel.step").string());
        hands->keys("Return");
        hands->see("Import a part");
        hands->keys("Return");
        hands->see("Unsaved changes");
        hands->see_part_of_line("channel.step has been read");
    };
    open_channel();
    hands->click("Cancel");
    hands->see_no("Unsaved changes");
    const Json now = hands->see_ready();
    EXPECT_EQ(now["part"]["file"], "assets/parts/dome.obj") << "nothing is lost";
    EXPECT_EQ(now["selection"]["faces"], now["part"]["triangles"]);
    open_channel();
    hands->keys("Tab"); // from "Save..." to "Continue without saving"
    hands->keys("Return");
    hands->see_that("the other part",
                    [&](const Json& r) { return r["part"]["file"] == (folder / "channel.step").string(); });
}

TEST_F(ByHand, UnsavedWorkIsCalledByItsProjectIfItHasOne)
{
    fs::copy_file(fs::path(SPIA_SOURCE_DIR) / "assets/parts/dome.obj", folder / "dome.obj");
    start_with((folder / "dome.obj").string());
    pick_all();
    hands->keys("ctrl+q");
    hands->see_part_of_line("Your changes to dome.obj are not saved");
    hands->click("Cancel");
    hands->see_no("Unsaved changes");
    hands->keys("ctrl+s");
    hands->see("Save the project");
    hands->click("Save");
    hands->see_that("saved work", [](const Json& r) { return r["project"]["unsaved"] == false; });
    hands->keys("ctrl+z");
    hands->see_that("unsaved work", [](const Json& r) { return r["project"]["unsaved"] == true; });
    hands->keys("ctrl+q");
    hands->see_part_of_line("Your changes to the project dome.spia are not saved");
    hands->click("Cancel");
}

TEST_F(ByHand, TheDialogOfFilesSaysWhatItLeavesOutAndBeginsAnewEachTime)
{
    Channel::write(folder / "channel.step");
    std::ofstream(folder / "notes.txt") << "not a part";
    std::ofstream(folder / "table.xls") << "neither";
    start({"channel.step"});
    hands->see("Import a part");
    hands->keys("Return");
    hands->see_that("the part", [](const Json& r) { return r["stages"]["read"] == true; });
    for (int time = 0; time < 2; ++time) {
        hands->keys("ctrl+o");
        hands->see("Open a part");
        hands->see_part_of_line("not shown");
        EXPECT_FALSE(hands->sees_now("notes.txt"));
        hands->click("Show all files");
        hands->see("notes.txt");
        hands->type((folder / "nowhere.stl").string()); // takes the place of the name that stands
                                                        // there
        hands->keys("Return");
        hands->see_part_of_line("There is no file"); // the path may be on lines of its own
        hands->keys("Escape");
        hands->see_no("There is no file");
    }
    hands->keys("ctrl+o");
    hands->see("Open a part");
    hands->see_no("There is no file");
    hands->keys("Escape");
}

TEST_F(ByHand, EscapeCancels)
{
    start_with("assets/parts/inner-panel.obj");
    hands->keys("F5");
    hands->keys("Escape");
    hands->see_part_of_line("ancelled");
    const Json now = hands->see_ready();
    EXPECT_TRUE(now["part"].is_object()) << "the part stays";
    EXPECT_FALSE(now["stages"]["fit"]);
}

TEST_F(ByHand, AfterACrashBothDialogsCome)
{
    Channel::write(folder / "channel.step");
    start_with("assets/parts/dome.obj");
    hands->keys("F6");
    hands->see_that("the blank", [](const Json& r) { return r["stages"]["solve"] == true; });
    pick_all();
    hands->viewer().wait("work that is kept, which is done once the hand rests",
                         [&](const Json&) { return kept_files(folder) > 0; });
    hands->viewer().crash();

    start({"channel.step"});
    hands->see("Unsaved work");
    EXPECT_FALSE(hands->sees_now("Import a part")) << "it waits";
    hands->click("Recover");
    hands->see_no("Unsaved work");
    hands->see("Import a part");
    hands->click("Cancel");
    hands->see_no("Import a part");
    hands->see_that("the work of before", [](const Json& r) { return r["part"].is_object(); });
}

std::string name_of(const testing::TestParamInfo<Screen>& of)
{
    return fmt::format("{}x{}{}", of.param.width, of.param.height, of.param.dark ? "Dark" : "Light");
}

INSTANTIATE_TEST_SUITE_P(Screens, ByHandOnScreens,
                         testing::Values(Screen{1280, 720, false}, Screen{1280, 720, true}, Screen{1920, 1080, false},
                                         Screen{1920, 1080, true}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Screens, KeyboardByHandOnScreens,
                         testing::Values(Screen{1280, 720, true}, Screen{1920, 1080, false}), name_of);

} // namespace
} // namespace spia::viewer
