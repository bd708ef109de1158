#include "app/viewer/model/picking/clip_plane.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>

#include "app/viewer/model/picking/picking.h"
#include "app/viewer/model/picking/vertex_picking.h"
#include "app/viewer/views/views.h"
#include "engine/core/json_file.h"
#include "tests/support/shapes.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {
namespace {

using Eigen::Vector3d;

const glm::dvec2 view_size(800, 600), middle(400, 300);

/// Two plates, square to z, at heights 0 (faces 0, 1) and 10 (faces 2, 3); x and y from -20 to 20.
TriMesh two_plates()
{
    TriMesh mesh;
    mesh.position.resize(3, 8);
    mesh.triangle.resize(3, 4);
    for (int layer = 0; layer < 2; ++layer) {
        const double z = 10 * layer;
        mesh.position.middleCols(4 * layer, 4) << -20, 20, 20, -20, -20, -20, 20, 20, z, z, z, z;
        mesh.triangle.col(2 * layer) << 4 * layer, 4 * layer + 1, 4 * layer + 2;
        mesh.triangle.col(2 * layer + 1) << 4 * layer, 4 * layer + 2, 4 * layer + 3;
    }
    return mesh;
}

Camera camera_above(bool perspective = false)
{
    Camera camera;
    camera.height = 60;
    camera.target = {0, 0, 5};
    camera.perspective = perspective;
    return look(camera, StandardView::top);
}

std::optional<HalfSpace> cut(ClipAxis axis, double place, bool flip = false)
{
    return kept_by({true, axis, place, flip, {0, 0, 1}});
}

} // namespace

TEST(ClipPlane, KeepsTheLowerSideOrFlippedTheUpperOne)
{
    EXPECT_EQ(kept_by({}), std::nullopt);
    for (const ClipAxis axis : {ClipAxis::x, ClipAxis::y, ClipAxis::z}) {
        const Vector3d along = Vector3d::Unit(int(axis));
        EXPECT_NEAR(cut(axis, 7)->height(3 * along), 4, 1e-12);
        EXPECT_NEAR(cut(axis, 7)->height(9 * along), -2, 1e-12);
        EXPECT_NEAR(cut(axis, 7, true)->height(9 * along), 2, 1e-12);
    }
    // need not be of unit length
    const auto slanted = kept_by({true, ClipAxis::view, 5, false, {3, 0, 4}});
    EXPECT_NEAR(slanted->height({3, 0, 4}), 0, 1e-12);
    EXPECT_NEAR(slanted->height({0, 0, 0}), 5, 1e-12);
}

TEST(ClipPlane, WhatIsKeptOfARayIsWhereItsPlacesAreKept)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto any = [&] { return Vector3d(number(random), number(random), number(random)); };
    for (int k = 0; k < 500; ++k) {
        const HalfSpace half{any().normalized(), number(random)};
        const Vector3d origin = any(), direction = any();
        const auto kept = kept_of_ray(half, origin, direction);
        for (double t = 0; t < 5; t += 0.01) {
            const double height = half.height(origin + t * direction);
            if (std::abs(height) > 1e-9) {
                EXPECT_EQ(kept && t >= kept->from && t <= kept->to, height > 0);
            }
        }
    }
    // beside the plane, all of it
    EXPECT_EQ(kept_of_ray({{0, 0, 1}, -1}, {0, 0, 0}, {1, 0, 0}), std::nullopt);
    EXPECT_TRUE(kept_of_ray({{0, 0, 1}, 1}, {0, 0, 0}, {1, 0, 0}).has_value());
}

TEST(ClipPlane, AClickGoesThroughWhatIsCutAwayAndOnlyThere)
{
    const TriMesh mesh = two_plates();
    const RayPicker picker(mesh);
    for (const bool perspective : {false, true}) {
        const Camera camera = camera_above(perspective);
        const auto face = [&](glm::dvec2 pixel, const std::optional<HalfSpace>& kept) {
            return hit_at(camera, picker, pixel, view_size, kept).face;
        };
        EXPECT_GE(face(middle, {}), 2) << "the upper plate is in front";
        const int below = face(middle, cut(ClipAxis::z, 5));
        EXPECT_TRUE(below == 0 || below == 1) << "it is cut away";
        EXPECT_GE(face(middle, cut(ClipAxis::z, 5, true)), 2);
        EXPECT_EQ(face(middle, cut(ClipAxis::z, -1)), -1) << "all is cut away";
        EXPECT_EQ(face(middle, cut(ClipAxis::z, 11, true)), -1);
        // Half of each face is left: the same face is picked on one side of the plane and not on
        // the other.
        const glm::dvec2 left = middle - glm::dvec2(50, 0), right = middle + glm::dvec2(50, 0);
        EXPECT_GE(face(left, cut(ClipAxis::x, 0)), 2);
        EXPECT_EQ(face(right, cut(ClipAxis::x, 0)), -1);
        EXPECT_EQ(face(left, cut(ClipAxis::x, 0, true)), -1);
        EXPECT_GE(face(right, cut(ClipAxis::x, 0, true)), 2);
    }
}

