#include "app/viewer/model/picking/view_cube.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

#include "app/viewer/model/jobs/viewer_model.h"
#include "engine/core/error.h"

namespace spia::viewer {
namespace {

std::vector<CubeSide> all_sides()
{
    std::vector<CubeSide> sides;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x != 0 || y != 0 || z != 0)
                    sides.push_back({x, y, z});
    return sides;
}

glm::dvec3 viewer_of(const Camera& camera) { return camera.turn * glm::dvec3(0, 0, 1); }
glm::dvec3 vec(const CubeSide& side) { return {side[0], side[1], side[2]}; }

/// Whether a place lies in a convex outline, by the sides of its edges.
bool inside(const CubePiece& piece, glm::dvec2 p)
{
    int left = 0;
    for (size_t k = 0; k < 4; ++k) {
        const glm::dvec2 a = piece.corner[k], b = piece.corner[(k + 1) % 4];
        left += (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0 ? 1 : -1;
    }
    return std::abs(left) == 4;
}

} // namespace

TEST(ViewCube, HasTwentySixSidesAndLooksFromEachWithZUpwards)
{
    ASSERT_EQ(all_sides().size(), 26u);
    for (const CubeSide& side : all_sides()) {
        Camera camera;
        camera.target = {5, 6, 7};
        camera.height = 33;
        const Camera turned = look_from(camera, side);
        EXPECT_NEAR(glm::length(viewer_of(turned) - glm::normalize(vec(side))), 0, 1e-12) << words(side);
        const glm::dvec3 right = turned.turn * glm::dvec3(1, 0, 0), up = turned.turn * glm::dvec3(0, 1, 0);
        EXPECT_NEAR(right.z, 0, 1e-12) << "the horizon is level";
        if (side[0] != 0 || side[1] != 0) {
            EXPECT_GT(up.z, 0);
        }
        EXPECT_EQ(turned.target, camera.target);
        EXPECT_EQ(turned.height, camera.height);
        EXPECT_FALSE(words(side).empty());
    }
    EXPECT_THROW(look_from({}, {0, 0, 0}), InputError);
    EXPECT_THROW(look_from({}, {2, 0, 0}), InputError);
}

TEST(ViewCube, ItsFacesAreTheStandardViews)
{
    const std::pair<StandardView, CubeSide> faces[] = {
        {StandardView::top, {0, 0, 1}},       {StandardView::bottom, {0, 0, -1}}, {StandardView::front, {0, -1, 0}},
        {StandardView::back, {0, 1, 0}},      {StandardView::left, {-1, 0, 0}},   {StandardView::right, {1, 0, 0}},
        {StandardView::isometric, {1, -1, 1}}};
    for (const auto& [standard, side] : faces) {
        const glm::dquat wanted = look({}, standard).turn, turned = look_from({}, side).turn;
        EXPECT_NEAR(std::abs(glm::dot(wanted, turned)), 1, 1e-12) << words(side);
    }
    EXPECT_EQ(words({0, 0, 1}), "Top");
    EXPECT_EQ(words({1, -1, 1}), "Top, front, right");
}

TEST(ViewCube, SeenFromASideItsMiddleIsThatSide)
{
    for (const CubeSide& side : all_sides())
        EXPECT_EQ(cube_side_at(look_from({}, side).turn, {0, 0}), side) << words(side);
}

TEST(ViewCube, FromTheFrontPlacesAreReadOffDirectly)
{
    // x to the right, z up, the face at y = -1
    const glm::dquat front = look({}, StandardView::front).turn;
    const double in = 0.5 * cube_face_share, at_edge = 0.5 * (1 + cube_face_share);
    EXPECT_EQ(cube_side_at(front, {in, -in}), (CubeSide{0, -1, 0}));
    EXPECT_EQ(cube_side_at(front, {at_edge, 0}), (CubeSide{1, -1, 0}));
    EXPECT_EQ(cube_side_at(front, {0, at_edge}), (CubeSide{0, -1, 1}));
    EXPECT_EQ(cube_side_at(front, {-at_edge, -at_edge}), (CubeSide{-1, -1, -1}));
    EXPECT_EQ(cube_side_at(front, {1.001, 0}), std::nullopt);
    EXPECT_EQ(cube_side_at(front, {0, -1.001}), std::nullopt);
    EXPECT_NE(cube_side_at(front, {0.999, 0.999}), std::nullopt);
}

TEST(ViewCube, IsometricItEndsAtItsHexagon)
{
    const glm::dquat iso = look({}, StandardView::isometric).turn;
    const double tip = 2 * std::sqrt(2. / 3); // the silhouette's corners: sqrt(2/3) of an edge
    for (int k = 0; k < 6; ++k) {
        const double angle = (0.5 + k / 3.) * std::acos(-1.);
        const glm::dvec2 way(std::cos(angle), std::sin(angle));
        EXPECT_NE(cube_side_at(iso, 0.999 * tip * way), std::nullopt) << k;
        EXPECT_EQ(cube_side_at(iso, 1.001 * tip * way), std::nullopt) << k;
    }
    EXPECT_EQ(cube_side_at(iso, {0, 0.8}), (CubeSide{0, 0, 1}));
    EXPECT_EQ(cube_side_at(iso, {-0.7, -0.4}), (CubeSide{0, -1, 0}));
    EXPECT_EQ(cube_side_at(iso, {0.7, -0.4}), (CubeSide{1, 0, 0}));
}

TEST(ViewCube, AClickHitsThePieceThatIsDrawnThere)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(-1.8, 1.8), number(-1, 1);
    for (int turns = 0; turns < 40; ++turns) {
        const glm::dquat turn =
            glm::normalize(glm::dquat(number(random), number(random), number(random), number(random)));
        const std::vector<CubePiece> pieces = cube_pieces(turn);
        for (int k = 0; k < 200; ++k) {
            const glm::dvec2 place(share(random), share(random));
            std::optional<CubeSide> drawn;
            for (const CubePiece& piece : pieces)
                if (inside(piece, place)) {
                    ASSERT_FALSE(drawn && *drawn != piece.side) << "two pieces lie over each other";
                    drawn = piece.side;
                }
            EXPECT_EQ(cube_side_at(turn, place), drawn);
        }
        EXPECT_LE(cube_names(turn).size(), 3u);
        EXPECT_GE(cube_names(turn).size(), 1u);
    }
}

TEST(ViewCube, TheActionTurnsLinkedViewsTogetherAndLeavesTheBlank)
{
    ViewerModel model(SPIA_SOURCE_DIR "/assets");
    const auto camera = [&](View view) { return model.state().view.camera[size_t(view)]; };
    const Camera blank = camera(View::blank);
    model.apply(LookFromSide{View::quads, {1, 1, 0}});
    for (const View view : {View::part, View::quads, View::surface})
        EXPECT_NEAR(glm::dot(viewer_of(camera(view)), glm::normalize(glm::dvec3(1, 1, 0))), 1, 1e-12);
    EXPECT_EQ(camera(View::blank), blank);
    ViewSettings settings = model.state().view;
    settings.linked = false;
    model.apply(SetViewSettings{settings});
    model.apply(LookFromSide{View::surface, {0, 0, -1}});
    EXPECT_NEAR(viewer_of(camera(View::surface)).z, -1, 1e-12);
    EXPECT_NEAR(viewer_of(camera(View::part)).z, 0, 1e-12);
    model.apply(LookFromSide{View::part, {0, 0, 0}});
    EXPECT_FALSE(model.state().messages.empty());
}

} // namespace spia::viewer
