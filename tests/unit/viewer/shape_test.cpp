#include <gtest/gtest.h>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/project_file.h"
#include "app/viewer/model/picking/handles.h"
#include "app/viewer/views/views.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {

class Shape : public ModelFixture {
protected:
    void finish(const char* part = "dome.obj")
    {
        open(part);
        model.apply(RunTo{Stage::fit});
        wait();
        ASSERT_TRUE(document.session.surface);
    }
    Eigen::Vector3d control(int handle) const
    {
        return handle_positions(document.session, HandleKind::control).col(handle);
    }
};

TEST_F(Shape, APickedControlPointMovesAndUndoTakesItBack)
{
    finish();
    const Eigen::Vector3d before = control(30);
    model.apply(SelectHandles{HandleKind::control, {30}});
    model.apply(MoveHandles{HandleKind::control, {1, 2, 3}});
    EXPECT_EQ(control(30), before + Eigen::Vector3d(1, 2, 3));
    ASSERT_TRUE(document.session.deformed);
    EXPECT_NEAR(document.session.deformed->result.largest, std::sqrt(14.), 1e-12);
    EXPECT_EQ(document.session.deformed->certificate.patch.size(), 1u);
    EXPECT_FALSE(first_stale(document)) << "no stage has to run again";
    EXPECT_TRUE(state.document.unsaved);
    model.apply(Undo{});
    EXPECT_FALSE(document.session.deformed);
    EXPECT_EQ(control(30), before);
    model.apply(Redo{});
    EXPECT_EQ(control(30), before + Eigen::Vector3d(1, 2, 3));
}

TEST_F(Shape, ADragIsOneChangeAndIsJudgedAtItsEnd)
{
    finish();
    const Eigen::Vector3d before = control(30);
    model.apply(SelectHandles{HandleKind::control, {30, 31}});
    for (int k = 0; k < 5; ++k)
        model.apply(MoveHandles{HandleKind::control, {0, 0, 0.5}, true});
    EXPECT_TRUE(state.shape_dragged);
    EXPECT_TRUE(document.session.deformed->certificate.patch.empty());
    model.apply(MoveHandles{HandleKind::control, {0, 0, 0}, false});
    EXPECT_FALSE(state.shape_dragged);
    EXPECT_FALSE(document.session.deformed->certificate.patch.empty());
    EXPECT_NEAR(control(30).z(), before.z() + 2.5, 1e-12);
    EXPECT_EQ(document.session.options.deformation->moves.size(), 2u);
    model.apply(Undo{});
    EXPECT_EQ(control(30), before);
}

TEST_F(Shape, ALatticeBendsTheSurfaceAndGoesAgain)
{
    finish();
    model.apply(MoveHandles{HandleKind::lattice, {0, 0, 1}});
    EXPECT_TRUE(says(Severity::error, "Pick lattice points"));
    model.apply(SetLattice{LatticeChoice{{3, 3, 2}, {2, 2, 1}}});
    ASSERT_TRUE(document.session.options.deformation);
    EXPECT_EQ(state.view.handles, HandleKind::lattice);
    EXPECT_EQ(handle_positions(document.session, HandleKind::lattice).cols(), 18);
    const Eigen::Matrix3Xd before = handle_positions(document.session, HandleKind::control);
    std::vector<int> all(18);
    for (int k = 0; k < 18; ++k)
        all[size_t(k)] = k;
    model.apply(SelectHandles{HandleKind::lattice, all});
    model.apply(MoveHandles{HandleKind::lattice, {4, 0, -2}});
    const Eigen::Matrix3Xd after = handle_positions(document.session, HandleKind::control);
    EXPECT_LT(((after - before).colwise() - Eigen::Vector3d(4, 0, -2)).cwiseAbs().maxCoeff(), 1e-11);
    model.apply(ResetHandles{HandleKind::lattice});
    EXPECT_EQ(handle_positions(document.session, HandleKind::control), before);
    model.apply(SetLattice{});
    EXPECT_FALSE(document.session.options.deformation);
    EXPECT_FALSE(document.session.deformed);
}

TEST_F(Shape, SharedControlPointsOfPatchesMoveTogether)
{
    finish("perforated-channel.obj");
    model.apply(SetPatches{LayoutOptions{}});
    wait();
    const MultiPatch& patches = document.session.surface->patches->patches;
    const SharedControls shared = shared_controls(patches);
    const PatchInterface joint = patches.interfaces.at(0);
    const int control = side_controls(patches.patch[size_t(joint.first.patch)], joint.first.side)[1];
    model.apply(SelectHandles{HandleKind::control, {shared.of(joint.first.patch, control)}});
    model.apply(MoveHandles{HandleKind::control, {0.01, 0.02, 0.03}});
    EXPECT_NO_THROW(require_watertight(document.session.deformed->result.patches));
    EXPECT_TRUE(document.session.deformed->certificate.leak.empty());
}

