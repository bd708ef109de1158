#include "app/viewer/model/jobs/viewer_model.h"

#include <fstream>
#include <gtest/gtest.h>

#include "app/viewer/model/actions/names.h"
#include "app/viewer/views/views.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {

using ViewerModelTest = ModelFixture;

TEST_F(ViewerModelTest, RunsTheChainInTheBackgroundAndShowsTheBlankWhileItConverges)
{
    open("square-cup.obj");
    model.apply(RunTo{Stage::fit});
    EXPECT_TRUE(model.busy());
    size_t shapes = 0, steps = 0;
    bool blank_first = false;
    double fraction = 0;
    std::shared_ptr<const Eigen::Matrix2Xd> last;
    while (model.busy()) {
        model.poll();
        blank_first |= model.busy() && document.session.blank && document.session.limits && !document.session.surface;
        if (model.busy()) {
            EXPECT_GE(state.job.fraction, fraction - 1e-12) << "progress goes back at " << state.job.step;
            fraction = state.job.fraction;
        }
        if (state.job.blank && state.job.blank != last) {
            last = state.job.blank;
            ++shapes;
            EXPECT_EQ(last->cols(), document.session.part->mesh.vertices());
        }
        steps = std::max(steps, state.job.residual.size());
    }
    EXPECT_TRUE(blank_first) << "the strains are there while the surface is still being made";
    EXPECT_GT(fraction, 0.6) << "of the run as a whole";
    EXPECT_GT(shapes, 0u);
    EXPECT_GT(steps, 3u);
    ASSERT_NE(document.session.surface, nullptr);
    EXPECT_FALSE(state.job.running);
    EXPECT_FALSE(first_stale(document));
}

TEST(ViewerModelMemory, WhatARunHasMadeGoesWithTheModel)
{
    std::weak_ptr<const FlattenResult> blank;
    {
        ViewerModel model{SPIA_SOURCE_DIR "/assets"};
        for (const Action& action :
             {Action{OpenPart{SPIA_SOURCE_DIR "/assets/parts/dome.obj", ""}}, Action{RunTo{Stage::fit}}}) {
            model.apply(action);
            while (model.busy())
                model.poll();
        }
        blank = model.state().document.session.blank;
        ASSERT_FALSE(blank.expired());
    }
    EXPECT_TRUE(blank.expired());
}

TEST_F(ViewerModelTest, TheTitleOfTheWindowNamesThePartAndMarksWhatIsNotSaved)
{
    EXPECT_EQ(window_title(state), "SPIA");
    open();
    EXPECT_EQ(window_title(state), "dome - SPIA");
    model.apply(SelectFaces{{1}});
    EXPECT_EQ(window_title(state), "dome* - SPIA");
    const ScratchFolder folder;
    const auto file = folder / "first try.spia";
    model.apply(SaveProject{file});
    EXPECT_EQ(window_title(state), "first try - SPIA");
}

TEST_F(ViewerModelTest, CancellingKeepsWhatWasThere)
{
    open("square-cup.obj");
    model.apply(RunTo{Stage::fit});
    wait();
    const auto blank = document.session.blank;
    model.apply(SetThickness{2});
    EXPECT_EQ(first_stale(document), Stage::solve);
    EXPECT_EQ(document.session.blank, blank); // still to be looked at
    model.apply(RunTo{Stage::fit});
    while (state.job.residual.empty() && model.busy())
        model.poll();
    model.apply(CancelJob{});
    wait();
    EXPECT_EQ(document.session.blank, blank);
    EXPECT_EQ(document.session.options.flatten.thickness, 2);
    EXPECT_EQ(first_stale(document), Stage::solve);
    EXPECT_TRUE(says(Severity::hint, "cancelled"));
}

TEST_F(ViewerModelTest, AReadingThatIsCancelledTakesItsOptionsBack)
{
    open();
    model.apply(RunTo{Stage::solve});
    wait();
    model.apply(SetRemeshing{RemeshOptions{}});
    ASSERT_EQ(first_stale(document), Stage::read);
    model.apply(CancelJob{});
    wait();
    EXPECT_FALSE(document.session.options.read.remesh);
    EXPECT_NE(first_stale(document), Stage::read);
    EXPECT_FALSE(state.document.unsaved);
    EXPECT_TRUE(says(Severity::hint, "The options are again those of the result that is shown"));
}

