#include "app/viewer/model/actions/script.h"

#include <fmt/core.h>
#include <functional>
#include <gtest/gtest.h>
#include <set>

#include "engine/core/error.h"
#include "tests/unit/viewer/action_as.h"

namespace spia::viewer {
namespace {

std::string message(const std::function<void()>& work)
{
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

std::string script_of(const std::string& steps)
{
    return fmt::format(R"({{"schema":"spia-script/1","actions":[{}]}})", steps);
}

Json json(const char* text) { return parse_json(text, "text"); }

/// Every action once, with values that are not the defaults where its form would refuse these.
std::vector<Action> every_action()
{
    std::vector<Action> actions;
    AllActions::any([&]<class T>(std::type_identity<T>) {
        actions.push_back(T{});
        return false;
    });
    const glm::dvec2 pixel{12.5, 7}, size{640, 480};
    for (Action& action : actions) {
        const auto set = [&]<class T>(const T& value) {
            if (action.is<T>())
                action = value;
        };
        set(ListFile{"parts/door.stl"});
        set(OpenPart{"parts/door.stl", "inch", {{}, false, {"7", "body:2"}, Skin::middle, 0.02, 0.1, true}});
        set(SetUnit{"cm"});
        set(SetReading{{true, true, {"7"}, Skin::inner, 0., 1e-3}});
        set(SetSeam{{SeamOptions::Mode::given, {{3, 9, 4}, {1, 2}}}});
        RemeshOptions remesh;
        remesh.size = 2.5;
        remesh.tolerance = 0.125;
        set(SetRemeshing{remesh});
        set(FitMaterial{"bar.csv",
                        "mine.json",
                        {{TensileOptions::Kind::truly, true, 2e5}, "voce", "mine", 0.29, 7900, 1.1, 1.2, 1.3}});
        set(SaveMaterial{read_material(SPIA_SOURCE_DIR "/assets/materials/dp600.json"), "mine"});
        set(RemoveMaterial{"mine"});
        set(SetSkins{false});
        set(UseBlankOfSteps{true});
        set(OpenSteps{"steps.json"});
        set(SaveSteps{"steps.json"});
        set(SetTargetPlane{1, 2});
        set(SetCarrying{3, 4});
        set(ShowFault{2, 7});
        set(SetMaterial{"dp600"});
        set(SetThickness{0.8});
        set(SetDirection{Eigen::Vector3d(0.1, 0.2, -1)});
        set(SetCorner{3, 17, true});
        set(SetGrid{{30, 0, 12, 5, GridMethod::harmonic, 0.4, true}});
        set(SelectFaces{{3, 1, 2}, PickMode::remove});
        set(PickAt{View::blank, pixel, size, PickMode::add, 12.0, true});
        set(PickHandle{HandleKind::lattice, pixel, size, PickMode::add, 20});
        set(SelectHandles{HandleKind::lattice, {3, 4}, PickMode::add});
        set(MoveHandles{HandleKind::lattice, {1, 2, 3.5}, true});
        set(ResetHandles{HandleKind::lattice});
        set(SetLattice{LatticeChoice{{5, 4, 3}, {2, 3, 1}}});
        set(OpenDeformation{"d.json"});
        set(SaveDeformation{"e.json"});
        set(PickArea{View::quads, {{0, 0}, {10, 0}, {10, 10.25}}, size, PickMode::add, true});
        set(PickBrush{View::surface, pixel, 33, size, PickMode::remove, true});
        set(SelectVertices{{2, 5}, PickMode::add});
        set(PickVertex{View::blank, pixel, size, PickMode::remove, true, 20});
        set(MakeRegion{"clamp \"A\" äöü", RegionKind::binder});
        set(ChangeRegion{2, "pad", RegionKind::pad, {0.25f, 0.5f, 0.75f, 1}});
        set(SetLimits{{LimitsOptions::Source::points, "flc.csv", 0.2, 0.05, 0.3, 0.2, 0.01}});
        set(SetContact{1, ToolContact{.pressure_MPa = 3.5, .friction = 0.2}});
        set(SetOwnSheet{1, OwnSheet{"dp600", 1.25}});
        const ProcessLine bead{LineKind::drawbead, "b", {{1, 2, 3}, {4, 5, 6}}, 75, BeadShape{4, 2, 3, 0.1}};
        set(AddLine{bead});
        set(ChangeLine{3, {LineKind::pilot, "p", {{1, 2, 3}}, 10, {}}});
        set(SetProcess{0.25, Eigen::Vector3d(1, 2, 0)});
        set(AddProbe{{7, {0.5, 0.25, 0.25}}});
        set(DrawSection{View::blank, pixel, {30, 40}, size});
        set(SetDisplay{{Field::strain_major, true, std::array{-0.5, 0.5}, ColourMap::grey, 7, true, false, true}});
        set(LookFrom{View::quads, StandardView::left});
        set(LookFromSide{View::surface, {-1, 0, 1}});
        set(AddMeasurement{{MeasureKind::angle, {Probe{7, {0.5, 0.25, 0.25}}, Probe{8}, Probe{9, {0, 1, 0}}}}});
        set(RemoveMeasurement{3});
        set(AddMeasurement{{MeasureKind::distance, {Probe{7}, Probe{8}}, View::blank}});
        set(TakeOpened{true});
        set(OpenProject{"a.spia"});
        set(ExportFiles{
            "out", {"step", "dxf"}, {LengthUnit::inch, "door", {true, false, true, false, true}, {false, true}, {}}});
        set(WriteReport{
            "report.html",
            {"Door <1>", "two\nlines", {View::quads}, false, {true, false, true, false, true}, LengthUnit::inch}});
        set(Screenshot{"picture.png", View::blank, 800, 600, false, false, true});
        set(SaveAnimation{"way.gif", 12, 3, 320, 200, false, false});
        set(SetPreferences{
            {false, 125, LengthUnit::inch, "dp600", 0.8, ColourMap::grey, true, 0.05, MouseStyle::catia}});
        ViewSettings view;
        view.camera[1].turn = glm::dquat(0.5, 0.5, -0.5, 0.5);
        view.camera[3].target = {1, 2, 3};
        view.maximised = View::surface;
        view.tool = Tool::lasso;
        view.dark = false;
        view.mouse = MouseStyle::blender;
        view.measure = MeasureKind::circle;
        view.clip = {true, ClipAxis::view, 12.5, true, {0, 0.6, 0.8}};
        set(SetViewSettings{view});
    }
    return actions;
}

} // namespace

TEST(Script, EveryActionComesBackFromItsJson)
{
    std::set<std::string> names;
    for (const Action& action : every_action()) {
        const Json text = to_json(action);
        names.insert(text["do"]);
        const Action back = action_from_json(parse_json(text.dump(), "dump"));
        EXPECT_TRUE(back.same_kind(action)) << text;
        EXPECT_EQ(to_json(back), text);
    }
    EXPECT_EQ(names.size(), AllActions::count); // no name twice
}

TEST(Script, MembersCarryTheirValuesIntoTheAction)
{
    const auto corner = as<SetCorner>(action_from_json(json(R"({"do":"set_corner","corner":2,"vertex":99})")));
    EXPECT_EQ(corner.corner, 2);
    EXPECT_EQ(corner.vertex, 99);
    EXPECT_FALSE(corner.dragging);
    const auto area = as<PickArea>(action_from_json(
        json(R"({"do":"pick_area","view":"blank","polygon":[[0,0],[5,0],[5,6]],"size":[20,10],"mode":"add"})")));
    EXPECT_EQ(area.polygon[2], glm::dvec2(5, 6));
    EXPECT_EQ(area.view, View::blank);
    EXPECT_EQ(area.mode, PickMode::add);
    EXPECT_FALSE(as<SetDirection>(action_from_json(json(R"({"do":"set_direction","direction":null})"))).direction);
}

TEST(Script, OptionsOfFilesCarryTheirValuesAndKeepTheOthers)
{
    const auto exported = as<ExportFiles>(action_from_json(json(
        R"({"do":"export","folder":"o","formats":["glb"],"options":{"unit":"inch","name":"d","glb":{"blank":false},"csv":{"outline":false}}})")));
    EXPECT_EQ(exported.options,
              (OutputOptions{LengthUnit::inch, "d", {true, false, true, true, true}, {true, false}, {}}));
    const auto report = as<WriteReport>(action_from_json(json(
        R"({"do":"write_report","file":"r","options":{"title":"t","remarks":"m","pictures":["quads"],"standard_look":false,"tables":{"solver":false}}})")));
    EXPECT_EQ(report.options, (ViewerReportOptions{"t", "m", {View::quads}, false, {true, true, true, false, true}}));
    const auto picture = as<Screenshot>(
        action_from_json(json(R"({"do":"screenshot","file":"p","view":"part","labels":false,"transparent":true})")));
    EXPECT_TRUE(picture.legend && picture.transparent);
    EXPECT_FALSE(picture.labels);
}

TEST(Script, WhatIsNotGivenStaysAsItIs)
{
    ViewerState state;
    state.document.session.options.grid.rows = 21;
    state.document.display.bands = 9;
    state.view.dark = false;
    state.view.camera[0].height = 77;
    state.document.regions.push_back({"clamp", RegionKind::pad, {0.5f, 0.5f, 0.5f, 1}, {1, 2}});

    const auto grid = as<SetGrid>(action_from_json(json(R"({"do":"set_grid","columns":34})"), state)).grid;
    EXPECT_EQ(grid.columns, 34);
    EXPECT_EQ(grid.rows, 21);
    const auto display =
        as<SetDisplay>(action_from_json(json(R"({"do":"set_display","isolines":true})"), state)).display;
    EXPECT_TRUE(display.isolines);
    EXPECT_EQ(display.bands, 9);
    const auto view =
        as<SetViewSettings>(action_from_json(json(R"({"do":"set_view","camera":{"blank":{"height":5}}})"), state)).view;
    EXPECT_EQ(view.camera[1].height, 5);
    EXPECT_EQ(view.camera[0].height, 77);
    EXPECT_FALSE(view.dark);
    const auto region =
        as<ChangeRegion>(action_from_json(json(R"({"do":"change_region","region":0,"kind":"binder"})"), state));
    EXPECT_EQ(region.name, "clamp");
    EXPECT_EQ(region.kind, RegionKind::binder);
}

TEST(Script, AMistakeIsNamedWithItsPlaceAndWhatIsAllowed)
{
    const auto mistake = [](const std::string& step) {
        return message(
            [&] { parse_script(R"({"schema":"spia-script/1","actions":[{"do":"undo"},)" + step + "]}", "s.json"); });
    };
    EXPECT_EQ(mistake(R"({"do":"set_corner","corner":4,"vertex":1})"),
              "s.json: /actions/1/corner is 4 but must be from 0 to 3");
    EXPECT_EQ(mistake(R"({"do":"set_corner","corner":1})"), "s.json: /actions/1 needs the member \"vertex\"");
    EXPECT_EQ(mistake(R"({"do":"set_corner","corner":1.5,"vertex":1})"),
              "s.json: /actions/1/corner must be a whole number");
    EXPECT_EQ(mistake(R"({"do":"run_to","stage":"flat"})"),
              "s.json: /actions/1/stage is wrong: \"flat\" is none of read, solve, grid, lift, fit");
    EXPECT_EQ(mistake(R"({"do":"make_region","nam":"x"})"),
              "s.json: /actions/1 has no member \"nam\"; there are: name, kind");
    EXPECT_EQ(mistake(R"({"do":"select_faces","faces":[1,2,-3]})"),
              "s.json: /actions/1/faces/2 is -3 but must be from 0 to 2147483647");
    EXPECT_EQ(mistake(R"({"do":"select_faces","faces":[1,99999999999]})"),
              "s.json: /actions/1/faces/1 must be a whole number");
    EXPECT_EQ(mistake(R"({"do":"add_probe","face":1,"barycentric":[1,1,1]})"),
              "s.json: /actions/1/barycentric must be three weights from 0 to 1 whose sum is 1");
    EXPECT_EQ(mistake(R"({"do":"set_view","camera":{"top":{}}})"),
              "s.json: /actions/1/camera is wrong: \"top\" is none of part, blank, quads, surface");
    EXPECT_NE(mistake(R"({"do":"unfold"})").find("there are: wait, expect, list_file"), std::string::npos);
    EXPECT_NE(mistake(R"("undo")").find("/actions/1 must be an object"), std::string::npos);
    EXPECT_NE(mistake(R"({"do":"undo"} {)").find("line 1, column"), std::string::npos);
    EXPECT_NE(mistake(R"({"do":"set_thickness","thickness":1e999})").find("s.json: "), std::string::npos);
    EXPECT_NE(message([] { parse_script(R"({"schema":"spia-script/2","actions":[]})", "s.json"); }).find("version"),
              std::string::npos);
    EXPECT_NE(message([] { parse_script(std::filesystem::path("/nowhere/s.json")); }).find("/nowhere/s.json"),
              std::string::npos);
}

TEST(Script, ReadsStepsInOrderWithComments)
{
    const auto steps = parse_script(R"({"schema":"spia-script/1","actions":[
        {"do":"open_part","file":"a.obj"}, // the sample
        {"do":"wait","seconds":5},
        {"do":"expect","at":"/job/running","equals":false}]})",
                                    "s.json");
    ASSERT_EQ(steps.size(), 3u);
    ViewerState state;
    EXPECT_EQ(as<OpenPart>(action(std::get<Perform>(steps[0].what), state, steps[0].place)).file, "a.obj");
    EXPECT_EQ(std::get<Wait>(steps[1].what).seconds, 5);
    EXPECT_EQ(std::get<Expect>(steps[2].what).at, "/job/running");
    EXPECT_EQ(steps[2].place, "s.json: /actions/2");
}

