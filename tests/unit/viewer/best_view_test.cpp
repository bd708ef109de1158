// From where the faces of a step are seen.
#include "app/viewer/views/best_view.h"

#include <cmath>
#include <gtest/gtest.h>

#include "app/viewer/model/picking/camera.h"
#include "tests/support/bent_parts.h"

namespace spia::viewer {
namespace {

/// A box of unit length without one side, from outside; its faces by the sides: two each, in this
/// order.
struct OpenBox {
    Eigen::Matrix3Xd place{3, 8};
    Eigen::Matrix3Xi triangle{3, 10};

    /// @param lid 0: z = 1, 1: z = 0, 2: x = 1: left out
    explicit OpenBox(int lid)
    {
        for (int v = 0; v < 8; ++v)
            place.col(v) << v % 2, v / 2 % 2, v / 4;
        const int side[6][4] = {{4, 5, 7, 6}, {0, 2, 3, 1}, {1, 3, 7, 5}, {0, 4, 6, 2}, {0, 1, 5, 4}, {2, 6, 7, 3}};
        int next = 0;
        for (int k = 0; k < 6; ++k)
            if (k != lid) {
                triangle.col(next++) << side[k][0], side[k][1], side[k][2];
                triangle.col(next++) << side[k][0], side[k][2], side[k][3];
            }
    }
};

glm::dvec3 viewer(const glm::dquat& turn) { return glm::mat3_cast(turn)[2]; }

} // namespace

TEST(BestView, LooksAtTheSideThatIsAskedForFromTheUsualSideOfIt)
{
    const OpenBox box(1); // upside down: its bottom is open, and its faces are the sides from k =
                          // 0, 2, 3, 4, 5
    const glm::dquat usual = look(Camera{}, StandardView::isometric).turn;
    const auto seen_from = [&](std::vector<int> faces) { return viewer(best_turn(box.triangle, {box.place}, faces)); };
    EXPECT_LT(glm::length(seen_from({0, 1}) - viewer(usual)), 1e-12) << "the top is seen from every corner above";
    EXPECT_LT(glm::length(seen_from({2, 3}) - viewer(usual)), 1e-12) << "and the right one from this";
    EXPECT_LT(seen_from({4, 5}).x, 0) << "the left one";
    EXPECT_GT(seen_from({8, 9}).y, 0) << "the one behind";
    EXPECT_GT(seen_from({4, 5, 8, 9}).y, 0);
    EXPECT_LT(seen_from({4, 5, 8, 9}).x, 0) << "both";
}

TEST(BestView, WhatLiesInsideIsSeenThroughTheOpening)
{
    // A shelf in the middle of a box that is open on the right: from the corners to the right it is
    // in sight.
    OpenBox box(2);
    Eigen::Matrix3Xd place(3, 12);
    place << box.place,
        (Eigen::Matrix3Xd(3, 4) << 0.2, 0.9, 0.9, 0.2, 0.1, 0.1, 0.9, 0.9, 0.5, 0.5, 0.5, 0.5).finished();
    Eigen::Matrix3Xi triangle(3, 12);
    triangle << box.triangle, (Eigen::Matrix3Xi(3, 2) << 8, 8, 9, 10, 10, 11).finished();
    const glm::dquat turn = best_turn(triangle, {place}, {10, 11});
    EXPECT_GT(viewer(turn).x, 0);
    EXPECT_GT(share_seen(triangle, {place}, {10, 11}, turn), 0.02);
    for (const StandardView view : {StandardView::top, StandardView::bottom})
        EXPECT_EQ(share_seen(triangle, {place}, {10, 11}, look(Camera{}, view).turn), 0) << "behind a wall";
}

TEST(BestView, AShareIsThatOfTheAreaAsItIsSeen)
{
    const Eigen::Matrix3Xd square = (Eigen::Matrix3Xd(3, 4) << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0).finished();
    const Eigen::Matrix3Xi triangle = (Eigen::Matrix3Xi(3, 2) << 0, 0, 1, 2, 2, 3).finished();
    const auto seen = [&](const std::vector<Eigen::Matrix3Xd>& states, StandardView view) {
        return share_seen(triangle, states, {0, 1}, look(Camera{}, view).turn);
    };
    EXPECT_NEAR(seen({square}, StandardView::top), 1, 0.03);
    EXPECT_NEAR(seen({square}, StandardView::bottom), 1, 0.03) << "both sides are sheet";
    EXPECT_NEAR(seen({square}, StandardView::isometric), 1 / std::sqrt(3), 0.03);
    EXPECT_LT(seen({square}, StandardView::front), 0.03) << "edge on";
    Eigen::Matrix3Xd upright = square; // in another state: half of what both show
    upright.row(2) = square.row(1);
    upright.row(1).setZero();
    EXPECT_NEAR(seen({square, upright}, StandardView::top), 0.5, 0.03);
    // A second square above hides all of the first one, a smaller one a quarter.
    for (const auto& [size, left] : {std::pair(1., 0.), {0.5, 0.75}}) {
        Eigen::Matrix3Xd two(3, 8);
        two << size * square, square;
        two.leftCols(4).row(2).array() = 0.5;
        Eigen::Matrix3Xi both(3, 4);
        both << triangle, triangle.array() + 4;
        EXPECT_NEAR(share_seen(both, {two}, {2, 3}, look(Camera{}, StandardView::top).turn), left, 0.04);
    }
}

TEST(BestView, AFineSheetIsSeenAsACoarseOne)
{
    const auto shell = [](double edge) { return shapes::lipped_box({.edge = edge}); };
    const TriMesh coarse = shell(6), fine = shell(0.8);
    ASSERT_GT(fine.triangles(), 30'000);
    const auto left_wall = [](const TriMesh& mesh) {
        std::vector<int> faces;
        const double left = mesh.position.row(0).minCoeff();
        for (int f = 0; f < mesh.triangles(); ++f)
            if (mesh.position(0, mesh.triangle.col(f)).maxCoeff() < left + 1)
                faces.push_back(f);
        return faces;
    };
    for (const StandardView view :
         {StandardView::isometric, StandardView::left, StandardView::top, StandardView::back}) {
        const auto seen = [&](const TriMesh& mesh) {
            return share_seen(mesh.triangle, {mesh.position}, left_wall(mesh), look(Camera{}, view).turn);
        };
        EXPECT_NEAR(seen(fine), seen(coarse), 0.06) << int(view);
    }
    for (const TriMesh* mesh : {&coarse, &fine})
        EXPECT_LT(viewer(best_turn(mesh->triangle, {mesh->position}, left_wall(*mesh))).x, 0);
}

} // namespace spia::viewer
