// Unfolding step by step: the list, its runs, what holds of them after a change, undo, projects, scripts.
#include "app/viewer/model/unfolding_steps.h"

#include <Eigen/Geometry>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <numbers>

#include "app/viewer/model/project_file.h"
#include "app/viewer/model/script.h"
#include "app/viewer/model/state_report.h"
#include "app/viewer/model/step_motion.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/step_scene.h"
#include "app/viewer/views/views.h"
#include "engine/mesh/region.h"
#include "tests/support/bent_parts.h"
#include "tests/support/mesh_file.h"
#include "tests/support/mesh_tools.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {
namespace {

using shapes::Profile;
using std::numbers::pi;
using testing::HasSubstr;

struct UnfoldingSteps : ModelFixture {
    ScratchFolder folder;

    std::string last(Severity severity) const
    {
        for (auto message = state.messages.rbegin(); message != state.messages.rend(); ++message)
            if (message->severity == severity && !message->dismissed)
                return message->text;
        return "";
    }
    void open_mesh(const TriMesh& mesh)
    {
        shapes::write_mesh(folder / "part.obj", mesh);
        model.apply(OpenPart{folder / "part.obj", ""});
        wait();
        ASSERT_NE(document.session.part, nullptr) << last(Severity::error);
    }
    /// A lying U: flat 20, bent over 5, flat 60 upright, bent over 5, flat 25 below the first; all 80 long.
    const shapes::DevelopablePart channel = shapes::extruded(
        Profile({0, 0}, 0).straight(20).bend(5, -pi / 2).straight(60).bend(5, -pi / 2).straight(25), 80, 1500);
    void open_channel() { open_mesh(channel.mesh); }
    void open_box() { open_mesh(shapes::lipped_box()); }
    void propose(std::optional<int> keep = {})
    {
        model.apply(ProposeSteps{keep});
        wait();
    }
    void run()
    {
        model.apply(RunSteps{});
        wait();
    }
    const UnfoldState& after(size_t step) const { return document.unfolding->run.states[step]; }
    std::vector<std::string> names() const
    {
        std::vector<std::string> result;
        for (const auto& step : document.steps)
            result.push_back(step->name);
        return result;
    }
    std::vector<StepStatus> status() const
    {
        std::vector<StepStatus> result;
        for (size_t k = 0; k < document.steps.size(); ++k)
            result.push_back(step_status(document, k));
        return result;
    }
    ChangeStep change_of(int step) const
    {
        const PlannedStep& now = *document.steps[size_t(step)];
        return {step, now.name, now.offset_mm, now.within_mm, now.tolerance};
    }
    /// Faces of the channel by what their normals say: the middle is horizontal.
    FaceSet with_height(double least, double greatest) const
    {
        const TriMesh& mesh = document.session.part->mesh;
        FaceSet faces;
        for (int f = 0; f < mesh.triangles(); ++f) {
            const double z = mesh.position(Eigen::all, mesh.triangle.col(f)).row(2).mean();
            if (z >= least && z <= greatest)
                faces.push_back(f);
        }
        return faces;
    }
};

constexpr auto done = StepStatus::done, stale = StepStatus::stale, missing = StepStatus::missing,
               failed = StepStatus::failed;

} // namespace

TEST_F(UnfoldingSteps, AProposedListUnfoldsABentSheetToItsDevelopment)
{
    open_channel();
    propose();
    ASSERT_FALSE(document.steps.empty()) << last(Severity::error);
    EXPECT_THAT(last(Severity::done), HasSubstr("3 regions and 2 bends"));
    EXPECT_EQ(state.history.undo_name(), "Propose steps");
    EXPECT_EQ(state.view.step, 0);
    EXPECT_EQ(steps_done(document), 0u);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    const Eigen::Matrix2Xd& flat = document.unfolding->run.blank->position;
    const Eigen::Vector2d size = flat.rowwise().maxCoeff() - flat.rowwise().minCoeff();
    const Eigen::Vector2d wanted = channel.flat.rowwise().maxCoeff() - channel.flat.rowwise().minCoeff();
    EXPECT_NEAR(size[0], wanted.maxCoeff(), 1e-4);
    EXPECT_NEAR(size[1], 80, 1e-4);
    EXPECT_THAT(last(Severity::done), HasSubstr(fmt::format("a blank of {:.4g} x {:.4g} mm", size[0], size[1])));
    EXPECT_EQ(step_position(state), double(document.steps.size())) << "its end is shown";
    run();
    EXPECT_THAT(last(Severity::hint), HasSubstr("up to date"));
    model.apply(Undo{});
    EXPECT_EQ(document.unfolding, nullptr);
    model.apply(Undo{});
    EXPECT_TRUE(document.steps.empty());
    model.apply(Redo{});
    model.apply(Redo{});
    EXPECT_TRUE(all_steps_done(document));
}

