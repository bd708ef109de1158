// Steps that are run as they were proposed.
#include <gmock/gmock.h>
#include <stdexcept>

#include "app/viewer/model/reports/state_report.h"
#include "engine/unfold/automatic_unfolding.h"
#include "tests/support/shape_family.h"
#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

using testing::HasSubstr;

/// A part of which a proposed step does not converge, all at once does.
struct ProposalRun : UnfoldingSteps {
    void open_whiskers()
    {
        for (const shapes::FamilyShape& shape : shapes::shape_family(600, 1))
            if (shape.family == "whiskers" && shape.number == 2)
                return open_mesh(shape.make());
        throw std::runtime_error("there is no such shape");
    }
    FlattenOptions sheet() const { return sheet_of_steps(document.session.options.flatten); }
    /// As the command line does it.
    AutomaticUnfolding by_itself() const
    {
        const TriMesh& part = document.session.part->mesh;
        AutomaticUnfolding unfolded = automatic_unfolding(part, find_bends(part), {}, sheet());
        EXPECT_GT(unfolded.given_up, 0u) << "or this shows nothing";
        return unfolded;
    }
    static void expect_same(const StepList& steps, const UnfoldRun& run, const AutomaticUnfolding& wanted)
    {
        ASSERT_EQ(steps.size(), wanted.sequence.steps.size());
        ASSERT_EQ(run.states.size(), wanted.run.states.size());
        for (size_t k = 0; k < steps.size(); ++k) {
            EXPECT_EQ(steps[k]->name, wanted.sequence.steps[k].name);
            EXPECT_EQ(steps[k]->kind, wanted.sequence.steps[k].kind);
            EXPECT_EQ(steps[k]->pick.freed, wanted.sequence.steps[k].pick.freed);
            EXPECT_EQ(steps[k]->pick.fixed, wanted.sequence.steps[k].pick.fixed);
            EXPECT_EQ(run.states[k].position, wanted.run.states[k].position);
        }
        ASSERT_TRUE(run.blank);
        EXPECT_EQ(run.blank->position, wanted.run.blank->position);
    }
};

} // namespace

TEST_F(ProposalRun, IsPlannedAnewWhereAStepDoesNotWorkOutAsByTheCommandLine)
{
    open_whiskers();
    const AutomaticUnfolding wanted = by_itself();
    propose();
    const StepList first = document.steps;
    EXPECT_TRUE(still_proposed(document));
    run();
    expect_same(document.steps, document.unfolding->run, wanted);
    EXPECT_NE(document.steps, first);
    EXPECT_TRUE(all_steps_done(document));
    EXPECT_TRUE(still_proposed(document));
    const auto planned_anew = std::find_if(state.messages.begin(), state.messages.end(), [](const Message& message) {
        return message.text.find("replanned") != std::string::npos;
    });
    ASSERT_NE(planned_anew, state.messages.end());
    EXPECT_EQ(planned_anew->severity, Severity::hint);
    EXPECT_THAT(planned_anew->text, HasSubstr("did not converge"));
    const Json report = state_report(state)["unfolding"];
    EXPECT_EQ(report["given_up"].size(), wanted.given_up);
    EXPECT_EQ(report["still_proposed"], true);
    run();
    EXPECT_THAT(last(Severity::hint), HasSubstr("up to date"));
    model.apply(Undo{});
    EXPECT_EQ(document.steps, first);
    EXPECT_EQ(document.unfolding, nullptr);
    EXPECT_TRUE(still_proposed(document));
    model.apply(Redo{});
    EXPECT_TRUE(all_steps_done(document));
    model.apply(SetThickness{1.5}); // another sheet: from the first plan on, again
    run();
    const TriMesh& part = document.session.part->mesh;
    expect_same(document.steps, document.unfolding->run, automatic_unfolding(part, find_bends(part), {}, sheet()));
}

TEST_F(ProposalRun, StepsThatWereEditedAreNotReplaced)
{
    open_whiskers();
    propose();
    ChangeStep change = change_of(0);
    change.name = "mine";
    model.apply(change);
    EXPECT_FALSE(still_proposed(document));
    const StepList mine = document.steps;
    run();
    EXPECT_EQ(document.steps, mine);
    EXPECT_TRUE(document.unfolding->given_up.empty());
    EXPECT_EQ(status()[0], StepStatus::poor);
    model.apply(Undo{});
    model.apply(Undo{});
    EXPECT_TRUE(still_proposed(document));
    model.apply(RunSteps{}); // nor those that are edited while it runs
    model.apply(change);
    const StepList meanwhile = document.steps;
    wait();
    EXPECT_EQ(document.steps, meanwhile);
    EXPECT_EQ(names()[0], "mine");
}

TEST_F(ProposalRun, ThatIsCancelledGoesOnToTheSameResult)
{
    open_whiskers();
    const AutomaticUnfolding wanted = by_itself();
    propose();
    // Cancelled when the second plan begins its first step, whatever the speed of the machine.
    const std::string first_of_second = wanted.sequence.steps[0].name;
    ASSERT_NE(document.steps[0]->name, first_of_second);
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    const Progress progress([&](double, std::string_view step) { *stop = *stop || step == first_of_second; }, stop);
    const StepsOutcome cancelled = run_proposal(*document.proposal, document.bends, sheet(), {}, nullptr, progress);
    ASSERT_TRUE(cancelled.cancelled);
    EXPECT_LT(cancelled.run->run.states.size(), cancelled.run->steps.size()) << "it is not to pass for done";
    EXPECT_TRUE(cancelled.run->run.failure.empty());
    const StepsOutcome after =
        run_proposal({document.session.part, -1, cancelled.run->steps}, document.bends, sheet(), {}, cancelled.run, {});
    expect_same(after.run->steps, after.run->run, wanted);
}

TEST_F(ProposalRun, AProjectKeepsThatItIsAProposal)
{
    open_whiskers();
    const AutomaticUnfolding wanted = by_itself();
    propose();
    model.apply(SaveProject{folder / "proposed.spia"});
    model.apply(OpenProject{folder / "proposed.spia"});
    wait();
    ASSERT_TRUE(still_proposed(document));
    run();
    expect_same(document.steps, document.unfolding->run, wanted);
    model.apply(SaveProject{folder / "ran.spia"});
    model.apply(OpenProject{folder / "ran.spia"});
    wait();
    EXPECT_TRUE(all_steps_done(document)) << last(Severity::error);
    expect_same(document.steps, document.unfolding->run, wanted);
    ChangeStep change = change_of(0);
    change.name = "mine";
    model.apply(change);
    model.apply(SaveProject{folder / "mine.spia"});
    model.apply(OpenProject{folder / "mine.spia"});
    wait();
    EXPECT_FALSE(still_proposed(document));
}

} // namespace spia::viewer
