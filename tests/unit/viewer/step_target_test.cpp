// Targets of one's own for steps.
#include "app/viewer/model/document/step_target.h"

#include <cmath>
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "app/viewer/model/actions/script.h"
#include "app/viewer/model/document/stored_picks.h"
#include "app/viewer/model/reports/state_report.h"
#include "engine/mesh/region.h"
#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

using testing::HasSubstr;
using Target = UnfoldingSteps;

/// The plane of the upright middle of the channel.
Eigen::Vector2d web_of(const Document& document) { return {document.session.part->mesh.position.row(0).maxCoeff(), 0}; }

FaceSet web_faces(const Document& document)
{
    const TriMesh& part = document.session.part->mesh;
    const double right = web_of(document)[0];
    FaceSet web;
    for (int f = 0; f < part.triangles(); ++f)
        if (part.position(0, part.triangle.col(f)).minCoeff() > right - 1e-4)
            web.push_back(f);
    return web;
}

} // namespace

TEST(PlaneThrough, IsThatOfLeastSquaresHoweverTheFacesAreSplit)
{
    // A coarse and a fine half of one slightly bent sheet: the plane must not lean to the fine one.
    const auto sheet = [](int coarse, int fine) {
        const std::vector<shapes::Patch> halves{{{Eigen::Vector3d(-1, 0, 0.1), Eigen::Vector3d(0, 0, 0),
                                                  Eigen::Vector3d(0, 2, 0), Eigen::Vector3d(-1, 2, 0.1)},
                                                 coarse,
                                                 coarse},
                                                {{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0.1),
                                                  Eigen::Vector3d(1, 2, 0.1), Eigen::Vector3d(0, 2, 0)},
                                                 fine,
                                                 fine}};
        return shapes::patchwork(halves);
    };
    const TriMesh mesh = sheet(2, 2), uneven = sheet(2, 32);
    const auto all = [](const TriMesh& m) { return inverted({}, m.triangles()); };
    for (const TriMesh& each : {mesh, uneven}) {
        const PlaneThrough through = plane_through(each, all(each));
        EXPECT_NEAR(through.plane.normal[2], 1, 1e-12);
        EXPECT_NEAR(through.plane.origin[2], 0.05, 1e-12);
        EXPECT_NEAR(through.distance_mm, 0.05, 1e-12);
    }
}

TEST_F(Target, RubsAgainstWhatIsLaidOnIt)
{
    open_mesh(shapes::round_cup({.triangles = 1500}));
    propose();
    ASSERT_EQ(document.steps.at(0)->kind, UnfoldKind::lay);
    run();
    ASSERT_EQ(status().at(0), StepStatus::done) << last(Severity::error);
    const Eigen::Matrix3Xd free = after(0).position;
    model.apply(action_from_json(
        parse_json(R"({"do": "change_step", "step": 0, "friction": {"pressure_MPa": 20, "sides": 1}})", "test"),
        state));
    ASSERT_TRUE(document.steps[0]->pick.friction);
    EXPECT_EQ(*document.steps[0]->pick.friction, (ContactRegion{"the target", {}, 20., {}, 0.12, 1}));
    EXPECT_EQ(status()[0], StepStatus::stale);
    run();
    ASSERT_EQ(status()[0], StepStatus::done) << last(Severity::error);
    EXPECT_GT((after(0).position - free).colwise().norm().maxCoeff(), 1e-3) << "it holds the sheet back";
    // A project keeps it, also on which faces it rubs.
    auto some = std::make_shared<PlannedStep>(*document.steps[0]);
    some->pick.friction->faces = {some->pick.freed[3], some->pick.freed[7]};
    StepList list = document.steps;
    list[0] = some;
    Document with = document;
    with.steps = list;
    StoredPicks stored = store_picks(with);
    ASSERT_TRUE(restore_picks(with, stored).empty());
    EXPECT_EQ(with.steps[0]->pick.friction, some->pick.friction);
    ChangeStep change = change_of(0);
    change.friction = StepFriction{};
    model.apply(change);
    EXPECT_THAT(last(Severity::error), HasSubstr("force or pressure on the target of a step must be above 0"));
    change.friction.reset();
    model.apply(change);
    EXPECT_FALSE(document.steps[0]->pick.friction);
    model.apply(Undo{});
    EXPECT_TRUE(document.steps[0]->pick.friction);
}