TEST_F(UnfoldingSteps, TheRegionOfAFaceStaysWhereItIs)
{
    open_channel();
    const TriMesh& part = document.session.part->mesh;
    Eigen::Index outermost; // of the leg of 25
    part.position.row(2).minCoeff(&outermost);
    int keep = -1;
    for (int f = 0; f < part.triangles(); ++f)
        if ((part.triangle.col(f).array() == int(outermost)).any())
            keep = f;
    propose(keep);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    const Eigen::Matrix3Xd& flat = after(document.steps.size() - 1).position;
    EXPECT_EQ(flat(Eigen::all, part.triangle.col(keep)), part.position(Eigen::all, part.triangle.col(keep)));
    const auto before = names();
    const Eigen::VectorXi& label = document.bends->map.label; // regions, then bends
    propose(int(std::max_element(label.begin(), label.end()) - label.begin()));
    EXPECT_THAT(last(Severity::error), HasSubstr("lies on a bend"));
    EXPECT_EQ(names(), before);
}

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
    EXPECT_THAT(last(Severity::warning), HasSubstr("does not lie in a plane"));
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
    EXPECT_THAT(last(Severity::error), HasSubstr("7 mm beside the target"));
    EXPECT_THAT(last(Severity::error), HasSubstr("The states up to step 1 are kept"));
    EXPECT_THAT(last(Severity::error), HasSubstr("take away its offset")) << "what can be done here";
    EXPECT_EQ(step_position(state), 1);
    EXPECT_EQ(state.view.step, 1) << "to be changed";
    change.offset_mm = 0;
    model.apply(change);
    EXPECT_EQ(status()[1], missing);
    run();
    EXPECT_EQ(status(), std::vector(5, done));
}

TEST_F(UnfoldingSteps, AStepOfPickedFacesLaysThemOnTheFaceOfARegion)
{
    open_channel();
    const double top = document.session.part->mesh.position.row(2).maxCoeff();
    model.apply(AddStep{0, {}, ""});
    EXPECT_THAT(last(Severity::error), HasSubstr("no region 1"));
    // The first leg lies at the top; what is below its plane hangs on it: all else of the part.
    const FaceSet leg = with_height(top - 1e-6, top);
    model.apply(SelectFaces{leg});
    model.apply(MakeRegion{"leg", RegionKind::fixed});
    model.apply(AddStep{0, 0, ""});
    EXPECT_THAT(last(Severity::error), HasSubstr("cannot both stay and be unfolded"));
    model.apply(AddStep{0, {}, ""});
    EXPECT_THAT(last(Severity::error), HasSubstr(fmt::format("{} faces to unfold also belong", leg.size())));
    model.apply(ClearSelection{});
    model.apply(AddStep{0, {}, ""});
    EXPECT_THAT(last(Severity::error), HasSubstr("Select the faces to unfold first"));
    EXPECT_TRUE(document.steps.empty());
    model.apply(SelectFaces{inverted(leg, document.session.part->mesh.triangles())});
    model.apply(AddStep{0, {}, ""});
    ASSERT_EQ(document.steps.size(), 1u) << last(Severity::error);
    EXPECT_THAT(names()[0], HasSubstr("onto leg"));
    EXPECT_EQ(carrying_faces(*document.steps[0]), leg);
    EXPECT_EQ(document.steps[0]->pick.fixed, leg);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    EXPECT_LT((after(0).position.row(2).array() - top).abs().maxCoeff(), 1e-6);
    EXPECT_EQ(after(0).position(Eigen::all, document.session.part->mesh.triangle.col(leg[0])),
              document.session.part->mesh.position(Eigen::all, document.session.part->mesh.triangle.col(leg[0])));
}