TEST(ClipPlane, TheDistanceOfAHitIsFromTheEyeAsEver)
{
    const TriMesh mesh = two_plates();
    const RayPicker picker(mesh);
    const Camera camera = camera_above();
    const RayHit lower = hit_at(camera, picker, middle, view_size, cut(ClipAxis::z, 5));
    const Ray ray = ray_through(camera, picker.box(), middle, view_size);
    EXPECT_NEAR((ray.origin + lower.distance * ray.direction).z(), 0, 1e-9);
}

TEST(ClipPlane, BoxesBrushesAndVerticesTakeWhatIsLeftInSight)
{
    const TriMesh mesh = two_plates();
    const RayPicker picker(mesh);
    const Camera camera = camera_above();
    const std::vector<glm::dvec2> all = {{0, 0}, {800, 0}, {800, 600}, {0, 600}};
    const auto in_box = [&](const std::optional<HalfSpace>& kept, bool through) {
        return faces_in({View::part, all, view_size, PickMode::replace, through}, camera, mesh, picker, kept);
    };
    EXPECT_EQ(in_box({}, false), (FaceSet{2, 3}));
    EXPECT_EQ(in_box(cut(ClipAxis::z, 5), false), (FaceSet{0, 1}));
    EXPECT_EQ(in_box(cut(ClipAxis::z, 5), true), (FaceSet{0, 1}));
    EXPECT_EQ(in_box({}, true), (FaceSet{0, 1, 2, 3}));
    const PickBrush brush{View::part, middle, 300, view_size, PickMode::replace, false};
    EXPECT_EQ(faces_under(brush, camera, mesh, picker, cut(ClipAxis::z, 5)), (FaceSet{0, 1}));

    const glm::dvec2 corner(pixel_of(camera, mesh.position.col(2), view_size));
    const PickVertex pick{View::part, corner, view_size};
    EXPECT_EQ(vertex_at(pick, camera, mesh, picker), 6);
    EXPECT_EQ(vertex_at(pick, camera, mesh, picker, cut(ClipAxis::z, 5)), 2);
    EXPECT_EQ(vertex_at(pick, camera, mesh, picker, cut(ClipAxis::x, 0)), std::nullopt);
    const auto probe = probe_at(camera, mesh, picker, corner + glm::dvec2(-4, 4), view_size, 8, cut(ClipAxis::z, 5));
    ASSERT_TRUE(probe.has_value());
    EXPECT_LT(probe->face, 2);
    EXPECT_NEAR(probe->barycentric.maxCoeff(), 1, 1e-12) << "it takes the corner beside the click";
}

using ClipModel = ModelFixture;

TEST_F(ClipModel, ClipsTheViewsInSpaceAndPicksWhatIsLeft)
{
    open();
    model.resized(View::part, {800, 600});
    model.apply(LookFrom{View::part, StandardView::top});
    model.apply(FitView{});
    const PickArea everything{View::part, {{0, 0}, {800, 0}, {800, 600}, {0, 600}}, view_size, PickMode::replace, true};
    model.apply(everything);
    const size_t all = document.selected.size();
    const TriMesh& mesh = document.session.part->mesh;
    ViewSettings settings = state.view;
    settings.clip.on = true;
    settings.clip.place_mm = (mesh.position.row(0).minCoeff() + mesh.position.row(0).maxCoeff()) / 2;
    model.apply(SetViewSettings{settings});
    model.apply(everything);
    EXPECT_NEAR(double(document.selected.size()), double(all) / 2, 0.1 * double(all));
    for (const int f : document.selected)
        EXPECT_LE(mesh.position(0, mesh.triangle.col(f)).mean(), settings.clip.place_mm + 1e-9);
    SceneCache cache;
    for (const View view : all_views)
        EXPECT_EQ(scene(view, state, cache).kept.has_value(), view != View::blank);
    open(); // another part: nothing is cut away
    EXPECT_FALSE(state.view.clip.on);
}

TEST_F(ClipModel, AProjectKeepsThePlaneAndNotTheHabitsOfTheMouse)
{
    open();
    ViewSettings settings = state.view;
    settings.clip = {true, ClipAxis::y, 3.5, true, {0, 0, 1}};
    settings.mouse = MouseStyle::catia;
    model.apply(SetViewSettings{settings});
    const auto file = std::filesystem::temp_directory_path() / "spia-clip-test.spia";
    model.apply(SaveProject{file});
    EXPECT_FALSE(read_json(file)["view"].contains("mouse"));
    settings.clip = {};
    settings.mouse = MouseStyle::nx;
    model.apply(SetViewSettings{settings});
    model.apply(OpenProject{file});
    wait();
    EXPECT_EQ(state.view.clip, (ClipPlane{true, ClipAxis::y, 3.5, true, {0, 0, 1}}));
    EXPECT_EQ(state.view.mouse, MouseStyle::nx);
    std::filesystem::remove(file);
}

} // namespace spia::viewer