TEST_F(Target, WhatTheSheetDoesNotBearIsTold)
{
    open_mesh(shapes::round_cup({.triangles = 1500}));
    propose();
    ChangeStep change = change_of(0);
    change.friction = StepFriction{.pressure_MPa = 50000, .friction = 5};
    model.apply(change);
    run();
    ASSERT_FALSE(document.unfolding->run.states.empty()) << last(Severity::error);
    ASSERT_LT(after(0).friction_share, 1) << "or this shows nothing";
    EXPECT_TRUE(says(Severity::warning, "% of its friction")) << last(Severity::warning);
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    const int necking = document.unfolding->run.states.back().necking;
    ASSERT_GT(necking, 1) << "likewise";
    EXPECT_TRUE(says(Severity::warning, fmt::format("{} triangles are strained beyond", necking)));
}

TEST(StepFriction, GoesToTheEngineAndBack)
{
    for (const StepFriction& each : {StepFriction{.force_N = 1500, .friction = 0.08, .sides = 1},
                                     StepFriction{.pressure_MPa = 3, .friction = 0.2}}) {
        const ContactRegion rubs = friction_of(each, {4, 7});
        EXPECT_EQ(rubs.faces, (std::vector{4, 7}));
        EXPECT_EQ(rubs.force_N, each.force_N);
        EXPECT_EQ(rubs.pressure_MPa, each.pressure_MPa);
        EXPECT_EQ(rubs.friction, each.friction);
        EXPECT_EQ(rubs.sides, each.sides);
        EXPECT_EQ(numbers_of(rubs), each);
    }
    EXPECT_EQ(numbers_of(std::optional<ContactRegion>()), std::nullopt);
    for (const StepFriction& bad :
         {StepFriction{}, StepFriction{.force_N = 1, .pressure_MPa = 1}, StepFriction{.force_N = 0},
          StepFriction{.pressure_MPa = 1, .friction = -0.1}, StepFriction{.pressure_MPa = 1, .sides = 3},
          StepFriction{.pressure_MPa = 1, .sides = 0}})
        EXPECT_THROW(friction_of(bad, {}), InputError);
}

TEST_F(Target, AProjectKeepsItsFriction)
{
    open_box();
    propose();
    const StepFriction by_force{.force_N = 1500, .friction = 0.08, .sides = 1}, by_pressure{.pressure_MPa = 3};
    ChangeStep change = change_of(0);
    change.friction = by_force;
    model.apply(change);
    change = change_of(1);
    change.friction = by_pressure;
    model.apply(change);
    EXPECT_EQ(to_json(action_from_json(to_json(Action(change)), state)), to_json(Action(change)));
    model.apply(SaveProject{folder / "rubs.spia"});
    model.apply(OpenProject{folder / "rubs.spia"});
    wait();
    ASSERT_EQ(document.steps.size(), 5u) << last(Severity::error);
    EXPECT_EQ(numbers_of(document.steps[0]->pick.friction), by_force);
    EXPECT_EQ(numbers_of(document.steps[1]->pick.friction), by_pressure);
    EXPECT_FALSE(document.steps[2]->pick.friction);
    ASSERT_TRUE(document.steps[0]->pick.friction);
    EXPECT_TRUE(document.steps[0]->pick.friction->faces.empty()) << "on all that it moves";
}