TEST_F(UnfoldingSteps, AllThatIsNotPickedStaysButOnlyTheRegionCarriesTheFace)
{
    open_channel();
    const TriMesh& part = document.session.part->mesh;
    const double right = part.position.row(0).maxCoeff(), top = part.position.row(2).maxCoeff();
    FaceSet web, upper;
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Matrix3d corner = part.position(Eigen::all, part.triangle.col(f));
        if (corner.row(0).minCoeff() > right - 1e-4)
            web.push_back(f);
        else if (corner.row(2).minCoeff() > top - 5 - 1e-4)
            upper.push_back(f);
    }
    model.apply(SelectFaces{web});
    model.apply(MakeRegion{"web", RegionKind::fixed});
    model.apply(SelectFaces{upper});
    model.apply(MakeRegion{"upper leg", RegionKind::other});
    model.apply(AddStep{0, 1, ""});
    EXPECT_EQ(names(), std::vector<std::string>{"upper leg onto web"});
    run();
    ASSERT_EQ(status(), std::vector{done}) << last(Severity::error);
    EXPECT_THAT(last(Severity::warning), HasSubstr("does not lie in a plane yet; add a step"));
    for (const int f : upper)
        for (const int v : part.triangle.col(f))
            EXPECT_NEAR(after(0).position(0, v), right, 1e-4);
    for (const int f : inverted(upper, part.triangles())) // the lower leg, too
        EXPECT_EQ(after(0).position(Eigen::all, part.triangle.col(f)), part.position(Eigen::all, part.triangle.col(f)));
    const auto before = document.steps[0];
    model.apply(SaveProject{folder / "own.spia"});
    model.apply(OpenProject{folder / "own.spia"});
    wait();
    ASSERT_EQ(document.steps.size(), 1u);
    EXPECT_EQ(document.steps[0]->pick.carrying, web);
    EXPECT_EQ(document.steps[0]->pick.fixed, before->pick.fixed);
    EXPECT_EQ(document.steps[0]->pick.freed, upper);
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
    wait();
    EXPECT_TRUE(all_steps_done(document));
}

TEST_F(UnfoldingSteps, AFlatPartHasNothingToUnfold)
{
    open_mesh(shapes::extruded(Profile({0, 0}, 0).straight(60), 40, 200).mesh);
    propose();
    EXPECT_THAT(last(Severity::hint), HasSubstr("flat already"));
    EXPECT_TRUE(document.steps.empty());
    EXPECT_EQ(state.history.undo_name(), "");
}

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
        run_steps(shared, document.steps, sheet_of_steps(document.session.options.flatten), nullptr, 0, progress);
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
            run_steps(document.session.part, document.steps, sheet_of_steps(document.session.options.flatten), before,
                      keep, Progress([&](double fraction, std::string_view) { seen.push_back(fraction); }));
        EXPECT_EQ(outcome.run->run.states.size(), 5u);
        EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
        EXPECT_NEAR(seen.front(), 0, 1e-12);
        EXPECT_GT(seen.back(), 1 - 1.01 / double(5 - keep)) << "within the last step";
        EXPECT_LE(seen.back(), 1 + 1e-12);
        return outcome.run;
    };
    fractions(fractions(nullptr, 0), 3);
}

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

TEST_F(UnfoldingSteps, ScriptsSayTheSameActions)
{
    open_box();
    const auto perform = [&](const char* text) {
        model.apply(action_from_json(parse_json(text, "test"), state));
        wait();
    };
    perform(R"({"do": "propose_steps"})");
    perform(R"({"do": "change_step", "step": 3, "tolerance": 1e-7})");
    EXPECT_EQ(document.steps[3]->tolerance, 1e-7);
    const std::string name = document.steps[3]->name;
    perform(R"({"do": "change_step", "step": 3, "within_mm": 0.1})");
    EXPECT_EQ(document.steps[3]->name, name) << "what is not given stays";
    EXPECT_EQ(document.steps[3]->tolerance, 1e-7);
    perform(R"({"do": "run_steps"})");
    perform(R"({"do": "show_step", "position": 3.25})");
    EXPECT_EQ(state.view.step, 3);
    const Json report = state_report(state)["unfolding"];
    EXPECT_EQ(report["done"], 5);
    EXPECT_EQ(report["position"], 3.25);
    EXPECT_EQ(report["steps"][3]["status"], "done");
    EXPECT_EQ(report["steps"][3]["on"], "plane");
    EXPECT_EQ(report["steps"][3]["freed"], document.steps[3]->pick.freed.size());
    EXPECT_EQ(report["steps"][3]["strain_equivalent"], document.unfolding->figure[3].strain_equivalent);
    EXPECT_GT(report["blank"]["size"][0], 100 + 2 * 30) << "with the lips it is wider than bottom and walls";
    for (const Action& action : {Action(ProposeSteps{7}), Action(RunSteps{}), Action(AddStep{2, 1, "a"}),
                                 Action(ChangeStep{1, "b", -2.5, 0.5, 1e-6}), Action(RemoveStep{3}),
                                 Action(MoveStep{1, 2}), Action(ShowStep{1, 0.5})})
        EXPECT_EQ(to_json(action_from_json(to_json(action), state)), to_json(action)) << to_json(action);
    perform(R"({"do": "remove_step", "step": 4})");
    perform(R"({"do": "move_step", "step": 0, "to": 2})");
    EXPECT_EQ(document.steps.size(), 4u);
    EXPECT_THROW(action_from_json(parse_json(R"({"do": "move_step", "step": 0})", "test")), InputError);
}

