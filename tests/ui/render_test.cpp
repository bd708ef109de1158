#include <GLFW/glfw3.h>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "app/viewer/views/colours.h"
#include "engine/core/colour_map.h"
#include "engine/core/error.h"
#include "tests/ui/render_fixture.h"

namespace spia::viewer {
namespace {

/// The camera looks up at the other side.
Camera from_below()
{
    Camera camera = from_above();
    camera.turn = glm::dquat(0, 0, 1, 0);
    return camera;
}

Eigen::Vector3d rgb_at(const Picture& picture, int x, int y)
{
    const uint8_t* pixel = &picture.rgba[(size_t(y) * size_t(picture.width) + size_t(x)) * 4];
    return Eigen::Vector3d(pixel[0], pixel[1], pixel[2]) / 255;
}

/// Colour at a place of the pictures of from_above(), mm.
Eigen::Vector3d rgb_at_mm(const Picture& picture, double x, double y)
{
    return rgb_at(picture, int((x / room + 0.5) * picture.width), int((0.5 - y / room) * picture.height));
}

constexpr double steps = 1.01 / 255; // one of the picture's 256 levels
void expect_colour(const Eigen::Vector3d& seen, const Eigen::Vector3d& wanted, double tolerance = steps)
{
    EXPECT_LT((seen - wanted).cwiseAbs().maxCoeff(), tolerance)
        << "seen " << seen.transpose() << ", wanted " << wanted.transpose();
}

TEST_F(Render, ATriangleCoversItsShareOfThePixelsAndNothingElse)
{
    // 6 mm x 4 mm / 2 of 10 mm x 10 mm. Its sides are askew, or the few samples of a pixel would
    // all err the same way.
    const Picture picture = draw(scene_of({layer(triangles({{-3, -2, 0}, {3, -1.87f, 0}, {0.31f, 2.07f, 0}}))}));
    double covered = 0;
    const Eigen::Vector3d paper = rgb_at(picture, 0, 0);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            // the triangle has no green
            covered += (paper[1] - rgb_at(picture, x, y)[1]) / paper[1];
    const double area = 0.5 * (6 * 4.07 - 0.13 * 3.31) / 100;
    EXPECT_NEAR(covered / (side * side), area, 0.0005); // a tenth of a pixel all around

    expect_colour(rgb_at_mm(picture, 0, 0), {1, 0, 0});
    const Colour wanted = background(plain);
    for (const double y : {-2.2, 2.2})
        expect_colour(rgb_at_mm(picture, 0, y), {wanted[0], wanted[1], wanted[2]});
}

TEST_F(Render, AValueHasItsColourOfTheMapAndOutsideTheRangeThatOfTheEnd)
{
    const auto mesh = rectangle(-4, -4, 4, 4);
    SceneLayer shown = layer(mesh);
    shown.field = field_on(*mesh, [](const Eigen::Vector3f& p) { return 10 * p.x(); });
    shown.scale = {.map = ColourMap::viridis, .least = -20, .greatest = 20};
    const Picture picture = draw(scene_of({shown}));
    for (const double x : {-1.5, -0.5, 0.25, 1.75}) {
        const double middle_of_pixel = (std::floor((x / room + 0.5) * side) + 0.5) / side * room - room / 2;
        expect_colour(rgb_at_mm(picture, x, 0), viridis((10 * middle_of_pixel + 20) / 40), 2 * steps);
    }
    expect_colour(rgb_at_mm(picture, -3, 0), viridis(0));
    expect_colour(rgb_at_mm(picture, 3, 0), viridis(1));
}

TEST_F(Render, WhatIsNoNumberIsGreyAndTheRestOfTheMeshIsNot)
{
    const auto mesh = rectangle(-4, -4, 4, 4);
    auto field = field_on(*mesh, [](const Eigen::Vector3f&) { return 1; });
    field->value[4] = std::numeric_limits<float>::quiet_NaN(); // of the upper right triangle
    SceneLayer shown = layer(mesh);
    shown.field = field;
    const Picture picture = draw(scene_of({shown}));
    const Eigen::Vector3d nothing = rgb_at_mm(picture, 2, 2);
    EXPECT_NEAR(nothing.maxCoeff(), nothing.minCoeff(), steps);
    EXPECT_NEAR(nothing[0], no_value[0], 0.08);
    expect_colour(rgb_at_mm(picture, -2, -2), viridis(1));
}

TEST_F(Render, AFieldPerFaceGivesEachFaceOneColour)
{
    const auto mesh = rectangle(-4, -4, 4, 4);
    auto field = std::make_shared<SceneField>();
    field->per_face = true;
    field->value = Eigen::Vector2f(0.25f, 0.75f);
    SceneLayer shown = layer(mesh);
    shown.field = field;
    shown.scale.isolines = true; // have no meaning here
    const Picture picture = draw(scene_of({shown}));
    for (const double away : {0.5, 2.0, 3.8}) {
        expect_colour(rgb_at_mm(picture, -away, -away), viridis(0.25));
        expect_colour(rgb_at_mm(picture, away, away), viridis(0.75));
    }
}

TEST_F(Render, BandsHaveOneColourEachAndTheOuterOnesThoseOfTheEnds)
{
    const auto mesh = rectangle(-4, -4, 4, 4);
    SceneLayer shown = layer(mesh);
    shown.field = field_on(*mesh, [](const Eigen::Vector3f& p) { return p.x(); });
    shown.scale = {.least = -4, .greatest = 4, .bands = 4}; // 2 mm each
    const Picture picture = draw(scene_of({shown}));
    for (int band = 0; band < 4; ++band)
        for (const double inside : {0.1, 1.0, 1.9})
            expect_colour(rgb_at_mm(picture, -4 + 2 * band + inside, 0), viridis(band / 3.0));
}

TEST_F(Render, BandsOfAFieldPerFaceAreThoseOfItsValues)
{
    const auto mesh = rectangle(-4, -4, 4, 4);
    auto field = std::make_shared<SceneField>();
    field->per_face = true;
    field->value = Eigen::Vector2f(0.2f, 0.8f);
    SceneLayer shown = layer(mesh);
    shown.field = field;
    shown.scale.bands = 3;
    const Picture picture = draw(scene_of({shown}));
    for (const auto& [x, value] : {std::pair(-2.0, 0.2f), std::pair(2.0, 0.8f)}) {
        const Colour wanted = colour_of(shown.scale, value);
        expect_colour(rgb_at_mm(picture, x, x), {wanted[0], wanted[1], wanted[2]});
    }
}

TEST_F(Render, IsolinesRunWhereTheLegendHasItsTicks)
{
    const auto mesh = rectangle(-4, -4, 4, 4);
    SceneLayer shown = layer(mesh);
    shown.field = field_on(*mesh, [](const Eigen::Vector3f& p) { return p.x(); });
    // at -3, -1, 1, 3
    shown.scale = {.map = ColourMap::grey, .least = -5, .greatest = 5, .isolines = true, .ticks = 5};
    SceneLayer without = shown;
    without.scale.isolines = false;
    const Picture lines = draw(scene_of({shown})), smooth = draw(scene_of({without}));
    std::vector<double> position, ink;
    for (int x = 20; x < side - 20; ++x) {
        const double darker = rgb_at(smooth, x, side / 2)[0] - rgb_at(lines, x, side / 2)[0];
        const double place = (x + 0.5) / side * room - room / 2;
        if (darker < 2 * steps)
            continue;
        if (position.empty() || place - position.back() / ink.back() > 0.5) {
            position.push_back(0);
            ink.push_back(0);
        }
        position.back() += darker * place;
        ink.back() += darker;
    }
    ASSERT_EQ(position.size(), 4u);
    for (size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(position[i] / ink[i], -3 + 2 * double(i), 0.015) << "a pixel is 0.05 mm wide";
}

TEST_F(Render, TheNearerOfTwoFacesHidesTheOtherInWhateverOrderTheyCome)
{
    const SceneLayer low = layer(rectangle(-4, -4, 4, 4, 0), {1, 0, 0, 1});
    const SceneLayer high = layer(rectangle(-2, -2, 2, 2, 1), {0, 0, 1, 1});
    for (const auto& layers : {std::vector{low, high}, std::vector{high, low}}) {
        const Picture above = draw(scene_of(layers));
        expect_colour(rgb_at_mm(above, 0, 0), {0, 0, 1});
        expect_colour(rgb_at_mm(above, 3, 3), {1, 0, 0});
        const Picture below = draw(scene_of(layers), from_below());
        const Colour back = low.back;
        expect_colour(rgb_at_mm(below, 0, 0), {back[0], back[1], back[2]});
    }
}

TEST_F(Render, TransparentLayersAreBlendedOverWhatIsBehindThemEvenIfTheyComeFirst)
{
    const SceneLayer glass = layer(rectangle(-2, -2, 2, 2, 1), {0, 0, 1, 0.25f});
    const SceneLayer wall = layer(rectangle(-4, -4, 4, 4, 0), {1, 0, 0, 1});
    const SceneLayer hidden_glass = layer(rectangle(-4, -4, 4, 4, -1), {0, 1, 0, 0.5f});
    const Picture picture = draw(scene_of({glass, hidden_glass, wall}));
    expect_colour(rgb_at_mm(picture, 0, 0), {0.75, 0, 0.25});
    expect_colour(rgb_at_mm(picture, 3, 3), {1, 0, 0});
    for (size_t i = 3; i < picture.rgba.size(); i += 4)
        ASSERT_EQ(picture.rgba[i], 255) << "the picture itself is opaque";
}

TEST_F(Render, LinesAreAsWideAsAskedAndGrowWithTheContentScale)
{
    for (const float scale : {1.f, 2.f})
        for (const float width : {1.f, 3.f, 8.f}) {
            auto line = std::make_shared<SceneLines>();
            line->point.resize(3, 2);
            line->point << -4, 4, 0.3f, 0.9f, 0, 0;
            line->colour = {0, 0, 0, 1};
            line->width = width;
            Scene scene;
            scene.lines = {line};
            Look look = plain;
            look.content_scale = scale;
            const Picture picture = draw(scene, from_above(), look);
            double ink = 0; // pixels across the line, at its middle
            for (int y = 0; y < side; ++y)
                ink += 1 - rgb_at(picture, side / 2, y)[0] / rgb_at(picture, 0, 0)[0];
            const double slant = std::cos(std::atan2(0.6, 8.0));
            EXPECT_NEAR(ink * slant, width * scale, 0.1);
        }
}

TEST_F(Render, ALineBehindAFaceIsHiddenUnlessItIsOnTop)
{
    auto line = std::make_shared<SceneLines>();
    line->point.resize(3, 2);
    line->point << -4, 4, 0, 0, -1, -1;
    line->colour = {0, 1, 0, 1};
    line->width = 5;
    auto on_top = std::make_shared<SceneLines>(*line);
    on_top->on_top = true;
    Scene scene = scene_of({layer(rectangle(-2, -2, 2, 2))});
    scene.lines = {line};
    const Picture hidden = draw(scene);
    expect_colour(rgb_at_mm(hidden, 0, 0), {1, 0, 0});
    expect_colour(rgb_at_mm(hidden, 3, 0), {0, 1, 0});
    scene.lines = {on_top};
    expect_colour(rgb_at_mm(draw(scene), 0, 0), {0, 1, 0});
}

TEST_F(Render, WhatAPlaneCutsAwayIsNotDrawnWhateverItIs)
{
    const Eigen::Vector3d origin(1000, -50, 7); // of line and dots: where things lie does not
                                                // depend on it
    auto line = std::make_shared<SceneLines>();
    line->origin = origin;
    line->point.resize(3, 2);
    line->point << -1004, -996, 53, 53, -7, -7; // from x = -4 to 4 at y = 3
    line->colour = {0, 1, 0, 1};
    line->width = 5;
    auto dots = std::make_shared<ScenePoints>();
    dots->origin = origin;
    dots->point.resize(3, 2);
    dots->point << -1003, -997, 47, 47, -7, -7; // x = -3 and 3, y = -3
    dots->colour = {0, 0, 1, 1};
    dots->size = 8;
    for (const bool perspective : {false, true})
        for (const double side_kept : {-1., 1.}) {
            Scene scene = scene_of({layer(rectangle(-4, -1, 4, 1))});
            scene.lines = {line};
            scene.points = {dots};
            scene.kept = HalfSpace{{side_kept, 0, 0}, -side_kept}; // from x = 1 on, or up to there
            Camera camera = from_above();
            camera.perspective = perspective;
            const Picture picture = draw(scene, camera);
            const Eigen::Vector3d paper = rgb_at(picture, 0, 0);
            const double there = side_kept > 0 ? 2 : 0, gone = side_kept > 0 ? 0 : 2;
            expect_colour(rgb_at_mm(picture, there, 0), {1, 0, 0});
            expect_colour(rgb_at_mm(picture, gone, 0), paper);
            expect_colour(rgb_at_mm(picture, there, 3), {0, 1, 0});
            expect_colour(rgb_at_mm(picture, gone, 3), paper);
            expect_colour(rgb_at_mm(picture, 3 * side_kept, -3), {0, 0, 1});
            expect_colour(rgb_at_mm(picture, -3 * side_kept, -3), paper);
            // up to the plane itself
            expect_colour(rgb_at_mm(picture, 1 + 0.1 * side_kept, 0), {1, 0, 0});
            expect_colour(rgb_at_mm(picture, 1 - 0.1 * side_kept, 0), paper);
        }
}

TEST_F(Render, APointIsARoundDotOfItsSizeWithItsColourInTheMiddle)
{
    auto point = std::make_shared<ScenePoints>();
    point->point = Eigen::Matrix3Xf::Zero(3, 1);
    point->colour = {0, 0, 0, 1};
    point->size = 6; // too small for a rim
    Scene scene;
    scene.points = {point};
    const Picture picture = draw(scene);
    double ink = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            ink += 1 - rgb_at(picture, x, y)[0] / rgb_at(picture, 0, 0)[0];
    EXPECT_NEAR(ink, EIGEN_PI * 9, 0.5);
    expect_colour(rgb_at_mm(picture, 0, 0), {0, 0, 0});
}

TEST_F(Render, EdgesOfAMeshLieOnItsFacesAndNotOnThoseInFront)
{
    const auto mesh = rectangle(-4, -4, 4, 4);
    mesh->feature.resize(2, 1);
    mesh->feature << 1, 2; // the diagonal
    SceneLayer shown = layer(mesh, {1, 1, 1, 1});
    shown.features = true;
    Camera tilted = from_above();
    tilted.turn = glm::angleAxis(1.2, glm::dvec3(1, 0, 0));
    for (const Camera& camera : {from_above(), tilted})
        EXPECT_LT(rgb_at(draw(scene_of({shown}), camera), side / 2, side / 2)[1], 0.5);
    const SceneLayer cover = layer(rectangle(-4, -4, 4, 4, 1), {1, 1, 1, 1});
    expect_colour(rgb_at(draw(scene_of({shown, cover})), side / 2, side / 2), {1, 1, 1});
}

TEST_F(Render, MarkedFacesStandOutOnEveryColourOfEveryMap)
{
    const auto mesh = rectangle(-4, -4, 4, 4);
    for (const ColourMap map : {ColourMap::viridis, ColourMap::diverging, ColourMap::grey})
        for (int i = 0; i <= 20; ++i)
            for (const uint8_t bit : {FaceMarks::hovered, FaceMarks::selected}) {
                SceneLayer shown = layer(mesh);
                shown.scale.map = map;
                shown.scale.least = map == ColourMap::diverging ? -1 : 0; // its middle is at zero
                shown.scale.greatest = 1;
                const double value = shown.scale.least + (1 - shown.scale.least) * i / 20.0;
                shown.field = field_on(*mesh, [&](const Eigen::Vector3f&) { return value; });
                auto marks = std::make_shared<FaceMarks>();
                marks->mark = {0, bit};
                shown.marks = marks;
                const Picture picture = draw(scene_of({shown}));
                expect_colour(rgb_at_mm(picture, -2, -2), map_colour(map, i / 20.0), 2 * steps);
                const Oklab bare = oklab(rgb_at_mm(picture, -2, -2));
                int changed = 0, same = 0, all = 0;
                for (double x = 0.5; x < 3; x += 0.02, ++all) {
                    const Oklab marked = oklab(rgb_at_mm(picture, x, 3.5));
                    const double difference =
                        std::hypot(bare.L - marked.L, std::hypot(bare.a - marked.a, bare.b - marked.b));
                    changed += difference > 0.15;
                    same += difference < 0.02;
                }
                const auto where = fmt::format("map {} at {}, mark {}", int(map), i / 20.0, int(bit));
                if (bit == FaceMarks::hovered)
                    EXPECT_EQ(changed, all) << where;
                else { // stripes, and the values in between
                    EXPECT_GT(changed, all / 6) << where;
                    EXPECT_GT(same, all / 2) << where;
                }
            }
}

TEST_F(Render, ARegionTintsItsFacesWithItsOwnColour)
{
    const auto mesh = rectangle(-4, -4, 4, 4);
    SceneLayer shown = layer(mesh, {0.5f, 0.5f, 0.5f, 1});
    auto marks = std::make_shared<FaceMarks>();
    marks->mark = {2, 1};
    shown.marks = marks;
    Scene scene = scene_of({shown});
    scene.region_colours = {{0, 0, 1, 1}, {0, 1, 0, 1}};
    const Picture picture = draw(scene);
    const Eigen::Vector3d green = rgb_at_mm(picture, -2, -2), blue = rgb_at_mm(picture, 2, 2);
    EXPECT_GT(green[1], green[2] + 0.3);
    EXPECT_GT(blue[2], blue[1] + 0.3);
    scene.layers[0].field = field_on(*mesh, [](const Eigen::Vector3f&) { return 0.3; });
    // a field is not
    expect_colour(rgb_at_mm(draw(scene), 2, 2), map_colour(ColourMap::viridis, 0.3), 2 * steps);
}

TEST_F(Render, TheInnerSideOfASheetIsToldApart)
{
    const auto mesh = rectangle(-4, -4, 4, 4);
    SceneLayer shown = layer(mesh);
    shown.lit = true;
    shown.field = field_on(*mesh, [](const Eigen::Vector3f&) { return 0.7; });
    const Picture outer = draw(scene_of({shown})), inner = draw(scene_of({shown}), from_below());
    EXPECT_GT(oklab(rgb_at_mm(outer, 1, 1)).L - oklab(rgb_at_mm(inner, 1, 1)).L, 0.1);
}

TEST_F(Render, APictureInTilesEqualsThePictureInOne)
{
    const auto mesh = triangles({{-4, -4, 0}, {4, -3, 2}, {-3, 4, -2}, {4, -3, 2}, {4, 4, 0}, {-3, 4, -2}});
    mesh->feature.resize(2, 1);
    mesh->feature << 1, 2;
    SceneLayer shown = layer(mesh);
    shown.lit = shown.features = true;
    shown.field = field_on(*mesh, [](const Eigen::Vector3f& p) { return 0.5 + 0.1 * p.x(); });
    shown.scale.isolines = true;
    auto marks = std::make_shared<FaceMarks>();
    marks->mark = {0, FaceMarks::selected};
    shown.marks = marks;
    Scene scene = scene_of({shown});
    auto points = std::make_shared<ScenePoints>();
    points->point = Eigen::Vector3f(0, 0, 0);
    points->size = 20; // across the borders of the tiles
    scene.points = {points};
    for (const bool perspective : {false, true}) {
        Camera camera = from_above();
        camera.perspective = perspective;
        const Look look{.dark = true, .gradient = true};
        const Picture whole = renderer.picture(scene, camera, 150, 130, look);
        const Picture tiled = renderer.picture(scene, camera, 150, 130, look, 64);
        ASSERT_EQ(whole.rgba.size(), tiled.rgba.size());
        int different = 0; // rounding decides about a sample on an edge here and there
        for (size_t i = 0; i < whole.rgba.size(); ++i)
            different += std::abs(int(whole.rgba[i]) - int(tiled.rgba[i])) > 3;
        EXPECT_LT(different, int(whole.rgba.size()) / 1000) << (perspective ? "perspective" : "orthographic");
    }
}

TEST_F(Render, WithoutAGroundOnlyWhatIsThereIsOpaqueWithItsOwnColour)
{
    const Colour glass{0, 0, 1, 0.5f};
    const Scene scene = scene_of({layer(rectangle(-4, -4, 0, 4, -1)), layer(rectangle(1, -4, 4, 4), glass)});
    Look look = plain;
    look.ground = false;
    const Picture picture = draw(scene, from_above(), look);
    const auto at = [&](double x, double y) {
        const int column = int((x / room + 0.5) * side), row = int((0.5 - y / room) * side);
        return &picture.rgba[(size_t(row) * side + size_t(column)) * 4];
    };
    EXPECT_EQ(at(-2, 0)[3], 255);
    EXPECT_EQ(at(-2, 0)[0], 255);
    EXPECT_EQ(at(0.5, 0)[3], 0);
    EXPECT_EQ(at(4.9, 4.9)[3], 0);
    EXPECT_NEAR(at(2, 0)[3], 128, 2);
    EXPECT_NEAR(at(2, 0)[2], 255, 2); // not darkened by its opacity
    EXPECT_EQ(at(2, 0)[0], 0);
}

TEST_F(Render, AnEmptySceneShowsTheBackground)
{
    for (const bool dark : {false, true}) {
        const Look look{.dark = dark, .gradient = false};
        const Colour paper = background(look);
        expect_colour(rgb_at(draw(Scene{}, from_above(), look), 10, 190), {paper[0], paper[1], paper[2]});
    }
}

TEST_F(Render, AShaderThatDoesNotCompileIsNamedWithTheReason)
{
    const auto folder = std::filesystem::temp_directory_path() / "spia-shader-test";
    std::filesystem::remove_all(folder);
    std::filesystem::copy(Renderer::default_shader_folder(), folder);
    std::ofstream(folder / "line.frag") << "#version 330 core\nvoid main() { nonsense; }\n";
    try {
        Renderer broken(folder);
        FAIL() << "it compiled";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("line.frag"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos) << error.what();
    }
    std::filesystem::remove(folder / "line.frag");
    try {
        Renderer broken(folder);
        FAIL() << "there is no such file";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("line.frag"), std::string::npos) << error.what();
    }
    std::filesystem::remove_all(folder);
}

TEST_F(Render, APictureOfNoSizeIsRefused) { EXPECT_THROW(renderer.picture({}, {}, 0, 10, plain), InputError); }

TEST(RenderOldContext, AnOldOpenGLIsToldInPlainWords)
{
    if (!std::getenv("MESA_GL_VERSION_OVERRIDE"))
        GTEST_SKIP() << "run as the test ui.old_opengl, in a process whose driver offers OpenGL 2.1";
    const HiddenWindow window(false);
    try {
        Renderer renderer;
        FAIL() << "OpenGL 2.1 was enough";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("needs OpenGL 3.3; here there is OpenGL 2.1"), std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace spia::viewer

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    if (!glfwInit()) {
        std::fputs("there is no display; run it as: xvfb-run -a test_render\n", stderr);
        return 1;
    }
    const int failed = RUN_ALL_TESTS();
    glfwTerminate();
    return failed;
}