TEST_F(Target, OfEveryKindIsKeptByProjectsAndTakenBack)
{
    open_box();
    propose();
    const std::vector<StepTarget> targets{{},
                                          {.plane = TargetPlane{{1, 2, 3}, {0, 0.6, 0.8}}},
                                          {.cylinder = TargetCylinder{{0, 5, 300}, {0, 1, 0}, 250}},
                                          {.cone = TargetCone{{0, 0, 400}, {0, 0, -1}, 12}}};
    // but for rounding: degrees, unit vectors
    const auto same = [](const StepTarget& a, const StepTarget& b) {
        if (a.plane && b.plane)
            return a.plane->origin.isApprox(b.plane->origin) && a.plane->normal.isApprox(b.plane->normal);
        if (a.cylinder && b.cylinder)
            return a.cylinder->origin.isApprox(b.cylinder->origin) && a.cylinder->axis.isApprox(b.cylinder->axis) &&
                   a.cylinder->radius == b.cylinder->radius;
        if (a.cone && b.cone)
            return a.cone->apex.isApprox(b.cone->apex) && a.cone->axis.isApprox(b.cone->axis) &&
                   std::abs(a.cone->half_angle_deg - b.cone->half_angle_deg) < 1e-9;
        return a.fitted() && b.fitted();
    };
    const auto is = [&](size_t k) { return same(numbers_of(*document.steps[0]), targets[k]); };
    for (size_t k = 1; k < targets.size(); ++k) {
        model.apply(SelectFaces{{int(k)}}); // else the change before and this one are one
        ChangeStep change = change_of(0);
        change.target = targets[k];
        model.apply(change);
        EXPECT_TRUE(is(k)) << k << last(Severity::error);
        const auto face = document.steps[0]->pick.target;
        model.apply(SaveProject{folder / "target.spia"});
        model.apply(Undo{});
        EXPECT_TRUE(is(0)) << k;
        model.apply(OpenProject{folder / "target.spia"});
        wait();
        ASSERT_EQ(document.steps.size(), 5u) << last(Severity::error);
        EXPECT_TRUE(is(k)) << k;
        EXPECT_EQ(document.steps[0]->pick.target->index(), face->index());
        change = change_of(0);
        change.target = StepTarget{};
        model.apply(change);
        EXPECT_TRUE(is(0)) << k;
    }
}

TEST_F(Target, NumbersThatAreTheFittedPlaneGiveTheSameBlank)
{
    open_channel();
    model.apply(SelectFaces{web_faces(document)});
    model.apply(MakeRegion{"web", RegionKind::fixed});
    model.apply(InvertSelection{});
    model.apply(AddStep{0, {}, "fitted", {}});
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    const Eigen::Matrix3Xd fitted = after(0).position;
    const double right = web_of(document)[0];
    model.apply(RemoveStep{0});
    model.apply(AddStep{0, {}, "own", {.plane = TargetPlane{{right, 7, -30}, {2, 0, 0}}}});
    ASSERT_EQ(document.steps.size(), 1u) << last(Severity::error);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    EXPECT_LT((after(0).position - fitted).cwiseAbs().maxCoeff(), 1e-6);
    ASSERT_TRUE(document.unfolding->figure[0].hinge);
    EXPECT_LT(document.unfolding->figure[0].hinge->distance_mm, 1e-6);
    EXPECT_LT(document.unfolding->figure[0].hinge->angle_deg, 1e-3);
    EXPECT_FALSE(document.unfolding->figure[0].hinge->bad);
}

TEST_F(Target, APlaneThatTurnsFromTheFixedFacesIsToldAsBad)
{
    open_channel();
    model.apply(SelectFaces{web_faces(document)});
    model.apply(MakeRegion{"web", RegionKind::fixed});
    const double right = web_of(document)[0], top = document.session.part->mesh.position.row(2).maxCoeff() - 5;
    FaceSet upper;
    const TriMesh& part = document.session.part->mesh;
    for (int f = 0; f < part.triangles(); ++f)
        if (part.position(2, part.triangle.col(f)).minCoeff() > top - 1e-4)
            upper.push_back(f);
    model.apply(SelectFaces{upper});
    const double lean = 20. / 180 * std::numbers::pi; // through the edge of the web, but not on
                                                      // from it
    model.apply(AddStep{0, {}, "", {.plane = TargetPlane{{right, 0, top}, {std::cos(lean), 0, std::sin(lean)}}}});
    run();
    ASSERT_EQ(status(), std::vector{StepStatus::done}) << last(Severity::error);
    const auto hinge = document.unfolding->figure[0].hinge;
    ASSERT_TRUE(hinge);
    EXPECT_NEAR(hinge->angle_deg, 20, 1e-3);
    EXPECT_TRUE(hinge->bad);
    EXPECT_EQ(state_report(state)["unfolding"]["steps"][0]["hinge"]["bad"], true);
}

