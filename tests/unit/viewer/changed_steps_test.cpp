// What holds of a run when its list is changed.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

using testing::HasSubstr;

using StepStatus::done;
using StepStatus::failed;
using StepStatus::missing;
using StepStatus::stale;

} // namespace

TEST_F(UnfoldingSteps, AChangeMakesItsStepAndThoseAfterItOutOfDateAndRedoKeepsTheStatesBefore)
{
    open_box();
    propose();
    run();
    ASSERT_EQ(status(), std::vector(5, done)) << last(Severity::error);
    const auto first_run = document.unfolding;
    ChangeStep change = change_of(2);
    change.tolerance = 1e-6;
    model.apply(change);
    EXPECT_EQ(status(), (std::vector{done, done, stale, stale, stale}));
    EXPECT_EQ(step_position(state), 2) << "no further than there are states that hold";
    model.apply(Undo{});
    EXPECT_EQ(status(), std::vector(5, done));
    model.apply(Redo{});
    run();
    ASSERT_EQ(status(), std::vector(5, done)) << last(Severity::error);
    for (size_t k : {0u, 1u})
        EXPECT_EQ(after(k).seconds, first_run->run.states[k].seconds) << "not solved again";
    EXPECT_NE(after(2).seconds, first_run->run.states[2].seconds);
    change = change_of(1);
    change.name = "the second lip";
    model.apply(change);
    EXPECT_EQ(names()[1], "the second lip");
    EXPECT_EQ(status(), std::vector(5, done)) << "a name changes no result";
    model.apply(SetThickness{1.5});
    EXPECT_EQ(status(), std::vector(5, stale));
    model.apply(Undo{});
    model.apply(MoveStep{4, 3});
    EXPECT_EQ(status(), (std::vector{done, done, done, stale, stale}));
    model.apply(Undo{});
    const auto second_run = document.unfolding;
    model.apply(RemoveStep{4});
    EXPECT_EQ(status(), std::vector(4, done));
    EXPECT_FALSE(all_steps_done(document)) << "the blank is that of five";
    run();
    EXPECT_THAT(last(Severity::warning), HasSubstr("is not flat"));
    EXPECT_EQ(after(3).seconds, second_run->run.states[3].seconds);
}

TEST_F(UnfoldingSteps, MovingAStepKeepsTheListOtherwise)
{
    open_box();
    propose();
    const auto before = names();
    model.apply(ShowStep{1, {}});
    model.apply(MoveStep{1, 3});
    EXPECT_EQ(names(), (std::vector{before[0], before[2], before[3], before[1], before[4]}));
    EXPECT_EQ(state.view.step, 3) << "it stays chosen";
    model.apply(MoveStep{3, 0});
    EXPECT_EQ(names(), (std::vector{before[1], before[0], before[2], before[3], before[4]}));
    model.apply(RemoveStep{0});
    EXPECT_EQ(names(), (std::vector{before[0], before[2], before[3], before[4]}));
    EXPECT_EQ(state.history.undo_name(), "Remove step");
}

TEST_F(UnfoldingSteps, AStepWithoutAResultSaysSoAndKeepsTheStatesBeforeIt)
{
    open_box();
    propose();
    ChangeStep change = change_of(1);
    change.offset_mm = 7; // beside the edge that its faces hang on
    model.apply(change);
    run();
    EXPECT_EQ(status(), (std::vector{done, failed, missing, missing, missing}));
    EXPECT_THAT(last(Severity::error), HasSubstr(fmt::format("Step 2 \"{}\" has no result", document.steps[1]->name)));
    EXPECT_THAT(last(Severity::error), HasSubstr("7 mm off the target"));
    EXPECT_THAT(last(Severity::error), HasSubstr("The states up to step 1 are kept"));
    EXPECT_THAT(last(Severity::error), HasSubstr("remove its offset")) << "what can be done here";
    EXPECT_EQ(step_position(state), 1);
    EXPECT_EQ(state.view.step, 1) << "to be changed";
    change.offset_mm = 0;
    model.apply(change);
    EXPECT_EQ(status()[1], missing);
    run();
    EXPECT_EQ(status(), std::vector(5, done));
}

TEST_F(UnfoldingSteps, WhatCannotBeDoneIsRefusedWithAWayOut)
{
    model.apply(ProposeSteps{});
    EXPECT_THAT(last(Severity::error), HasSubstr("Open a part first"));
    open_channel();
    run();
    EXPECT_THAT(last(Severity::error), HasSubstr("propose some, or add one"));
    model.apply(RemoveStep{0});
    EXPECT_THAT(last(Severity::error), HasSubstr("propose some, or add one"));
    propose(99'999);
    EXPECT_THAT(last(Severity::error), HasSubstr("no face 99999"));
    propose();
    const auto before = names();
    model.apply(MoveStep{0, 7});
    EXPECT_THAT(last(Severity::error), HasSubstr("There is no step 8"));
    ChangeStep change = change_of(0);
    change.tolerance = 2;
    model.apply(change);
    EXPECT_THAT(last(Severity::error), HasSubstr("tolerance of a step"));
    change = change_of(0);
    change.name = "";
    model.apply(change);
    EXPECT_THAT(last(Severity::error), HasSubstr("needs a name"));
    model.apply(ShowStep{{}, 77.});
    EXPECT_THAT(last(Severity::error), HasSubstr("The slider goes from 0"));
    model.apply(ShowStep{{}, 1.});
    EXPECT_THAT(last(Severity::hint), HasSubstr("have to be run first"));
    EXPECT_EQ(step_position(state), 0);
    EXPECT_EQ(names(), before);
    EXPECT_EQ(state.history.undo_name(), "Propose steps");
    model.apply(RunSteps{});
    model.apply(RunTo{Stage::solve});
    EXPECT_THAT(last(Severity::error), HasSubstr("Wait for the steps"));
    model.apply(Undo{});
    EXPECT_THAT(last(Severity::error), HasSubstr("Cancel the running job first"));
    model.apply(RunSteps{});
    EXPECT_THAT(last(Severity::error), HasSubstr("Wait for the running job"));
    const auto in_the_way = [&] { // what is shown of the running job
        return std::ranges::count_if(state.messages, [](const Message& message) {
            return message.shown() && message.subject.kind == Subject::Kind::busy;
        });
    };
    EXPECT_EQ(in_the_way(), 3);
    wait();
    EXPECT_TRUE(all_steps_done(document));
    EXPECT_EQ(in_the_way(), 0);
}

} // namespace spia::viewer