TEST_F(ViewerModelTest, WhatFixedRegionsActOnIsSaidWhereNothingIsToBeDone)
{
    open();
    model.apply(SelectFaces{{1, 2, 3}});
    model.apply(MakeRegion{"clamp", RegionKind::fixed});
    model.apply(RunTo{Stage::solve});
    wait();
    model.apply(RunTo{Stage::solve});
    EXPECT_TRUE(says(Severity::hint, "Fixed regions take effect in Step by step only"));
}

TEST_F(ViewerModelTest, WhatWasSavedIsSavedAgainAfterUndoAndRedo)
{
    const ScratchFolder folder;
    open();
    model.apply(SetThickness{1.5});
    model.apply(SelectFaces{{10, 11}});
    EXPECT_TRUE(document.unsaved);
    model.apply(Undo{});
    EXPECT_TRUE(document.unsaved);
    model.apply(Undo{});
    EXPECT_FALSE(document.unsaved) << "all is taken back";
    model.apply(Redo{});
    EXPECT_TRUE(document.unsaved);
    model.apply(SaveProject{folder / "saved.spia"});
    EXPECT_FALSE(document.unsaved);
    model.apply(Undo{});
    EXPECT_TRUE(document.unsaved) << "the file has the other thickness";
    model.apply(Redo{});
    EXPECT_FALSE(document.unsaved);
    model.apply(Redo{});
    EXPECT_TRUE(document.unsaved);
}

TEST_F(ViewerModelTest, AFirstRunThatIsCancelledLeavesNothingToSaveOrToTakeBack)
{
    open("square-cup.obj");
    model.apply(RunTo{Stage::solve});
    model.apply(CancelJob{});
    wait();
    ASSERT_EQ(document.session.blank, nullptr);
    EXPECT_FALSE(state.document.unsaved);
    EXPECT_EQ(state.history.undo_name(), "");

    model.apply(SetThickness{0.7});
    model.apply(RunTo{Stage::solve});
    model.apply(CancelJob{});
    wait();
    EXPECT_TRUE(state.document.unsaved);
    EXPECT_EQ(state.history.undo_name(), "Change thickness");

    model.apply(RunTo{Stage::solve});
    model.apply(SelectFaces{{3}}); // meanwhile
    model.apply(CancelJob{});
    wait();
    EXPECT_EQ(state.history.undo_name(), "Select faces");
    model.apply(Undo{});
    EXPECT_EQ(state.history.undo_name(), "Unfold");
}

TEST_F(ViewerModelTest, ViewsThatTurnTogetherAreFittedWithOneCameraThatShowsThePartInEach)
{
    const std::pair<View, glm::dvec2> sizes[] = {
        {View::part, {900, 300}}, {View::quads, {320, 500}}, {View::surface, {700, 700}}};
    for (const auto& [view, size] : sizes)
        model.resized(view, size);
    open("square-cup.obj");
    const auto check = [&] {
        const Camera& one = state.view.camera[size_t(View::part)];
        double least_air = 1e9; // pixels beside the part, where there is least
        for (const auto& [view, size] : sizes) {
            EXPECT_EQ(state.view.camera[size_t(view)], one) << name(view);
            const Eigen::Matrix3Xd& place = document.session.part->mesh.position;
            for (Eigen::Index v = 0; v < place.cols(); ++v) {
                const glm::dvec3 pixel = pixel_of(one, place.col(v), size);
                for (int k = 0; k < 2; ++k)
                    least_air = std::min({least_air, pixel[k], size[k] - pixel[k]});
            }
        }
        EXPECT_GT(least_air, 20);
        EXPECT_LT(least_air, 30);
    };
    check();
    model.resized(View::quads, {200, 500}); // narrower: the others follow
    EXPECT_EQ(state.view.camera[size_t(View::surface)], state.view.camera[size_t(View::quads)]);

    ViewSettings apart = state.view;
    apart.linked = false;
    model.apply(SetViewSettings{apart});
    model.apply(FitView{});
    EXPECT_NE(state.view.camera[size_t(View::quads)].height, state.view.camera[size_t(View::part)].height);
}

