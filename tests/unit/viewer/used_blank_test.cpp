// The chain from the blank of the steps, and back to that of one step.
#include <algorithm>
#include <gmock/gmock.h>

#include "app/viewer/model/actions/script.h"
#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/reports/state_report.h"
#include "engine/report/html/html_report.h"
#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct UsedBlank : UnfoldingSteps {
    void use(bool polish = false)
    {
        model.apply(UseBlankOfSteps{polish});
        wait();
    }
    void run_to(Stage stage)
    {
        model.apply(RunTo{stage});
        wait();
    }
    void unfold_box()
    {
        open_box();
        propose();
        run();
        ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    }
    std::string source() const { return state_report(state)["figures"]["source"]["from"]; }
};

} // namespace

TEST_F(UsedBlank, TakesTheWholeChainAlong)
{
    unfold_box();
    ASSERT_GT(step_position(state), 0);
    use();
    ASSERT_TRUE(document.session.surface) << last(Severity::error);
    EXPECT_EQ(first_stale(document), std::nullopt);
    EXPECT_EQ(step_position(state), 0) << "the part is looked at again";
    EXPECT_EQ(document.session.blank->blank.position, document.unfolding->run.blank->position);
    EXPECT_EQ(document.session.blank->face.thinning, document.unfolding->run.states.back().face.thinning);
    EXPECT_EQ(source(), "steps");
    EXPECT_EQ(state.history.undo_name(), "Use the blank of the steps");
    use();
    EXPECT_THAT(last(Severity::hint), HasSubstr("in use already"));
    const auto blank = document.session.blank;
    GridOptions grid = document.session.options.grid;
    grid.cells = 25;
    model.apply(SetGrid{grid});
    wait();
    EXPECT_EQ(document.session.blank, blank) << "another grid of the same blank";
    EXPECT_EQ(first_stale(document), std::nullopt);
    model.apply(Undo{});
    model.apply(Undo{});
    EXPECT_EQ(document.session.blank, nullptr);
    EXPECT_EQ(document.session.options.steps, std::nullopt);
    model.apply(Redo{});
    EXPECT_EQ(document.session.blank, blank);
}

TEST_F(UsedBlank, IsOutOfDateOnceAStepOrTheSheetChangesAndARunReplacesIt)
{
    unfold_box();
    use();
    ChangeStep change = change_of(3);
    change.name = "only another name";
    model.apply(change);
    EXPECT_EQ(first_stale(document), std::nullopt);
    change.tolerance = 1e-6;
    model.apply(change);
    EXPECT_EQ(first_stale(document), Stage::solve);
    EXPECT_EQ(source(), "steps") << "that of the results, which stay";
    run();
    EXPECT_EQ(first_stale(document), Stage::solve) << "the new blank is not taken by itself";
    use();
    EXPECT_EQ(first_stale(document), std::nullopt);
    model.apply(SetDirection{Eigen::Vector3d(0.1, 0, 1)});
    EXPECT_EQ(first_stale(document), std::nullopt) << "which the steps do not know";
    model.apply(SetThickness{1.4});
    EXPECT_EQ(first_stale(document), Stage::solve);
    run_to(Stage::fit);
    EXPECT_THAT(last(Severity::hint), HasSubstr("in one step again"));
    EXPECT_EQ(source(), "one step");
    EXPECT_GT(document.session.blank->report.newton.size(), 0u);
    EXPECT_EQ(first_stale(document), std::nullopt);
    model.apply(Undo{});
    EXPECT_EQ(source(), "steps");
}

TEST_F(UsedBlank, UnfoldingByNameSolvesInOneStepAndTheBlankOfTheStepsCanBeTakenAgain)
{
    unfold_box();
    use();
    run_to(Stage::fit);
    EXPECT_THAT(last(Severity::hint), HasSubstr("up to date, with the blank of the steps"));
    EXPECT_EQ(source(), "steps");
    run_to(Stage::solve);
    EXPECT_EQ(source(), "one step");
    EXPECT_THAT(last(Severity::hint), HasSubstr("The blank of the steps is kept"));
    EXPECT_TRUE(all_steps_done(document));
    EXPECT_NE(document.session.blank->blank.position, document.unfolding->run.blank->position);
    use();
    EXPECT_EQ(source(), "steps");
}

TEST_F(UsedBlank, PolishedAllMaterialMovesOnceMore)
{
    unfold_box();
    use(true);
    EXPECT_EQ(source(), "steps, polished") << last(Severity::error);
    EXPECT_GT(document.session.blank->report.newton.size(), 0u);
    EXPECT_EQ(state.history.undo_name(), "Polish the blank of the steps");
    EXPECT_EQ(first_stale(document), std::nullopt);
    use(false);
    EXPECT_EQ(document.session.blank->report.newton.size(), 0u);
}