TEST_F(UnfoldingSteps, FiguresAreThoseOfTheFacesThatAStepMoves)
{
    open_box();
    propose();
    run();
    ASSERT_EQ(status(), std::vector(5, done));
    for (size_t k = 0; k < 5; ++k) {
        double least = 1e300, greatest = -1e300, strain = 0;
        for (const int f : document.steps[k]->pick.freed) {
            least = std::min(least, after(k).face.thinning[f]);
            greatest = std::max(greatest, after(k).face.thinning[f]);
            strain = std::max(strain, after(k).face.strain_equivalent[f]);
        }
        const StepFigures& figures = document.unfolding->figure[k];
        EXPECT_EQ(figures.thinning, (std::array{least, greatest}));
        EXPECT_EQ(figures.strain_equivalent, strain);
    }
}

TEST_F(UnfoldingSteps, ThePartIsShownAsItsStepsHaveUnfoldedIt)
{
    open_channel();
    SceneCache cache;
    const auto shown = [&] { return part_scene(state, cache); };
    const auto layers_of_the_part = shown().layers;
    propose();
    run();
    ASSERT_TRUE(all_steps_done(document));
    const int vertices = document.session.part->mesh.vertices();
    for (const double position : {0., 0.5, 1., double(document.steps.size())}) {
        model.apply(ShowStep{{}, position});
        const Scene scene = shown();
        const SceneMesh& mesh = *scene.layers[0].mesh;
        const Eigen::Matrix3Xd place = mesh.position.leftCols(vertices).cast<double>().colwise() + mesh.origin;
        EXPECT_LT((place - unfolded_places(document, position)).cwiseAbs().maxCoeff(), 1e-4) << position;
        EXPECT_EQ(scene.layers.size(), position == 0 ? 1u : 2u) << "the sheet and its target";
        EXPECT_TRUE(scene.layers[0].field == nullptr);
        if (position == 0)
            continue;
        // Flat where it was laid, its normals too.
        const auto step = size_t(std::ceil(position)) - 1;
        EXPECT_EQ(state.view.step, int(step));
        const auto& mark = scene.layers[0].marks->mark;
        for (const int f : document.steps[step]->pick.freed)
            EXPECT_EQ(scene.region_colours[size_t(mark[size_t(f)]) - 1], palette::freed);
        for (const int f : carrying_faces(*document.steps[step]))
            EXPECT_EQ(scene.region_colours[size_t(mark[size_t(f)]) - 1], palette::fixed);
        EXPECT_LT(scene.layers[1].colour[3], 0.5) << "translucent";
    }
    EXPECT_LT(shown().layers[0].mesh->normal.bottomRows<2>().cwiseAbs().maxCoeff(), 1e-3)
        << "at the end all lies in the upright plane";
    model.apply(ShowStep{});
    EXPECT_EQ(shown().layers[0].mesh, layers_of_the_part[0].mesh);
}

TEST_F(UnfoldingSteps, TheFieldOfTheStateThatIsShownOrComesNextColoursIt)
{
    open_box();
    propose();
    run();
    ASSERT_EQ(status(), std::vector(5, done));
    ASSERT_GT(after(4).face.strain_equivalent.maxCoeff(), after(3).face.strain_equivalent.maxCoeff() + 0.1)
        << "the last step strains the corners";
    SceneCache cache;
    ViewSettings settings = state.view;
    settings.field_on_steps = true;
    model.apply(SetViewSettings{settings});
    FieldDisplay display = document.display;
    display.field = Field::strain_equivalent;
    display.per_face = true;
    model.apply(SetDisplay{display});
    for (const auto& [position, number] : {std::pair(5., 4u), {4.3, 4u}, {4., 3u}, {0.5, 0u}}) {
        model.apply(ShowStep{{}, position});
        const Scene coloured = part_scene(state, cache);
        ASSERT_TRUE(coloured.layers[0].field) << position;
        EXPECT_EQ(coloured.legend->title, "Equivalent strain");
        EXPECT_LT((coloured.layers[0].field->value.cast<double>() - after(number).face.strain_equivalent)
                      .cwiseAbs()
                      .maxCoeff(),
                  1e-6)
            << position;
    }
    display.field = Field::area_change; // of a blank, not of a state
    model.apply(SetDisplay{display});
    EXPECT_EQ(part_scene(state, cache).layers[0].field, nullptr);
}