TEST_F(ViewerModelTest, UndoBringsBackEveryKindOfChangeByItsName)
{
    open();
    const std::pair<Action, std::string> changes[] = {
        {SelectFaces{{5, 3, 3}}, "Select faces"},
        {MakeRegion{"", RegionKind::binder}, "Make region"},
        {SetThickness{0.7}, "Change thickness"},
        {SetMaterial{"dp600"}, "Change material"},
        {AddProbe{{7, {1, 0, 0}}}, "Pin probe"},
        {InvertSelection{}, "Invert selection"},
        {SelectVertices{{9, 4}}, "Select vertices"},
        {ClearSelection{}, "Clear selection"},
        {SetDirection{Eigen::Vector3d(0, 0, 2)}, "Change stamping direction"},
    };
    for (const auto& [action, name] : changes) {
        model.apply(action);
        EXPECT_EQ(state.history.undo_name(), name);
    }
    EXPECT_EQ(document.regions.size(), 1u);
    EXPECT_EQ(document.regions[0].faces, (std::vector<int>{3, 5}));
    for (size_t k = 0; k < std::size(changes); ++k)
        model.apply(Undo{});
    EXPECT_EQ(state.history.undo_name(), "");
    EXPECT_TRUE(document.selected.empty());
    EXPECT_TRUE(document.regions.empty());
    EXPECT_TRUE(document.probes.empty());
    EXPECT_EQ(document.session.options.flatten.thickness, 1);
    EXPECT_EQ(document.material, "mild_steel");
    EXPECT_EQ(document.session.options.flatten.material.young_MPa, 206000);
    EXPECT_FALSE(document.session.options.flatten.direction);
    for (size_t k = 0; k < std::size(changes); ++k)
        model.apply(Redo{});
    EXPECT_EQ(state.history.redo_name(), "");
    EXPECT_EQ(document.material, "dp600");
    EXPECT_EQ(document.probes.size(), 1u);
}

TEST_F(ViewerModelTest, UndoWithNothingToUndoLeavesTheWorkSaved)
{
    open();
    model.apply(Undo{});
    model.apply(Redo{});
    EXPECT_FALSE(state.document.unsaved);
}

TEST_F(ViewerModelTest, AnOldResultIsSaidToBeOldAndKeepsItsOptions)
{
    open();
    EXPECT_EQ(out_of_date(document), "");
    model.apply(RunTo{Stage::solve});
    wait();
    EXPECT_EQ(out_of_date(document), ""); // a step is missing, but what is there is new
    const double before = document.session.options.flatten.thickness;
    model.apply(SetThickness{before / 2});
    EXPECT_NE(out_of_date(document).find("\"Unfold\""), std::string::npos) << "as the panel calls it";
    EXPECT_EQ(as_made(document).options.flatten.thickness, before);
    EXPECT_EQ(as_made(document).blank, document.session.blank);
}

TEST_F(ViewerModelTest, AFirstBlankIsFramedFromItsFirstShapeOn)
{
    open("square-cup.obj");
    model.apply(RunTo{Stage::solve});
    bool seen = false;
    while (model.busy()) {
        model.poll();
        if (state.job.blank && !seen) {
            seen = true;
            const Camera& camera = state.view.camera[size_t(View::blank)];
            const Eigen::Vector2d size = state.job.blank->rowwise().maxCoeff() - state.job.blank->rowwise().minCoeff();
            EXPECT_GT(camera.height, size[1]);
            EXPECT_LT(camera.height, 3 * size.maxCoeff());
        }
    }
    EXPECT_TRUE(seen);
}

TEST_F(ViewerModelTest, AViewThatShowsAllOfThePartStillDoesSoInAnotherSize)
{
    open();
    const auto free = [&](glm::dvec2 size) { // left, right, top, bottom
        std::array<double, 4> result{1e300, 1e300, 1e300, 1e300};
        for (const auto point : document.session.part->mesh.position.colwise()) {
            const glm::dvec2 p = pixel_of(state.view.camera[size_t(View::part)], point, size);
            result = {std::min(result[0], p.x), std::min(result[1], size.x - p.x), std::min(result[2], p.y),
                      std::min(result[3], size.y - p.y)};
        }
        return result;
    };
    for (const glm::dvec2 size : {glm::dvec2(400, 300), {1400, 500}, {500, 1200}}) {
        for (const View view : {View::part, View::quads, View::surface}) // they turn together
            model.resized(view, size);
        const auto [left, right, top, bottom] = free(size);
        EXPECT_GT(left, 90) << "room for the legend";
        EXPECT_NEAR(std::min(right, std::min(top, bottom)), 24, 1e-6);
    }
    Camera& moved = const_cast<Camera&>(state.view.camera[size_t(View::part)]);
    moved.height *= 2;
    const Camera before = moved;
    model.resized(View::part, {800, 600});
    EXPECT_EQ(state.view.camera[size_t(View::part)], before) << "what the user has turned to stays";
}

