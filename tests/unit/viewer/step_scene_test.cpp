// What is shown of unfolding step by step, and picked there.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

#include "app/viewer/views/palette.h"
#include "app/viewer/views/step_scene.h"
#include "app/viewer/views/views.h"
#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

using StepStatus::done;
using testing::HasSubstr;

} // namespace

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

TEST_F(UnfoldingSteps, TheTargetIsShownBeforeItsStepIsRun)
{
    open_channel();
    const double below = document.session.part->mesh.position.row(2).minCoeff();
    propose(with_height(below - 1e-6, below + 1e-6)[0]); // the other leg, the web, and all onto
                                                         // this one
    ASSERT_EQ(document.steps.size(), 2u);
    SceneCache cache;
    const auto target = [&]() -> std::optional<Eigen::Matrix3Xd> {
        const Scene scene = part_scene(state, cache);
        if (scene.layers.size() < 2)
            return std::nullopt;
        const SceneMesh& mesh = *scene.layers[1].mesh;
        return mesh.position.cast<double>().colwise() + mesh.origin;
    };
    model.apply(ShowStep{0, {}});
    auto patch = target();
    ASSERT_TRUE(patch);
    const TriMesh& part = document.session.part->mesh;
    // In the plane of what carries it, and as far out as what unfolds may reach.
    const Eigen::Matrix3d carrying =
        part.position(Eigen::all, part.triangle.col(carrying_faces(*document.steps[0])[0]));
    const Eigen::Vector3d normal =
        (carrying.col(1) - carrying.col(0)).cross(carrying.col(2) - carrying.col(0)).normalized();
    EXPECT_LT((normal.transpose() * (patch->colwise() - carrying.col(0))).cwiseAbs().maxCoeff(), 1e-3);
    double height = 0;
    for (const int f : document.steps[0]->pick.freed)
        for (const int v : part.triangle.col(f))
            height = std::max(height, std::abs(normal.dot(part.position.col(v) - carrying.col(0))));
    const auto length = [](const Eigen::Matrix3Xd& x) {
        return (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();
    };
    EXPECT_GT(length(*patch), 80 + 2 * height);
    // One's own, wherever it is; its offset moves it.
    ChangeStep change = change_of(0);
    change.target = StepTarget{.plane = TargetPlane{{0, 0, 4}, {0, 0, 1}}};
    model.apply(change);
    patch = target();
    ASSERT_TRUE(patch);
    EXPECT_LT((patch->row(2).array() - 4).abs().maxCoeff(), 1e-3);
    change.offset_mm = 2.5;
    model.apply(change);
    EXPECT_LT((target()->row(2).array() - 6.5).abs().maxCoeff(), 1e-3);
    // What carries a later one may still move.
    model.apply(ShowStep{1, {}});
    EXPECT_FALSE(target());
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
    EXPECT_THAT(last(Severity::error), HasSubstr("shown between two steps"));
    EXPECT_EQ(document.selected, before);
    model.apply(DrawSection{View::part, {0, 300}, {800, 300}, {800, 600}});
    EXPECT_THAT(last(Severity::error), HasSubstr("back to the part"));
}

TEST(TargetPatch, LiesOnItsFaceAndReachesBeyondWhatLiesOnIt)
{
    const CylinderFace cylinder{{1, 2, 3}, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), 10, true};
    HeightFace height{{0, 0, 5}, Eigen::Matrix3d::Identity().leftCols<2>(), {-20, -20}, 10, Eigen::MatrixXd(9, 9)};
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j)
            height.coefficient(i, j) = 0.1 * i * j;
    for (const TargetSurface& face : {TargetSurface(cylinder), TargetSurface(height)}) {
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
        const TriMesh ended = patch_around(face, places, 2.5);
        Eigen::AlignedBox2d end;
        for (const auto x : ended.position.colwise())
            end.extend(developed(face, x));
        EXPECT_NEAR(end.min()[1], -2.5, 1e-6);
        EXPECT_NEAR(end.max()[0], 6 + 2.5, 1e-6);
    }
}

} // namespace spia::viewer