TEST(Expectation, HoldsOrSaysWhatWasThere)
{
    const Json report = json(R"({"selection":{"faces":12,"first":[3,4]},"text":"not converged","none":null})");
    const auto check = [&](const std::string& expectation) {
        const auto steps = parse_script(script_of(fmt::format(R"({{"do":"expect",{}}})", expectation)), "s.json");
        return unmet(std::get<Expect>(steps[0].what), report).value_or("fine");
    };
    EXPECT_EQ(check(R"("at":"/selection/faces","equals":12)"), "fine");
    EXPECT_EQ(check(R"("at":"/selection/faces","equals":12.0)"), "fine");
    EXPECT_EQ(check(R"("at":"/selection/faces","equals":13)"), "/selection/faces is 12 but should equal 13");
    EXPECT_EQ(check(R"("at":"/selection/faces","above":11,"below":13)"), "fine");
    EXPECT_EQ(check(R"("at":"/selection/faces","above":12)"), "/selection/faces is 12 but should be above 12");
    EXPECT_EQ(check(R"("at":"/selection/faces","below":12)"), "/selection/faces is 12 but should be below 12");
    EXPECT_EQ(check(R"("at":"/selection/faces","near":12.4,"tolerance":0.5)"), "fine");
    EXPECT_EQ(check(R"("at":"/selection/faces","near":12.6,"tolerance":0.5)"),
              "/selection/faces is 12 but should be 12.6 give or take 0.5");
    EXPECT_EQ(check(R"("at":"/selection/first","contains":4)"), "fine");
    EXPECT_EQ(check(R"("at":"/selection/first","contains":5)"), "/selection/first is [3,4] but should contain 5");
    EXPECT_EQ(check(R"("at":"/selection","contains":"faces")"), "fine");
    EXPECT_EQ(check(R"("at":"/text","contains":"converged")"), "fine");
    EXPECT_EQ(check(R"("at":"/text","above":0)"), "/text is \"not converged\" but should be a number");
    EXPECT_EQ(check(R"("at":"/none","equals":null)"), "fine");
    EXPECT_EQ(check(R"("at":"/selection/last","exists":false)"), "fine");
    EXPECT_EQ(check(R"("at":"/text","exists":true)"), "fine");
    EXPECT_EQ(check(R"("at":"/text","exists":false)"), "/text is \"not converged\" but should not be there");
    EXPECT_EQ(check(R"("at":"/selection/last/0","equals":1)"),
              "there is nothing at /selection/last/0; at \"/selection\" there is: faces, first");
    EXPECT_EQ(check(R"("at":"/selection/first/7","equals":1)"),
              "there is nothing at /selection/first/7; at \"/selection/first\" there is: a list of 2");
    EXPECT_EQ(check(R"("at":"/selection/first/word","equals":1)"),
              "there is nothing at /selection/first/word; at \"/selection/first\" there is: a list of 2");
}

TEST(Expectation, MustExpectSomething)
{
    const auto mistake = [](const std::string& step) {
        return message([&] { parse_script(script_of(step), "s.json"); });
    };
    EXPECT_NE(mistake(R"({"do":"expect","at":"/a"})").find("expects nothing"), std::string::npos);
    EXPECT_NE(mistake(R"({"do":"expect","at":"a","equals":1})").find("JSON pointer"), std::string::npos);
    EXPECT_NE(mistake(R"({"do":"expect","at":"/a","near":1})").find("together"), std::string::npos);
}

} // namespace spia::viewer