TEST_F(ViewerModelTest, WhatGoesWrongIsSaidAndChangesNothing)
{
    model.apply(OpenPart{"/no/such/part.stl", ""});
    EXPECT_TRUE(says(Severity::error, "no file"));
    model.apply(InvertSelection{});
    EXPECT_TRUE(says(Severity::error, "Open a part first"));
    open();
    const ScratchFolder folder;
    std::ofstream(folder / "bad.stl") << "solid nothing";
    model.apply(OpenPart{folder / "bad.stl", ""});
    wait();
    EXPECT_TRUE(says(Severity::error, "bad.stl"));
    open();
    model.apply(SetThickness{-1});
    model.apply(SelectFaces{{1000000}});
    model.apply(MakeRegion{});
    model.apply(SetMaterial{"unobtainium"});
    model.apply(SetCorner{0, 0});
    model.apply(ExportFiles{folder / "out", {"iges"}, {}});
    EXPECT_EQ(state.history.undo_name(), "");
    EXPECT_EQ(document.session.options.flatten.thickness, 1);
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    EXPECT_GE(std::count_if(state.messages.begin(), state.messages.end(),
                            [](const Message& m) { return m.severity == Severity::error; }),
              6);
}

TEST_F(ViewerModelTest, AProjectComesBackWithItsPicksAndResults)
{
    const ScratchFolder folder;
    open();
    model.apply(SetThickness{1.5});
    model.apply(SelectFaces{{10, 11, 12}});
    model.apply(MakeRegion{"flange", RegionKind::binder});
    model.apply(RunTo{Stage::grid});
    wait();
    model.apply(SaveProject{folder / "dome.spia"});
    EXPECT_FALSE(state.document.unsaved);
    EXPECT_TRUE(says(Severity::done, "dome.spia"));
    const auto blank = document.session.blank->blank.position;

    ViewerModel other{assets};
    other.apply(OpenProject{folder / "dome.spia"});
    while (other.busy())
        other.poll();
    const Document& back = other.state().document;
    EXPECT_EQ(back.session.options.flatten.thickness, 1.5);
    ASSERT_EQ(back.regions.size(), 1u);
    EXPECT_EQ(back.regions[0].name, "flange");
    EXPECT_EQ(back.regions[0].faces, (std::vector<int>{10, 11, 12}));
    ASSERT_NE(back.session.blank, nullptr);
    EXPECT_TRUE(back.session.blank->blank.position == blank);
    EXPECT_NE(back.session.grid, nullptr);
    EXPECT_EQ(back.session.surface, nullptr);
}

TEST_F(ViewerModelTest, ExportsInTheBackground)
{
    const ScratchFolder folder;
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    model.apply(ExportFiles{folder / "out", {"iges", "csv"}, {}});
    EXPECT_TRUE(model.busy());
    wait();
    for (const char* file : {"dome.iges", "fields.csv", "outline.csv"})
        EXPECT_TRUE(std::filesystem::exists(folder / "out" / file)) << file;
    EXPECT_TRUE(says(Severity::done, "dome.iges"));
    // Why an export failed is of the past with the next one.
    const auto failures = [&] {
        return std::ranges::count_if(state.messages,
                                     [](const Message& m) { return m.shown() && m.severity == Severity::error; });
    };
    model.apply(ExportFiles{folder / "out" / "dome.iges", {"iges"}, {}}); // a file is no folder
    wait();
    EXPECT_EQ(failures(), 1);
    model.apply(ExportFiles{folder / "out", {"iges"}, {}});
    wait();
    EXPECT_EQ(failures(), 0);
}

TEST_F(ViewerModelTest, AProjectWhosePartHasGoneTellsWhereItWas)
{
    const ScratchFolder folder;
    const auto gone = folder / "gone.obj";
    std::filesystem::copy_file(assets / "parts" / "dome.obj", gone);
    model.apply(OpenPart{gone, ""});
    wait();
    model.apply(SaveProject{folder / "gone.spia"});
    std::filesystem::remove(gone);
    for (const bool beside_another : {false, true}) {
        if (beside_another)
            open("square-cup.obj");
        model.apply(OpenProject{folder / "gone.spia"});
        wait();
        EXPECT_TRUE(says(Severity::error, gone.string() + " no longer exists"));
        EXPECT_TRUE(says(Severity::error, beside_another ? "square-cup.obj is still open" : "stays as it is"));
        EXPECT_NE(document.session.part, nullptr);
    }
}

