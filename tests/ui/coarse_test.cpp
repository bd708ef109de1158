#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "app/viewer/render/coarse_mesh.h"
#include "app/viewer/render/renderer.h"
#include "app/viewer/render/view_images.h"
#include "app/viewer/views/scene_mesh.h"
#include "tests/support/parametric_mesh.h"
#include "tests/support/revolved.h"
#include "tests/ui/hidden_window.h"

namespace spia::viewer {
namespace {

double area(const SceneMesh& mesh, const Eigen::Matrix<uint32_t, 3, Eigen::Dynamic>& triangle)
{
    double twice = 0;
    for (Eigen::Index f = 0; f < triangle.cols(); ++f) {
        const Eigen::Vector3f a = mesh.position.col(triangle(0, f));
        twice += double((mesh.position.col(triangle(1, f)) - a).cross(mesh.position.col(triangle(2, f)) - a).norm());
    }
    return twice / 2;
}

SceneMesh cap(int triangles)
{
    return scene_mesh(shapes::sphere_cap({.radius = 50, .half_angle_deg = 90, .triangles = triangles}).mesh);
}

TEST(CoarseMesh, OfASphereHasAboutAsManyTrianglesAsAskedForAndStaysOnIt)
{
    const SceneMesh mesh = cap(100000);
    for (const int about : {2000, 10000, 40000}) {
        const CoarseMesh coarse = coarse_mesh(mesh, about);
        const auto count = coarse.triangle.cols();
        EXPECT_GT(count, about / 2);
        EXPECT_LT(count, about * 2);
        ASSERT_EQ(Eigen::Index(coarse.face.size()), count);
        // What is lost are the sagittas of chords as long as a cube's diagonal d, 1 - d^2 / (8 r^2)
        // of a length, and half a cube all along the rim.
        const double exact = 2 * std::numbers::pi * 50 * 50, rim = 2 * std::numbers::pi * 50;
        const double side = std::sqrt(3 * exact / about), chords = exact * 3 * side * side / (4 * 50 * 50);
        EXPECT_NEAR(area(mesh, coarse.triangle), exact, chords + rim * side / 2) << about << ": " << count;
        for (Eigen::Index f = 0; f < count; ++f) {
            const auto middle = [&](const auto& triangle, Eigen::Index at) -> Eigen::Vector3f {
                return (mesh.position.col(triangle(0, at)) + mesh.position.col(triangle(1, at)) +
                        mesh.position.col(triangle(2, at))) /
                       3;
            };
            ASSERT_LT(coarse.face[size_t(f)], mesh.triangle.cols());
            EXPECT_LT((middle(coarse.triangle, f) - middle(mesh.triangle, coarse.face[size_t(f)])).norm(),
                      std::sqrt(3.) * side)
                << "it shows the value of a face elsewhere";
        }
    }
}

TEST(CoarseMesh, OfNothingIsNothing)
{
    SceneMesh mesh;
    EXPECT_EQ(coarse_mesh(mesh, 1000).triangle.cols(), 0);
    mesh = cap(1000);
    EXPECT_EQ(coarse_mesh(mesh, 0).triangle.cols(), 0);
    mesh.position.setConstant(7); // all vertices in one place
    EXPECT_EQ(coarse_mesh(mesh, 100).triangle.cols(), 0);
}

class CoarsePicture : public testing::Test {
protected:
    /// Of the hemisphere from above, with a field per face or vertex: the place along x.
    Scene hemisphere(bool per_face) const
    {
        Scene scene;
        SceneLayer layer;
        layer.mesh = mesh;
        layer.lit = layer.features = false;
        auto field = std::make_shared<SceneField>();
        field->per_face = per_face;
        field->value.resize(per_face ? mesh->triangle.cols() : mesh->position.cols());
        for (Eigen::Index i = 0; i < field->value.size(); ++i)
            field->value[i] = per_face
                                  ? (mesh->position(0, mesh->triangle(0, i)) + mesh->position(0, mesh->triangle(1, i)) +
                                     mesh->position(0, mesh->triangle(2, i))) /
                                        3
                                  : mesh->position(0, i);
        layer.field = field;
        layer.scale = {.map = ColourMap::grey, .least = -50, .greatest = 50};
        scene.layers.push_back(layer);
        return scene;
    }
    Camera from_above() const
    {
        Camera camera;
        camera.height = 110;
        camera.target = {mesh->origin[0], mesh->origin[1], mesh->origin[2]};
        return camera;
    }
    HiddenWindow window;
    Renderer renderer;
    std::shared_ptr<SceneMesh> mesh = std::make_shared<SceneMesh>(cap(50000));
};

TEST_F(CoarsePicture, HasTheColoursOfTheFineOne)
{
    for (const bool per_face : {false, true}) {
        const Scene scene = hemisphere(per_face);
        Look look;
        look.samples = 1;
        const Picture fine = renderer.picture(scene, from_above(), 200, 200, look);
        look.most_triangles = 5000;
        const Picture coarse = renderer.picture(scene, from_above(), 200, 200, look);
        EXPECT_NE(fine.rgba, coarse.rgba);
        double sum = 0;
        int counted = 0;
        for (int y = 50; y < 150; ++y)
            for (int x = 50; x < 150; ++x, ++counted)
                sum +=
                    std::abs(int(fine.rgba[size_t(4 * (200 * y + x))]) - int(coarse.rgba[size_t(4 * (200 * y + x))]));
        // A face that stands for its neighbours is off by up to half a cube: 255 levels over 100
        // mm, cubes of 3 mm.
        EXPECT_LT(sum / counted, 4) << (per_face ? "per face" : "per vertex");
    }
}

TEST_F(CoarsePicture, AMeshBelowTheLimitIsDrawnAsItIs)
{
    const Scene scene = hemisphere(true);
    Look look;
    const Picture fine = renderer.picture(scene, from_above(), 100, 100, look);
    look.most_triangles = 60000;
    EXPECT_EQ(renderer.picture(scene, from_above(), 100, 100, look).rgba, fine.rgba);
}

TEST_F(CoarsePicture, AViewThatWaitsWithAnotherFieldIsOldAndOneThatIsOnlyTurnedIsNot)
{
    ViewImages images(renderer);
    const Camera camera = from_above();
    Camera turned = camera;
    turned.height *= 1.1;
    const Look look;
    // The first view takes all the time there is: others wait, but for the one whose turn it is.
    const auto frame = [&](const Scene& scene, const Camera& seen) {
        std::array<ViewImages::Drawn, 4> drawn{};
        images.begin_frame();
        for (size_t view = 0; view < 4; ++view)
            drawn[view] = images.draw(view, view == 0, scene, seen, 2000, 2000, look);
        return drawn;
    };
    const Scene by_vertex = hemisphere(false), of_faces = hemisphere(true);
    for (const auto& drawn : frame(by_vertex, camera))
        EXPECT_FALSE(drawn.old) << "the first picture is there at once";
    const auto after = frame(of_faces, camera);
    EXPECT_FALSE(after[0].old);
    EXPECT_TRUE(after[3].old) << "it still shows the other field";
    EXPECT_TRUE(images.any_late());
    for (int k = 0; k < 4; ++k)
        frame(of_faces, camera);
    EXPECT_FALSE(images.any_late());
    const auto moved = frame(of_faces, turned);
    EXPECT_TRUE(images.any_late());
    for (const auto& drawn : moved)
        EXPECT_FALSE(drawn.old) << "the same field, seen a frame ago";
}

} // namespace
} // namespace spia::viewer