TEST_F(Target, ThePlaneOfPickedFacesIsThatWhereTheyLieBeforeTheStep)
{
    open_box();
    propose();
    // Lips go onto the walls first: the plane of a lip is known before, and then only after a run.
    const std::vector<int> lip = document.steps[0]->pick.freed;
    model.apply(SelectFaces{lip});
    model.apply(SetTargetPlane{4, {}});
    EXPECT_THAT(last(Severity::error), HasSubstr("Step 1 moves some of these faces"));
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    model.apply(SetTargetPlane{4, {}});
    EXPECT_EQ(state.history.undo_name(), "Set target plane") << last(Severity::error);
    const StepTarget target = numbers_of(*document.steps[4]);
    ASSERT_TRUE(target.plane);
    const Eigen::Matrix3Xd& before = after(3).position;
    for (const int f : lip)
        for (const int v : document.session.part->mesh.triangle.col(f))
            EXPECT_LT(std::abs(target.plane->normal.dot(before.col(v) - target.plane->origin)), 1e-6);
    EXPECT_EQ(steps_done(document), 4u) << "another target is another step";
    model.apply(Undo{});
    EXPECT_EQ(steps_done(document), 5u);
}

TEST_F(Target, MayEndAndWhatFindsNoRoomIsTold)
{
    open_channel();
    propose();
    ChangeStep change = change_of(0);
    change.extent_mm = 4;
    model.apply(change);
    ASSERT_EQ(document.steps[0]->extent_mm, 4) << last(Severity::error);
    run();
    ASSERT_GE(steps_done(document), 1u) << last(Severity::error);
    EXPECT_THAT(last(Severity::warning), HasSubstr("reach beyond the end of the target, up to"));
    EXPECT_GT(after(0).reach.without_room, 0);
    EXPECT_GT(state_report(state)["unfolding"]["steps"][0]["reach_mm"], 20);
    model.apply(SaveProject{folder / "ended.spia"});
    model.apply(OpenProject{folder / "ended.spia"});
    wait();
    EXPECT_EQ(document.steps[0]->extent_mm, 4);
    change.extent_mm = 1000;
    model.apply(change);
    EXPECT_EQ(steps_done(document), 0u) << "it is another step";
    run();
    EXPECT_EQ(after(0).reach.without_room, 0);
    change.extent_mm = -1;
    model.apply(change);
    EXPECT_THAT(last(Severity::error), HasSubstr("length above 0"));
    model.apply(Undo{});
    model.apply(Undo{});
    EXPECT_EQ(document.steps[0]->extent_mm, 4);
}

TEST_F(Target, AStepMayBeAddedOntoThePlaneOfARegion)
{
    open_channel();
    const FaceSet web = web_faces(document);
    const double right = web_of(document)[0], top = document.session.part->mesh.position.row(2).maxCoeff();
    model.apply(SelectFaces{web});
    model.apply(MakeRegion{"web", RegionKind::fixed});
    model.apply(SelectFaces{with_height(top - 1e-6, top)});
    model.apply(MakeRegion{"leg", RegionKind::other});
    model.apply(AddStep{0, 1, "", {.plane = TargetPlane{}}, 1});
    EXPECT_THAT(last(Severity::error), testing::HasSubstr("one target"));
    model.apply(AddStep{0, 1, "", {}, 1});
    ASSERT_EQ(document.steps.size(), 1u) << last(Severity::error);
    const StepTarget of_leg = numbers_of(*document.steps[0]);
    ASSERT_TRUE(of_leg.plane);
    EXPECT_NEAR(std::abs(of_leg.plane->normal[2]), 1, 1e-6);
    EXPECT_NEAR(of_leg.plane->origin[2], top, 1e-6);
    model.apply(AddStep{0, 1, "", {}, 0});
    EXPECT_NEAR(numbers_of(*document.steps[1]).plane->origin[0], right, 1e-4);
    model.apply(AddStep{0, 1, "", {}, 7});
    EXPECT_THAT(last(Severity::error), HasSubstr("no region 8"));
    EXPECT_EQ(document.steps.size(), 2u);
}

