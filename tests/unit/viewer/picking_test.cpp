#include "app/viewer/model/jobs/viewer_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "app/viewer/model/actions/names.h"
#include "app/viewer/model/picking/pickers.h"
#include "app/viewer/views/views.h"
#include "engine/mesh/topology.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {

using Picking = ModelFixture;

TEST_F(Picking, TheWholePartIsNotFixed)
{
    open();
    model.apply(SelectFaces{{}});
    model.apply(InvertSelection{});
    ASSERT_EQ(int(document.selected.size()), document.session.part->mesh.triangles());
    model.apply(MakeRegion{"all", RegionKind::fixed});
    EXPECT_TRUE(document.regions.empty());
    EXPECT_TRUE(says(Severity::error, "Select one flat side"));
    model.apply(MakeRegion{"all", RegionKind::binder});
    ASSERT_EQ(document.regions.size(), 1u);
    model.apply(ChangeRegion{0, "all", RegionKind::fixed, {}});
    EXPECT_EQ(document.regions[0].kind, RegionKind::binder);
}

TEST_F(Picking, PicksStayOnTheirFacesHoweverReadingThePartAgainEnds)
{
    open();
    const Eigen::Vector3d there =
        document.session.part->mesh.position.col(document.session.part->mesh.triangle(0, 100));
    const auto still_there = [&] {
        const TriMesh& mesh = document.session.part->mesh;
        return document.selected.size() == 1 &&
               mesh.position.col(mesh.triangle(0, document.selected[0])).isApprox(there, 1e-9);
    };
    model.apply(SelectFaces{{100}, PickMode::replace});
    model.apply(MakeRegion{"clamp", RegionKind::binder});
    model.apply(SetReading{{true, true}});
    EXPECT_EQ(document.regions.size(), 1u); // so a project that is saved now has it
    model.apply(SelectFaces{{100, 200}, PickMode::replace});
    model.apply(CancelJob{});
    wait();
    EXPECT_EQ(document.regions.size(), 1u);
    model.apply(RunTo{Stage::solve}); // reads it after all
    wait();
    EXPECT_EQ(document.regions.size(), 1u);
    ASSERT_NE(document.session.blank, nullptr);
    while (!still_there() && !state.history.undo_name().empty())
        model.apply(Undo{});
    EXPECT_TRUE(still_there());
}

TEST_F(Picking, EveryPickingToolTakesFacesAndSaysNothing)
{
    open();
    model.resized(View::part, {800, 600});
    model.apply(LookFrom{View::part, StandardView::top});
    model.apply(FitView{});
    const glm::dvec2 size(800, 600), middle(400, 300);
    model.apply(PickAt{View::part, middle, size, PickMode::replace, {}, false});
    EXPECT_EQ(document.selected.size(), 1u);
    model.apply(GrowSelection{});
    const size_t ring = document.selected.size();
    EXPECT_GT(ring, 6u);
    model.apply(ShrinkSelection{});
    EXPECT_EQ(document.selected.size(), 1u);
    model.apply(PickAt{View::part, middle, size, PickMode::replace, 5., false});
    EXPECT_GT(document.selected.size(), ring);
    model.apply(PickAt{View::part, middle, size, PickMode::replace, {}, true});
    EXPECT_GT(document.selected.size(), ring);
    model.apply(PickArea{View::part, {{0, 0}, {800, 0}, {800, 600}, {0, 600}}, size, PickMode::replace, true});
    EXPECT_EQ(int(document.selected.size()), document.session.part->mesh.triangles());
    const Eigen::Vector3d centre = document.session.part->mesh.position.rowwise().mean();
    const double half =
        // the part lies beside the cube
        pixel_of(state.view.camera[size_t(View::part)], centre, size).x;
    model.apply(PickArea{View::part, {{0, 0}, {half, 0}, {half, 600}, {0, 600}}, size, PickMode::remove, true});
    EXPECT_NEAR(double(document.selected.size()), document.session.part->mesh.triangles() / 2.,
                document.session.part->mesh.triangles() * 0.1);
    model.apply(PickBrush{View::part, middle, 30, size, PickMode::add, false});
    model.apply(PickAt{View::part, {1, 1}, size, PickMode::replace, {}, false}); // nothing there
    EXPECT_TRUE(document.selected.empty());
    EXPECT_TRUE(state.messages.empty());
}

