// The run of steps as a job: cancelled, and its progress.
#include <algorithm>
#include <gmock/gmock.h>

#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

using StepStatus::done;
using testing::HasSubstr;

} // namespace

TEST_F(UnfoldingSteps, WhatEndedBeforeARunIsCancelledIsKept)
{
    open_box();
    propose();
    const PartFile& part = *document.session.part;
    const auto shared = document.session.part;
    // Cancelled when the third step begins, whatever the speed of the machine.
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    const Progress progress([&](double, std::string_view step) { *stop = *stop || step == document.steps[2]->name; },
                            stop);
    const StepsOutcome outcome =
        run_steps(shared, document.steps, sheet_of_steps(document.session.options.flatten), {}, nullptr, 0, progress);
    EXPECT_TRUE(outcome.cancelled);
    ASSERT_EQ(outcome.run->run.states.size(), 2u);
    EXPECT_EQ(outcome.run->figure.size(), 2u);
    EXPECT_EQ(outcome.run->run.states[1].position.cols(), part.mesh.vertices());
    // And through the model: nothing is lost, and it goes on where it stopped.
    model.apply(RunSteps{});
    EXPECT_TRUE(state.job.running);
    EXPECT_EQ(state.job.title, "Unfolding step by step");
    model.apply(CancelJob{});
    wait();
    EXPECT_THAT(last(Severity::hint), HasSubstr("cancelled"));
    EXPECT_FALSE(state.job.running);
    run();
    EXPECT_EQ(status(), std::vector(5, done));
}

TEST_F(UnfoldingSteps, ProgressRisesFromNothingToTheEndOverTheStepsThatAreRun)
{
    open_box();
    propose();
    const auto fractions = [&](std::shared_ptr<const StepsRun> before, size_t keep) {
        std::vector<double> seen;
        const auto outcome =
            run_steps(document.session.part, document.steps, sheet_of_steps(document.session.options.flatten), {},
                      before, keep, Progress([&](double fraction, std::string_view) { seen.push_back(fraction); }));
        EXPECT_EQ(outcome.run->run.states.size(), 5u);
        EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
        EXPECT_NEAR(seen.front(), 0, 1e-12);
        EXPECT_GT(seen.back(), 1 - 1.01 / double(5 - keep)) << "within the last step";
        EXPECT_LE(seen.back(), 1 + 1e-12);
        return outcome.run;
    };
    fractions(fractions(nullptr, 0), 3);
}

} // namespace spia::viewer
