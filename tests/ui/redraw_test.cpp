#include <array>

#include "app/viewer/render/view_images.h"
#include "tests/ui/render_fixture.h"

namespace spia::viewer {
namespace {

TEST_F(Render, AViewIsDrawnAgainOnlyWhenItShowsSomethingElse)
{
    Renderer::Image image;
    Scene scene = scene_of({layer(rectangle(-2, -2, 2, 2))});
    Camera camera = from_above();
    renderer.draw(image, scene, camera, 80, 60, plain);
    const int once = renderer.pictures_drawn();
    renderer.draw(image, Scene(scene), camera, 80, 60, plain);
    EXPECT_EQ(renderer.pictures_drawn(), once);
    camera.height *= 2;
    renderer.draw(image, scene, camera, 80, 60, plain);
    EXPECT_EQ(renderer.pictures_drawn(), once + 1);
    scene.layers[0].scale.bands = 5;
    renderer.draw(image, scene, camera, 80, 60, plain);
    EXPECT_EQ(renderer.pictures_drawn(), once + 2);
    renderer.draw(image, scene, camera, 81, 60, plain);
    EXPECT_EQ(renderer.pictures_drawn(), once + 3);
    const auto dot = [](double x) {
        auto points = std::make_shared<ScenePoints>();
        points->point = Eigen::Vector3f(float(x), 0, 0);
        return points;
    };
    for (const double x : {0., 0., 1.}) { // made anew for every frame
        scene.points = {dot(x)};
        renderer.draw(image, scene, camera, 81, 60, plain);
        EXPECT_EQ(renderer.pictures_drawn(), once + (x == 0 ? 4 : 5));
    }
    EXPECT_TRUE(renderer.shows(image, scene, camera, 81, 60, plain));
    EXPECT_FALSE(renderer.shows(image, scene, camera, 81, 61, plain));
}

TEST(DrawTurns, ViewsThatAreTooMuchForOneFrameTakeTurnsAndAllArrive)
{
    DrawTurns turns(10);
    std::array<int, 4> drawn{};
    for (int frame = 0; frame < 12; ++frame) { // all four change all the time, each costs more than
                                               // the budget
        turns.begin_frame();
        int now = 0;
        for (size_t view = 0; view < 4; ++view)
            if (turns.may_draw(view, view == 1)) {
                turns.spent(20);
                ++drawn[view];
                ++now;
            }
        EXPECT_LE(now, 3); // the first, the urgent one, and the one whose turn it is
    }
    EXPECT_EQ(drawn[1], 12);
    EXPECT_GE(drawn[2], 5);
    EXPECT_GE(drawn[3], 5);
    turns.begin_frame();
    EXPECT_TRUE(turns.may_draw(0, true)); // one is maximised while others wait
    turns.spent(20);
    EXPECT_FALSE(turns.any_waits());
    for (int frame = 0; frame < 2; ++frame) { // what shows already asks as urgent and costs nothing
        turns.begin_frame();
        for (size_t view = 0; view < 4; ++view)
            EXPECT_TRUE(turns.may_draw(view, true) && !(view == 3 && turns.any_waits()));
    }
}

TEST_F(Render, WhatNoSceneHoldsAnyMoreIsForgotten)
{
    {
        SceneLayer shown = layer(rectangle(-2, -2, 2, 2));
        shown.field = field_on(*shown.mesh, [](const Eigen::Vector3f&) { return 1; });
        draw(scene_of({shown}));
        EXPECT_EQ(renderer.uploads(), 2u);
        draw(scene_of({shown}));
        EXPECT_EQ(renderer.uploads(), 2u);
    }
    draw(Scene{});
    EXPECT_EQ(renderer.uploads(), 0u);
}

} // namespace
} // namespace spia::viewer