TEST_F(Picking, VerticesArePickedInEveryViewAndUndoneByName)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    const glm::dvec2 size(800, 600);
    const Eigen::Matrix3Xd& on_part = document.session.part->mesh.position;
    const int top = document.session.grid->boundary.corner[2];
    for (const View view : all_views) {
        const Eigen::Matrix2Xd& flat = document.session.blank->blank.position;
        const Eigen::Vector3d at =
            view == View::blank ? Eigen::Vector3d(flat(0, top), flat(1, top), 0) : Eigen::Vector3d(on_part.col(top));
        const glm::dvec2 pixel(pixel_of(state.view.camera[size_t(view)], at, size));
        for (const bool boundary : {false, true}) {
            model.apply(ClearSelection{});
            model.apply(PickVertex{view, pixel, size, PickMode::replace, boundary, 3});
            EXPECT_EQ(document.vertices, std::vector<int>{top});
            EXPECT_EQ(state.history.undo_name(), boundary ? "Pick boundary vertex" : "Pick vertex");
        }
        ViewSettings settings = state.view;
        settings.tool = Tool::vertex;
        model.apply(SetViewSettings{settings});
        model.hover(view, pixel, size);
        EXPECT_EQ(state.hovered_vertex, top);
        settings.tool = Tool::pick;
        model.apply(SetViewSettings{settings});
        model.hover(view, pixel, size);
        EXPECT_FALSE(state.hovered_vertex);
    }
    model.apply(SelectVertices{{3, 1}, PickMode::add});
    model.apply(SelectVertices{{top}, PickMode::remove});
    EXPECT_EQ(document.vertices, (std::vector<int>{1, 3}));
    model.apply(Undo{});
    model.apply(Undo{});
    EXPECT_EQ(document.vertices, std::vector<int>{top});
    model.apply(PickVertex{View::part, {1, 1}, size, PickMode::add, false, 2}); // nothing there
    EXPECT_EQ(document.vertices, std::vector<int>{top});
    const auto selected = document.selected;
    model.apply(FlyToVertex{top});
    const glm::dvec2 middle(pixel_of(state.view.camera[0], on_part.col(top), size));
    EXPECT_NEAR(glm::length(middle - size / 2.), 0, 1e-6);
    EXPECT_EQ(document.selected, selected);
    EXPECT_TRUE(std::none_of(state.messages.begin(), state.messages.end(),
                             [](const Message& m) { return m.severity == Severity::error; }));
    model.apply(SelectVertices{{1, int(on_part.cols())}});
    EXPECT_TRUE(says(Severity::error, fmt::format("no vertex {}", on_part.cols())));
    EXPECT_EQ(document.vertices, std::vector<int>{top});
}

TEST_F(Picking, TakingBackAPickMadeDuringARunKeepsTheResult)
{
    open("square-cup.obj");
    model.apply(RunTo{Stage::fit});
    model.apply(SelectFaces{{1, 2, 3}});
    wait();
    ASSERT_NE(document.session.surface, nullptr);
    const auto blank = document.session.blank;
    model.apply(Undo{});
    EXPECT_TRUE(document.selected.empty());
    EXPECT_EQ(document.session.blank, blank);
    model.apply(Undo{}); // the run itself
    EXPECT_EQ(document.session.blank, nullptr);
    model.apply(Redo{});
    EXPECT_EQ(document.session.blank, blank);
}

