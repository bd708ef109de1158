#include <gmock/gmock.h>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/fit_choice.h"
#include "engine/mesh/topology.h"
#include "tests/unit/viewer/model_fixture.h"

using testing::HasSubstr;

namespace spia::viewer {

/// As a user has it who has chosen nothing.
struct BestSurfaceChoice : ModelFixture {
    BestSurfaceChoice() { model.apply(SetPreferences{}); }

    void fit_within(double share_of_diagonal)
    {
        FitChoice choice = fit_choice(document.session.options);
        choice.tolerance = share_of_diagonal * bounding_diagonal(document.session.part->mesh);
        model.apply(SetFit{choice});
    }
    /// Whether it comes to the fit of the running job.
    bool wait_for_fitting()
    {
        const auto fits = [&] { return state.job.step.find("fitting") != std::string::npos; };
        while (model.busy() && !fits())
            model.poll();
        return fits();
    }
};

TEST_F(BestSurfaceChoice, APartBeginsWithItAndHasNoGridWhereItIsOfPatches)
{
    open();
    EXPECT_TRUE(document.session.options.best_surface);
    model.apply(RunTo{Stage::fit});
    wait();
    ASSERT_TRUE(document.session.surface);
    ASSERT_TRUE(document.session.surface->patches) << "a round blank has no corners for one patch";
    EXPECT_FALSE(document.session.grid);
    EXPECT_EQ(first_stale(document), std::nullopt);
    fit_within(0.5e-3);
    wait();
    EXPECT_EQ(document.session.surface->fit->tolerance, document.session.options.tolerance);
    EXPECT_EQ(first_stale(document), std::nullopt);
    model.apply(SetCorner{0, 0});
    EXPECT_TRUE(says(Severity::error, "patches, which have corners of their own"));
}

TEST_F(BestSurfaceChoice, ACancelOnTheWayToPatchesLeavesThoseThatThereWere)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    const auto before = document.session.surface;
    ASSERT_TRUE(before && before->patches);
    fit_within(0.05e-3); // takes a while
    ASSERT_TRUE(wait_for_fitting()) << "the grid that is tried first is made";
    model.apply(CancelJob{});
    wait();
    EXPECT_EQ(document.session.surface, before);
    EXPECT_FALSE(document.session.grid);
    EXPECT_EQ(document.session.options.tolerance, std::nullopt);
    EXPECT_TRUE(says(Severity::hint, "The options are again those of the result that is shown"));
    EXPECT_EQ(first_stale(document), std::nullopt);
}

TEST_F(BestSurfaceChoice, ACancelBeforeThereIsASurfaceLeavesNoGrid)
{
    open();
    model.apply(RunTo{Stage::solve});
    wait();
    model.apply(RunTo{Stage::fit});
    ASSERT_TRUE(wait_for_fitting()) << "the grid that is tried first is made";
    model.apply(CancelJob{});
    wait();
    ASSERT_FALSE(document.session.surface);
    EXPECT_FALSE(document.session.grid) << "nobody asked for it";
    EXPECT_TRUE(document.session.blank);
    EXPECT_EQ(first_stale(document), Stage::grid);
}

TEST_F(BestSurfaceChoice, AnOptionThatIsChangedDuringAFitTakesItsPlace)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    fit_within(0.05e-3); // takes a while
    const double former = *document.session.options.tolerance;
    ASSERT_TRUE(wait_for_fitting());
    fit_within(2e-3);
    while (model.busy()) {
        model.poll();
        if (const auto& surface = document.session.surface)
            ASSERT_NE(surface->fit->tolerance, former) << "nobody wants it any more";
    }
    ASSERT_TRUE(document.session.surface);
    EXPECT_EQ(document.session.surface->fit->tolerance, document.session.options.tolerance);
    EXPECT_EQ(first_stale(document), std::nullopt);
    EXPECT_FALSE(says(Severity::hint, "cancelled"));
    EXPECT_EQ(state.history.depth(), 3u) << "the run and two changes";
}

TEST_F(BestSurfaceChoice, ACancelAfterThatGoesBackToWhatIsShown)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    const auto before = document.session.surface;
    for (const bool begun_again : {true, false}) {
        fit_within(0.05e-3);
        ASSERT_TRUE(wait_for_fitting());
        fit_within(0.04e-3);
        while (begun_again && state.job.step.find("fitting") != std::string::npos)
            model.poll();
        model.apply(CancelJob{});
        wait();
        EXPECT_TRUE(says(Severity::hint, "cancelled. The options are again those of the result that is shown"));
        EXPECT_EQ(document.session.options.tolerance, std::nullopt);
        EXPECT_EQ(document.session.surface, before);
        EXPECT_EQ(first_stale(document), std::nullopt);
        EXPECT_EQ(state.history.depth(), 1u);
    }
}

TEST_F(BestSurfaceChoice, WhoChangesTheGridOrACornerWantsOnePatch)
{
    open("fender.obj");
    model.apply(RunTo{Stage::fit});
    wait();
    ASSERT_TRUE(document.session.grid);
    EXPECT_THAT(document.session.surface->choice, HasSubstr("one patch over the whole blank"));
    const double tolerance = document.session.surface->fit->tolerance;
    model.apply(ProposeCorners{});
    wait();
    EXPECT_FALSE(document.session.options.best_surface);
    EXPECT_EQ(document.session.options.tolerance, tolerance) << "as near as before";
    EXPECT_EQ(document.session.surface->choice, "") << "it was asked for";
    model.apply(Undo{});
    wait();
    EXPECT_TRUE(document.session.options.best_surface);
    EXPECT_EQ(document.session.options.tolerance, std::nullopt);
    GridOptions grid = document.session.options.grid;
    grid.cells = 20;
    model.apply(SetGrid{grid});
    wait();
    EXPECT_FALSE(document.session.options.best_surface);
    EXPECT_EQ(document.session.surface->fit->tolerance, tolerance) << "as near as before";
    EXPECT_TRUE(says(Severity::hint, "made of one patch from now on"));
}

TEST_F(BestSurfaceChoice, WhoWantsOnePatchWhereItHadNoGridBeginsWithTheGrid)
{
    open();
    model.apply(RunTo{Stage::solve});
    wait();
    Document without = document;
    without.session.no_grid = "cells fold";
    EXPECT_EQ(first_stale(without), Stage::fit);
    without.session.options.best_surface = false;
    EXPECT_EQ(first_stale(without), Stage::grid);
}

TEST_F(BestSurfaceChoice, IsChosenAmongThree)
{
    open();
    model.apply(RunTo{Stage::solve});
    wait();
    model.apply(SetPatches{});
    wait();
    EXPECT_FALSE(document.session.options.best_surface);
    ASSERT_TRUE(document.session.surface);
    EXPECT_FALSE(document.session.surface->patches);
    model.apply(SetPatches{LayoutOptions{}});
    wait();
    EXPECT_TRUE(document.session.surface->patches);
    EXPECT_EQ(document.session.surface->choice, "");
    model.apply(SetPatches{std::nullopt, true});
    wait();
    EXPECT_TRUE(document.session.options.best_surface);
    EXPECT_THAT(document.session.surface->choice, HasSubstr("patches, because one patch"));
    model.apply(SetPatches{LayoutOptions{}, true});
    EXPECT_TRUE(says(Severity::error, "give a layout, or best"));
}

} // namespace spia::viewer
