// Steps in projects.
#include <gtest/gtest.h>

#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

constexpr auto done = StepStatus::done;

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
    EXPECT_FALSE(state.unsaved);
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

} // namespace spia::viewer