TEST_F(ViewerModelTest, APartThatHasMovedIsOpenedWithTheSettingsOfItsProject)
{
    const ScratchFolder folder;
    const auto old = folder / "old.obj", moved = folder / "elsewhere.obj", project = folder / "a.spia";
    std::filesystem::copy_file(assets / "parts" / "dome.obj", old);
    model.apply(OpenPart{old, ""});
    wait();
    model.apply(SetThickness{2.5});
    model.apply(SelectFaces{{3, 5}});
    model.apply(MakeRegion{"binder", RegionKind::fixed});
    model.apply(SaveProject{project});
    std::filesystem::rename(old, moved);
    for (const bool other : {false, true}) {
        open("square-cup.obj");
        model.apply(OpenProject{project});
        wait();
        EXPECT_EQ(document.session.file.filename(), "square-cup.obj");
        EXPECT_TRUE(says(Severity::error, "open it from where it is now"));
        model.apply(OpenPart{other ? assets / "parts" / "square-cup.obj" : moved, ""});
        wait();
        ASSERT_NE(document.session.part, nullptr);
        if (other) { // is no reason to take the settings for
            EXPECT_EQ(document.session.file.filename(), "square-cup.obj");
            EXPECT_EQ(state.project, "");
            EXPECT_TRUE(document.regions.empty());
            EXPECT_TRUE(says(Severity::hint, "put the part back at " + old.string()));
            continue;
        }
        EXPECT_EQ(document.session.file, moved);
        EXPECT_EQ(document.session.options.flatten.thickness, 2.5);
        ASSERT_EQ(document.regions.size(), 1u);
        EXPECT_EQ(document.regions[0].faces, (std::vector{3, 5}));
        EXPECT_EQ(state.project, project);
        EXPECT_TRUE(state.document.unsaved) << "the project is to say where its part is";
        EXPECT_TRUE(says(Severity::hint, "Save the project to keep that"));
    }
    // Another part that is opened later has nothing to do with it.
    model.apply(OpenPart{moved, ""});
    wait();
    EXPECT_TRUE(document.regions.empty());
    EXPECT_EQ(state.project, "");
}

TEST_F(ViewerModelTest, AFileThatIsNotThereDoesNotDisturbARun)
{
    open("square-cup.obj");
    model.apply(RunTo{Stage::fit});
    model.apply(OpenPart{"/no/such/part.stl", ""});
    model.apply(OpenProject{"/no/such/project.spia"});
    EXPECT_TRUE(model.busy());
    wait();
    EXPECT_NE(document.session.surface, nullptr);
    EXPECT_FALSE(state.job.running);
    model.apply(RunTo{Stage::fit}); // while another part is opened, the run is for that one
    model.apply(OpenPart{assets / "parts" / "dome.obj", ""});
    model.apply(RunTo{Stage::solve});
    wait();
    EXPECT_EQ(document.session.file.filename(), "dome.obj");
    EXPECT_NE(document.session.blank, nullptr);
}

TEST_F(ViewerModelTest, TheUnitCanBeChangedAndTakenBack)
{
    open();
    const auto size = [&] { return document.session.part->mesh.position.cwiseAbs().maxCoeff(); };
    const double mm = size();
    model.apply(SetUnit{"mm"}); // as it is
    model.apply(SetUnit{"cm"});
    wait();
    EXPECT_NEAR(size(), 10 * mm, 1e-9);
    EXPECT_EQ(state.history.undo_name(), "Change unit");
    model.apply(RunTo{Stage::solve});
    wait();
    EXPECT_NE(document.session.blank, nullptr);
    model.apply(Undo{});
    model.apply(Undo{});
    EXPECT_NEAR(size(), mm, 1e-9);
}

TEST_F(ViewerModelTest, EndsAtOnceWhileAJobRuns)
{
    open("square-cup.obj");
    model.apply(RunTo{Stage::fit}); // the destructor cancels it
}

} // namespace spia::viewer