TEST_F(Shape, AnotherFitTakesMovesOfControlPointsBackAndKeepsTheLattice)
{
    finish();
    model.apply(SelectHandles{HandleKind::control, {30}});
    model.apply(MoveHandles{HandleKind::control, {0, 0, 1}});
    model.apply(SetLattice{LatticeChoice{}});
    model.apply(SelectHandles{HandleKind::lattice, {0}});
    model.apply(MoveHandles{HandleKind::lattice, {0, 0, 5}});
    FitChoice fit = fit_choice(document.session.options);
    fit.tolerance = 0.2;
    model.apply(SetFit{fit});
    wait();
    EXPECT_TRUE(says(Severity::warning, "moved control points were reset"));
    ASSERT_TRUE(document.session.options.deformation);
    EXPECT_TRUE(document.session.options.deformation->moves.empty());
    EXPECT_EQ(document.session.options.deformation->lattice->move(2, 0), 5);
    ASSERT_TRUE(document.session.deformed);
    EXPECT_TRUE(document.controls.empty());
    model.apply(Undo{}); // the fit
    EXPECT_EQ(document.session.options.deformation->moves.size(), 1u);
    EXPECT_TRUE(document.session.deformed);
}

TEST_F(Shape, IsKeptWithTheProjectAndLeavesTheProgram)
{
    finish();
    model.apply(SelectHandles{HandleKind::control, {30}});
    model.apply(MoveHandles{HandleKind::control, {0, 0, 1}});
    model.apply(SetLattice{LatticeChoice{{4, 3, 2}, {3, 2, 1}}});
    model.apply(SelectHandles{HandleKind::lattice, {5}});
    model.apply(MoveHandles{HandleKind::lattice, {1, 0, 2}});
    const Deformation made = *document.session.options.deformation;
    const Eigen::Matrix3Xd shape = handle_positions(document.session, HandleKind::control);
    const ScratchFolder folder;
    model.apply(SaveDeformation{folder / "d.json"});
    model.apply(SaveProject{folder / "a.spia"});
    wait();
    EXPECT_EQ(*open_project(folder / "a.spia", assets / "materials").document.session.options.deformation, made);
    model.apply(OpenProject{folder / "a.spia"});
    wait();
    ASSERT_TRUE(document.session.deformed);
    EXPECT_LT((handle_positions(document.session, HandleKind::control) - shape).cwiseAbs().maxCoeff(), 1e-9);
    model.apply(ResetHandles{HandleKind::control});
    model.apply(OpenDeformation{folder / "d.json"});
    EXPECT_EQ(*document.session.options.deformation, made);
}

TEST_F(Shape, AClickTakesTheHandleInFrontAndADragFollowsTheMouse)
{
    finish();
    const glm::dvec2 size{800, 600};
    for (const bool perspective : {false, true}) {
        ViewSettings view = state.view;
        view.camera[size_t(View::surface)].perspective = perspective;
        model.apply(SetViewSettings{view});
        const Camera& camera = state.view.camera[size_t(View::surface)];
        const Eigen::Matrix3Xd place = handle_positions(document.session, HandleKind::control);
        const glm::dvec3 pixel = pixel_of(camera, place.col(77), size);
        model.apply(PickHandle{HandleKind::control, glm::dvec2(pixel) + glm::dvec2(0.2, -0.1), size});
        ASSERT_EQ(document.controls.size(), 1u);
        const int found = document.controls[0];
        EXPECT_LT(glm::length(glm::dvec2(pixel_of(camera, place.col(found), size)) - glm::dvec2(pixel)), 1.5);
        const Eigen::Vector3d there = place_beside(camera, place.col(found), {30, -20}, size);
        const glm::dvec3 from = pixel_of(camera, place.col(found), size), to = pixel_of(camera, there, size);
        EXPECT_NEAR(to.x, from.x + 30, 1e-6);
        EXPECT_NEAR(to.y, from.y - 20, 1e-6);
        EXPECT_NEAR(to.z, from.z, 1e-9);
        model.apply(PickHandle{HandleKind::control, {-500, -500}, size});
        EXPECT_TRUE(document.controls.empty());
    }
}

TEST_F(Shape, WhatIsPickedAndTheLatticeAreSeen)
{
    finish();
    ViewSettings view = state.view;
    view.tool = Tool::shape;
    view.control_net = false;
    model.apply(SetViewSettings{view});
    const auto points = [&] {
        SceneCache cache;
        Eigen::Index count = 0;
        for (const auto& each : scene(View::surface, state, cache).points)
            count += each->point.cols();
        return count;
    };
    EXPECT_EQ(points(), 0);
    model.apply(SelectHandles{HandleKind::control, {3, 4, 5}});
    EXPECT_EQ(points(), 3);
    model.apply(SetLattice{LatticeChoice{{4, 3, 2}, {3, 2, 1}}});
    EXPECT_EQ(points(), 24);
    model.apply(SelectHandles{HandleKind::lattice, {1}});
    EXPECT_EQ(points(), 25);
}

} // namespace spia::viewer
