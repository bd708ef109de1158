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
    FitChoice finer = fit_choice(document.session.options);
    finer.tolerance = 0.5e-3 * bounding_diagonal(document.session.part->mesh);
    model.apply(SetFit{finer});
    wait();
    EXPECT_EQ(document.session.surface->fit->tolerance, *finer.tolerance);
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
    FitChoice finer = fit_choice(document.session.options);
    finer.tolerance = 0.05e-3 * bounding_diagonal(document.session.part->mesh); // takes a while
    model.apply(SetFit{finer});
    const auto fits = [&] { return state.job.step.find("fitting") != std::string::npos; };
    while (model.busy() && !fits())
        model.poll();
    ASSERT_TRUE(fits()) << "the grid that is tried first is made";
    model.apply(CancelJob{});
    wait();
    EXPECT_EQ(document.session.surface, before);
    EXPECT_FALSE(document.session.grid);
    EXPECT_EQ(document.session.options.tolerance, std::nullopt);
    EXPECT_TRUE(says(Severity::hint, "The options are again those of the result that is shown"));
    EXPECT_EQ(first_stale(document), std::nullopt);
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
    EXPECT_THAT(document.session.surface->choice, HasSubstr("of a layout"));
    model.apply(SetPatches{LayoutOptions{}, true});
    EXPECT_TRUE(says(Severity::error, "give a layout, or best"));
}

} // namespace spia::viewer