TEST_F(Picking, DrawsASectionAndGoesToAFaceInWaysThatCanBeTakenBack)
{
    open();
    model.apply(LookFrom{View::part, StandardView::top});
    model.apply(FitView{});
    const glm::dvec2 size(800, 600);
    model.apply(DrawSection{View::part, {100, 300}, {700, 300}, size});
    ASSERT_TRUE(document.section);
    EXPECT_NEAR(document.section->from[1], document.section->to[1], 1e-9);
    EXPECT_GT((document.section->to - document.section->from).norm(), 100);
    model.apply(DrawSection{View::part, {1, 1}, {2, 2}, size}); // beside the part
    EXPECT_TRUE(says(Severity::error, "across the sheet"));
    model.apply(DrawSection{View::blank, {1, 1}, {2, 2}, size});
    EXPECT_TRUE(says(Severity::error, "Unfold the part first"));
    model.apply(SelectFaces{{4, 5}});
    const auto cameras = state.view.camera;
    model.apply(FlyTo{9});
    EXPECT_EQ(document.selected, (std::vector<int>{4, 5})) << "what is selected is the user's";
    ASSERT_TRUE(state.spot);
    EXPECT_EQ(state.spot->face, 9);
    EXPECT_NE(state.view.camera, cameras);
    model.apply(FlyTo{12});
    model.apply(HideSpot{});
    EXPECT_FALSE(state.spot);
    EXPECT_EQ(state.view.camera, cameras) << "back past both spots";
    model.apply(FlyTo{9});
    model.apply(LookFrom{View::part, StandardView::front}); // moved since: it stays
    const auto moved = state.view.camera;
    model.apply(HideSpot{});
    EXPECT_EQ(state.view.camera[size_t(View::part)], moved[size_t(View::part)]);
    model.apply(Undo{});
    model.apply(Undo{});
    EXPECT_FALSE(document.section);
}

TEST_F(Picking, AFaceThatIsFlownToIsSeenAmongTwelve)
{
    open("inner-panel.obj");
    model.apply(FitView{});
    const TriMesh& mesh = document.session.part->mesh;
    const auto longest_of = [&](int f) {
        const Eigen::Matrix3d corner = mesh.position(Eigen::all, mesh.triangle.col(f));
        return std::max({(corner.col(0) - corner.col(1)).norm(), (corner.col(1) - corner.col(2)).norm(),
                         (corner.col(2) - corner.col(0)).norm()});
    };
    int face = 0;
    for (int f = 0; f < mesh.triangles(); ++f)
        if (longest_of(f) < longest_of(face))
            face = f;
    const double longest = longest_of(face);
    ASSERT_LT(12 * longest, 0.15 * bounding_diagonal(mesh)) << "or the size of the part counts";
    model.apply(FlyTo{face});
    EXPECT_NEAR(state.view.camera[size_t(View::part)].height, 12 * longest, 1e-9);
}

TEST_F(Picking, AViewOnItsWayIsNotFittedAgain)
{
    open();
    model.resized(View::part, {400, 300});
    model.apply(FitView{});
    const Camera begin = state.view.camera[size_t(View::part)];
    model.views_glide(true);               // and is at its first moment where it was fitted
    model.resized(View::part, {300, 300}); // as a wider legend leaves it
    EXPECT_EQ(state.view.camera[size_t(View::part)], begin);
    model.views_glide(false);
    model.resized(View::part, {250, 300});
    EXPECT_NE(state.view.camera[size_t(View::part)], begin) << "it follows again where it is back";
}

TEST_F(Picking, ViewsThatShowNothingHaveNothingToPick)
{
    open();
    Pickers pickers;
    const auto anything = [&](View view) { return pickers.mesh(document.session, view) != nullptr; };
    EXPECT_TRUE(anything(View::part));
    for (const View view : {View::blank, View::quads, View::surface})
        EXPECT_FALSE(anything(view)) << name(view);
    model.apply(RunTo{Stage::fit});
    wait();
    for (const View view : all_views)
        EXPECT_TRUE(anything(view)) << name(view);
}

} // namespace spia::viewer