TEST_F(UnfoldingSteps, WhatIsPickedIsWhatIsShown)
{
    open_channel();
    propose();
    run();
    ASSERT_TRUE(all_steps_done(document));
    model.apply(LookFrom{View::part, StandardView::right});
    model.apply(FitView{View::part});
    const PickArea everything{View::part, {{0, 0}, {800, 0}, {800, 600}, {0, 600}}, {800, 600}};
    model.apply(everything);
    EXPECT_EQ(int(document.selected.size()), document.session.part->mesh.triangles()) << "flat: all is in sight";
    model.apply(ShowStep{{}, 0.});
    model.apply(everything);
    EXPECT_LT(int(document.selected.size()), document.session.part->mesh.triangles() / 2 + 200) << "the legs hide";
    const auto before = document.selected;
    model.apply(ShowStep{{}, 0.5});
    model.apply(everything);
    EXPECT_THAT(last(Severity::error), HasSubstr("on the way from one step to the next"));
    EXPECT_EQ(document.selected, before);
    model.apply(DrawSection{View::part, {0, 300}, {800, 300}, {800, 600}});
    EXPECT_THAT(last(Severity::error), HasSubstr("back to the part"));
}

TEST(StepMotion, AFlangeTurnsAboutItsHingeOnAnArc)
{
    // A strip of two cells; the second one turns about the edge x = 1, which stays.
    const Eigen::Matrix3Xi triangle = (Eigen::Matrix3Xi(3, 4) << 0, 0, 2, 2, 2, 3, 4, 5, 3, 1, 5, 3).finished();
    Eigen::Matrix3Xd flat(3, 6);
    flat << 0, 0, 1, 1, 3, 3, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0;
    for (const double angle : {0.4, pi / 2, 2.5, pi}) {
        const auto turned = [&](double by) {
            Eigen::Matrix3Xd place = flat;
            for (const int v : {4, 5}) {
                place(0, v) = 1 + 2 * std::cos(by);
                place(2, v) = 2 * std::sin(by);
            }
            return place;
        };
        for (const double share : {0., 0.25, 0.5, 0.8, 1.}) {
            const Eigen::Matrix3Xd way = on_the_way(triangle, turned(angle), turned(0), share);
            for (const int v : {4, 5}) {
                const Eigen::Vector2d arm(way(0, v) - 1, way(2, v));
                EXPECT_NEAR(arm.norm(), 2, 1e-9) << angle << " " << share;
                EXPECT_NEAR(std::atan2(arm.y(), arm.x()), (1 - share) * angle, 1e-9) << angle << " " << share;
            }
            EXPECT_EQ(way.leftCols(4), flat.leftCols(4));
        }
    }
}

TEST(TargetPatch, LiesOnItsFaceAndReachesBeyondWhatLiesOnIt)
{
    const CylinderFace cylinder{{1, 2, 3}, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), 10, true};
    HeightFace height{{0, 0, 5}, Eigen::Matrix3d::Identity().leftCols<2>(), {-20, -20}, 10, Eigen::MatrixXd(9, 9)};
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j)
            height.coefficient(i, j) = 0.1 * i * j;
    for (const BinderFace& face : {BinderFace(cylinder), BinderFace(height)}) {
        Eigen::Matrix3Xd places(3, 3);
        for (int k = 0; k < 3; ++k)
            places.col(k) = placed(face, Eigen::Vector2d(3 * k, k * k));
        const TriMesh patch = target_patch(face, places);
        Eigen::AlignedBox2d box;
        for (const auto x : patch.position.colwise()) {
            EXPECT_LT((x - placed(face, developed(face, x))).norm(), 1e-9);
            box.extend(developed(face, x));
        }
        const double margin = 0.08 * Eigen::Vector2d(6, 4).norm();
        EXPECT_NEAR(box.min()[0], -margin, 1e-6);
        EXPECT_NEAR(box.max()[0], 6 + margin, 1e-6);
        EXPECT_NEAR(box.max()[1], 4 + margin, 1e-6);
    }
}

} // namespace spia::viewer