TEST_F(Target, TheFacesThatCarryItAreThosePicked)
{
    open_box();
    propose();
    const PlannedStep& last_step = *document.steps[4];
    model.apply(SelectFaces{last_step.pick.freed});
    model.apply(SetCarrying{4, {}});
    EXPECT_THAT(last(Severity::error), HasSubstr("cannot define its target"));
    const std::vector<int> some(last_step.pick.fixed.begin(), last_step.pick.fixed.begin() + 20);
    model.apply(SelectFaces{some});
    model.apply(SetCarrying{4, {}});
    EXPECT_EQ(document.steps[4]->pick.carrying, some) << last(Severity::error);
    EXPECT_EQ(document.steps[4]->pick.fixed.size(), last_step.pick.fixed.size());
    run();
    EXPECT_TRUE(all_steps_done(document)) << last(Severity::error);
    model.apply(ClearSelection{});
    model.apply(SetCarrying{4, {}});
    EXPECT_THAT(last(Severity::error), HasSubstr("Select the faces"));
}

TEST_F(Target, ProjectsAndScriptsKeepIt)
{
    open_channel();
    model.apply(SelectFaces{web_faces(document)});
    model.apply(MakeRegion{"web", RegionKind::fixed});
    model.apply(InvertSelection{});
    const double right = web_of(document)[0];
    model.apply(action_from_json(
        parse_json(
            fmt::format(
                R"({{"do": "add_step", "fixed": 0, "target": {{"plane": {{"origin": [{}, 0, 0], "normal": [1, 0, 0]}}}}}})",
                right),
            "test"),
        state));
    ASSERT_EQ(document.steps.size(), 1u) << last(Severity::error);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    const Eigen::Matrix3Xd flat = after(0).position;
    model.apply(SaveProject{folder / "own.spia"});
    model.apply(OpenProject{folder / "own.spia"});
    wait();
    ASSERT_TRUE(numbers_of(*document.steps[0]).plane);
    EXPECT_NEAR(numbers_of(*document.steps[0]).plane->origin[0], right, 1e-9);
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    EXPECT_LT((after(0).position - flat).cwiseAbs().maxCoeff(), 1e-9);
    const auto perform = [&](const char* text) {
        model.apply(action_from_json(parse_json(text, "test"), state));
        wait();
    };
    const auto before = document.steps[0]->pick.target;
    perform(R"({"do": "change_step", "step": 0, "name": "named"})");
    EXPECT_TRUE(document.steps[0]->pick.target == before) << "what is not given stays";
    EXPECT_EQ(steps_done(document), 1u);
    perform(
        R"({"do": "change_step", "step": 0, "target": {"cylinder": {"origin": [0, 0, 0], "axis": [0, 2, 0], "radius": 40}}})");
    ASSERT_TRUE(numbers_of(*document.steps[0]).cylinder);
    EXPECT_EQ(numbers_of(*document.steps[0]).cylinder->radius, 40);
    EXPECT_EQ(steps_done(document), 0u);
    perform(R"({"do": "change_step", "step": 0, "target": {}})");
    EXPECT_TRUE(numbers_of(*document.steps[0]).fitted());
    EXPECT_THROW(
        action_from_json(
            parse_json(
                R"({"do": "change_step", "step": 0, "target": {"plane": {"origin": [0, 0, 0], "normal": [0, 0, 0]}}})",
                "test"),
            state),
        InputError);
    for (const Action& action :
         {Action(ChangeStep{1, "b", 0, 0, {}, {}, StepTarget{.cone = TargetCone{{1, 2, 3}, {0, 1, 0}, 12}}}),
          Action(AddStep{1, 2, "c", {.plane = TargetPlane{{1, 2, 3}, {0, 1, 0}}}}), Action(SetTargetPlane{2, 1}),
          Action(SetCarrying{3, {}}), Action(OpenSteps{"a.json"}), Action(SaveSteps{"b.json"})})
        EXPECT_EQ(to_json(action_from_json(to_json(action), state)), to_json(action)) << to_json(action);
}

} // namespace spia::viewer
