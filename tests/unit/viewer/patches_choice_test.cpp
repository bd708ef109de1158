#include <gtest/gtest.h>

#include "app/viewer/model/actions/cut_order.h"
#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/project_file.h"
#include "app/viewer/views/views.h"
#include "engine/core/error.h"
#include "engine/core/json_file.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {

class PatchesChoice : public ModelFixture {
protected:
    void make_patches(const char* part = "perforated-channel.obj")
    {
        open(part);
        model.apply(RunTo{Stage::fit});
        wait();
        model.apply(SetPatches{LayoutOptions{}});
        wait();
        ASSERT_TRUE(document.session.surface->patches);
    }
    bool shows(View view)
    {
        SceneCache cache;
        return scene(view, state, cache).empty.empty();
    }
};

TEST_F(PatchesChoice, TakeThePlaceOfTheOnePatchAndUndoBringsItBack)
{
    make_patches();
    const std::shared_ptr<const SurfaceStage> made = document.session.surface;
    EXPECT_FALSE(first_stale(document));
    EXPECT_GE(made->patches->patches.patch.size(), 9u);
    EXPECT_EQ(made->certificate.patch.size(), made->patches->patches.patch.size());
    EXPECT_TRUE(made->certificate.leak.empty());
    EXPECT_TRUE(shows(View::quads) && shows(View::surface));
    for (const View view : all_views)
        EXPECT_FALSE(is_old(state, view));

    model.apply(Undo{});
    EXPECT_FALSE(document.session.options.patches);
    EXPECT_FALSE(document.session.surface->patches);
    EXPECT_FALSE(first_stale(document));
    model.apply(Redo{});
    EXPECT_TRUE(document.session.options.patches);

    model.apply(RunTo{Stage::fit});
    wait();
    EXPECT_TRUE(document.session.surface->patches);
    model.apply(SetPatches{});
    wait();
    EXPECT_FALSE(document.session.surface->patches);
    EXPECT_FALSE(first_stale(document));
}

TEST_F(PatchesChoice, AnotherToleranceMakesThemAnewAndTheGridDoesNot)
{
    make_patches();
    FitChoice fit = fit_choice(document.session.options);
    fit.tolerance = 0.1;
    model.apply(SetFit{fit});
    wait();
    ASSERT_TRUE(document.session.surface->patches);
    EXPECT_EQ(document.session.surface->fit->tolerance, 0.1);
    EXPECT_LE(document.session.surface->deviation.max(), 0.1);
    EXPECT_FALSE(first_stale(document));
    model.apply(SetGrid{GridOptions{.cells = 20}});
    EXPECT_FALSE(first_stale(document));
}

TEST_F(PatchesChoice, CornersOfTheOnePatchAreRefusedWithAdvice)
{
    make_patches();
    model.apply(SetCorner{0, 0, false});
    EXPECT_TRUE(says(Severity::error, "choose \"One patch\""));
    EXPECT_FALSE(document.session.options.corners);
}

TEST_F(PatchesChoice, ACutThroughPickedVerticesMakesTwoPatchesAndGoesAgain)
{
    open("fender.obj");
    model.apply(RunTo{Stage::solve});
    wait();
    const std::vector<int>& outline = model.pickers().outline(document.session);
    const Eigen::Matrix2Xd& plane = document.session.blank->blank.position;
    int top = outline[0], bottom = outline[0];
    for (const int v : outline) { // the two ends of a line across the middle
        const double middle = (plane.row(0).minCoeff() + plane.row(0).maxCoeff()) / 2;
        const auto off = [&](int w) { return std::abs(plane(0, w) - middle); };
        const bool high = plane(1, v) > (plane.row(1).minCoeff() + plane.row(1).maxCoeff()) / 2;
        int& best = high ? top : bottom;
        const bool same_half = (plane(1, best) > (plane.row(1).minCoeff() + plane.row(1).maxCoeff()) / 2) == high;
        if (!same_half || off(v) < off(best))
            best = v;
    }
    model.apply(SelectVertices{{top, bottom}});
    model.apply(AddCut{});
    wait();
    ASSERT_TRUE(document.session.options.patches);
    ASSERT_EQ(document.session.options.patches->cuts.size(), 1u);
    EXPECT_TRUE(document.vertices.empty());
    ASSERT_TRUE(document.session.surface && document.session.surface->patches);
    EXPECT_GE(document.session.surface->patches->patches.patch.size(), 2u);
    EXPECT_FALSE(document.session.surface->patches->patches.interfaces.empty());

    model.apply(RemoveCut{3});
    EXPECT_TRUE(says(Severity::error, "no cut 4"));
    model.apply(RemoveCut{0});
    wait();
    EXPECT_TRUE(document.session.options.patches->cuts.empty());
}

TEST_F(PatchesChoice, AreKeptWithTheProject)
{
    make_patches();
    const ScratchFolder folder;
    LayoutOptions patches;
    patches.cuts = {{3, 8}};
    patches.edge_deg = 30;
    model.apply(SetPatches{patches});
    model.apply(CancelJob{});
    wait();
    model.apply(Redo{}); // with its run the choice was taken back
    wait();
    model.apply(SaveProject{folder / "a.spia"});
    wait();
    const Project project = open_project(folder / "a.spia", assets / "materials");
    ASSERT_TRUE(project.document.session.options.patches);
    EXPECT_EQ(*project.document.session.options.patches, patches);
}

TEST_F(PatchesChoice, AnOlderProjectsColoursOfTheSurfaceAreUnderstood)
{
    open();
    const ScratchFolder folder;
    for (const bool coloured : {true, false}) {
        model.apply(SaveProject{folder / "a.spia"});
        wait();
        Json json = read_json(folder / "a.spia");
        json["view"].erase("surface_look");
        json["view"]["surface_deviation"] = coloured;
        put(folder / "a.spia", json.dump());
        EXPECT_EQ(open_project(folder / "a.spia", assets / "materials").view.surface_look,
                  coloured ? SurfaceLook::deviation : SurfaceLook::plain);
    }
}

TEST(CutThrough, GoesFromOneEndToTheOtherWhateverTheOrderOfPicking)
{
    const TriMesh sheet = shapes::rectangle(60, 40, 6, 4); // vertex i + 7 j at (10 i, 10 j)
    const Eigen::Matrix2Xd plane = sheet.position.topRows<2>();
    const std::vector<int> none;
    EXPECT_EQ(cut_through(sheet, plane, {3, 10, 24, 31}, none), (LayoutCut{3, 10, 24, 31}));
    EXPECT_EQ(cut_through(sheet, plane, {31, 24, 3, 10}, none), (LayoutCut{31, 24, 10, 3}));
    EXPECT_THROW(cut_through(sheet, plane, {3}, none), InputError);
    std::vector<int> number(size_t(sheet.vertices()));
    number[10] = 77;
    try {
        cut_through(sheet, plane, {3, 10}, number);
        FAIL() << "an end inside the sheet";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("vertex 77"), std::string::npos) << error.what();
    }
}

} // namespace spia::viewer
