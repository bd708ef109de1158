// Steps in projects.
#include <gmock/gmock.h>

#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

using StepStatus::done;
using testing::HasSubstr;

/// The faces with their middle below, or else above, a place along y.
FaceSet below(const TriMesh& mesh, double y, bool wanted = true)
{
    FaceSet faces;
    for (int f = 0; f < mesh.triangles(); ++f)
        if ((mesh.position(Eigen::all, mesh.triangle.col(f)).row(1).mean() < y) == wanted)
            faces.push_back(f);
    return faces;
}

FaceSet both(const FaceSet& a, const FaceSet& b)
{
    FaceSet result;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

} // namespace

TEST_F(UnfoldingSteps, AProjectKeepsTheListAndRunsItAgain)
{
    open_box();
    propose();
    ChangeStep change = change_of(1);
    change.name = "mine";
    change.tolerance = 1e-7;
    change.within_mm = 0.02;
    model.apply(change);
    run();
    ASSERT_EQ(status(), std::vector(5, done)) << last(Severity::error);
    const auto before = document.steps;
    const Eigen::Matrix3Xd third = after(2).position;
    model.apply(ShowStep{2, 2.5});
    model.apply(SaveProject{folder / "box.spia"});
    model.apply(OpenPart{assets / "parts" / "dome.obj", ""});
    wait();
    EXPECT_TRUE(document.steps.empty());
    EXPECT_EQ(state.view.step, std::nullopt);
    model.apply(OpenProject{folder / "box.spia"});
    wait();
    ASSERT_EQ(document.steps.size(), 5u) << last(Severity::error);
    for (size_t k = 0; k < 5; ++k) {
        const PlannedStep &was = *before[k], &is = *document.steps[k];
        EXPECT_EQ(is.kind, was.kind);
        EXPECT_EQ(is.name, was.name);
        EXPECT_EQ(is.pick.fixed, was.pick.fixed);
        EXPECT_EQ(is.pick.freed, was.pick.freed);
        EXPECT_EQ(is.pick.carrying, was.pick.carrying);
        EXPECT_EQ(is.tolerance, was.tolerance);
        EXPECT_EQ(is.within_mm, was.within_mm);
    }
    ASSERT_EQ(status(), std::vector(5, done));
    EXPECT_EQ(after(2).position, third);
    EXPECT_EQ(state.view.step, 2);
    EXPECT_EQ(step_position(state), 2.5);
    EXPECT_FALSE(state.document.unsaved);
}

TEST_F(UnfoldingSteps, OnAPartMeshedAnewTheStepsOfAProjectAreFoundAgainAndUnfoldIt)
{
    open_box();
    propose();
    model.apply(SaveProject{folder / "box.spia"});
    shapes::write_mesh(folder / "part.obj", shapes::lipped_box({.edge = 3.3}));
    model.apply(OpenProject{folder / "box.spia"});
    wait();
    ASSERT_EQ(document.steps.size(), 5u) << last(Severity::error) << last(Severity::warning);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    EXPECT_TRUE(document.unfolding->run.blank);
    EXPECT_EQ(document.unfolding->run.flipped, 0);
}

TEST_F(UnfoldingSteps, WhatRubsAndWhatCarriesMustBePickedAnewWhereAChangedPartHasNoneOfIt)
{
    open_channel();
    propose();
    ASSERT_EQ(document.steps[0]->kind, UnfoldKind::lay);
    const TriMesh part = document.session.part->mesh;
    const double end = part.position.row(1).minCoeff();
    model.apply(SelectFaces{both(below(part, end + 20), document.steps[0]->pick.fixed)});
    model.apply(SetCarrying{0, {}});
    ChangeStep change = change_of(0);
    change.friction = StepFriction{.pressure_MPa = 2};
    model.apply(change);
    const FaceSet rubs = both(below(part, end + 20), document.steps[0]->pick.freed);
    Document picked = document;
    auto some = std::make_shared<PlannedStep>(*document.steps[0]);
    some->pick.friction->faces = rubs;
    picked.steps[0] = some;
    const StoredPicks stored = store_picks(picked);
    const auto step_on = [&](const TriMesh& changed) {
        open_mesh(changed);
        Document restored = document;
        const auto missing = restore_picks(restored, stored);
        return std::pair(restored.steps.at(0), missing);
    };
    // All is there: nothing is said, and it rubs where it did.
    EXPECT_EQ(step_on(part).first->pick.friction->faces, rubs);
    EXPECT_TRUE(step_on(part).second.empty());
    // Cut off by half.
    const FaceSet rest = below(part, end + 40, false);
    const auto [step, missing] = step_on({part.position, part.triangle(Eigen::all, rest)});
    const std::string said = testing::PrintToString(missing);
    EXPECT_FALSE(step->pick.friction) << "not on all that moves";
    EXPECT_THAT(said, HasSubstr("its friction was removed"));
    EXPECT_TRUE(needs_pick(*step));
    EXPECT_TRUE(carrying_faces(*step).empty()) << "not all that stays";
    EXPECT_THAT(said, HasSubstr("pick others before running it"));
    // A target of one's own needs none.
    StoredPicks own = stored;
    own.steps.step[0].target = {.plane = TargetPlane{{0, 0, 0}, {1, 0, 0}}};
    Document restored = document;
    EXPECT_THAT(testing::PrintToString(restore_picks(restored, own)), testing::Not(HasSubstr("pick others")));
    EXPECT_FALSE(needs_pick(*restored.steps.at(0)));
}

TEST_F(UnfoldingSteps, AStepThatNeedsAPickHasNoResultUntilItHasOne)
{
    open_channel();
    propose();
    const TriMesh part = document.session.part->mesh;
    const double end = part.position.row(1).minCoeff();
    const FaceSet carrying = document.steps[0]->pick.fixed;
    model.apply(SelectFaces{both(below(part, end + 20), carrying)});
    model.apply(SetCarrying{0, {}});
    model.apply(SaveProject{folder / "cut.spia"});
    shapes::write_mesh(folder / "part.obj", {part.position, part.triangle(Eigen::all, below(part, end + 40, false))});
    model.apply(OpenProject{folder / "cut.spia"});
    wait();
    ASSERT_FALSE(document.steps.empty()) << last(Severity::error);
    EXPECT_EQ(status()[0], StepStatus::needs_pick);
    // It stays so in a project, and cannot go where it would mean all that stays.
    model.apply(SaveProject{folder / "again.spia"});
    model.apply(OpenProject{folder / "again.spia"});
    wait();
    EXPECT_EQ(status()[0], StepStatus::needs_pick);
    model.apply(SaveSteps{folder / "steps.json"});
    wait();
    EXPECT_THAT(last(Severity::error), HasSubstr("needs fixed faces for its target"));
    EXPECT_FALSE(std::filesystem::exists(folder / "steps.json"));
    run();
    EXPECT_THAT(last(Severity::error), HasSubstr("press \"Fit to selection\""));
    EXPECT_EQ(steps_done(document), 0u);
    model.apply(SelectFaces{document.steps[0]->pick.fixed});
    model.apply(SetCarrying{0, {}});
    EXPECT_EQ(status()[0], StepStatus::missing) << last(Severity::error);
    run();
    EXPECT_TRUE(all_steps_done(document)) << last(Severity::error);
    model.apply(Undo{});
    model.apply(Undo{});
    EXPECT_EQ(status()[0], StepStatus::needs_pick);
}

} // namespace spia::viewer