TEST_F(UsedBlank, ToolsAreLeftOutAndTheReportHasNone)
{
    unfold_box();
    model.apply(SetProcess{0.2, {}});
    use();
    EXPECT_EQ(source(), "steps") << last(Severity::error);
    EXPECT_EQ(document.made_with.flatten.process.edge_restraint, 0);
    EXPECT_EQ(first_stale(document), std::nullopt);
    EXPECT_EQ(state_report(state)["options"]["blank_from"], "steps");
}

TEST_F(UsedBlank, TheReportForPeopleTellsOfTheSteps)
{
    unfold_box();
    const auto html = [&] {
        write_html_report(folder / "report.html", as_made(document), {}, {}, {});
        return content_of(folder / "report.html");
    };
    run_to(Stage::solve);
    EXPECT_THAT(html(), AllOf(Not(HasSubstr("step by step")), HasSubstr("Convergence of the solver")));
    use();
    EXPECT_THAT(html(), AllOf(HasSubstr("made step by step, in 5 steps<"), HasSubstr("The steps of the blank"),
                              HasSubstr(document.steps[3]->name), HasSubstr("each of which converged"),
                              Not(HasSubstr("Convergence of the solver"))));
    use(true);
    EXPECT_THAT(html(), AllOf(HasSubstr("then polished"), HasSubstr("Convergence of the solver")));
}

TEST_F(UsedBlank, AProjectMakesItAgain)
{
    unfold_box();
    use(true);
    const Eigen::Matrix2Xd flat = document.session.blank->blank.position;
    model.apply(SaveProject{folder / "box.spia"});
    model.apply(OpenProject{folder / "box.spia"});
    wait();
    ASSERT_TRUE(document.session.surface) << last(Severity::error);
    EXPECT_EQ(source(), "steps, polished");
    EXPECT_EQ(document.session.blank->blank.position, flat);
    EXPECT_FALSE(state.document.unsaved);
    EXPECT_EQ(state.history.undo_name(), "");
}

TEST_F(UsedBlank, AProjectWhoseStepsHaveChangedSinceSaysSo)
{
    unfold_box();
    use();
    ChangeStep change = change_of(0);
    change.tolerance = 1e-6;
    model.apply(change);
    model.apply(SaveProject{folder / "box.spia"});
    model.apply(OpenProject{folder / "box.spia"});
    wait();
    EXPECT_TRUE(std::any_of(state.messages.begin(), state.messages.end(), [](const Message& message) {
        return message.text.find("The steps have changed since their blank was computed") != std::string::npos;
    }));
    EXPECT_EQ(source(), "one step");
}

TEST_F(UsedBlank, UnfoldingDuringARunEndsInOneStep)
{
    unfold_box();
    model.apply(UseBlankOfSteps{});
    model.apply(RunTo{Stage::solve});
    wait();
    EXPECT_EQ(document.session.options.steps, std::nullopt);
    EXPECT_EQ(source(), "one step") << last(Severity::error);
}

TEST_F(UsedBlank, StepsOfAPartThatIsToBeReadAgainAreNotUsed)
{
    unfold_box();
    model.apply(SetUnit{"cm"});
    model.apply(CancelJob{});
    wait();
    if (first_stale(document) == Stage::read) { // else it was read before
        use();
        EXPECT_THAT(last(Severity::error), HasSubstr("must be read again first"));
        EXPECT_EQ(document.session.options.steps, std::nullopt);
    }
}

TEST_F(UsedBlank, WithoutOneTheActionSaysWhatIsMissing)
{
    open_box();
    use();
    EXPECT_THAT(last(Severity::error), HasSubstr("There are no steps yet"));
    propose();
    use();
    EXPECT_THAT(last(Severity::error), HasSubstr("Run all steps first"));
    model.apply(RemoveStep{4});
    run();
    use();
    EXPECT_THAT(last(Severity::error), HasSubstr("is not flat yet"));
    EXPECT_EQ(document.session.options.steps, std::nullopt);
    const Action action = UseBlankOfSteps{true};
    EXPECT_EQ(to_json(action_from_json(to_json(action), state)), to_json(action));
}

TEST_F(UsedBlank, ACancelledRunLeavesWhatWasThere)
{
    unfold_box();
    run_to(Stage::fit);
    const auto blank = document.session.blank;
    model.apply(UseBlankOfSteps{true});
    model.apply(CancelJob{});
    wait();
    if (document.session.blank == blank) { // else it was done before
        EXPECT_EQ(first_stale(document), std::nullopt);
        EXPECT_EQ(document.session.options.steps, std::nullopt);
        EXPECT_EQ(state.history.undo_name(), "Update all");
    }
    use();
    EXPECT_EQ(source(), "steps");
}

} // namespace spia::viewer
