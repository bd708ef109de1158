#include "engine/mesh/doctor/split_polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <vector>

namespace spia {
namespace {

using Eigen::Vector3d;

TEST(SplitPolygon, QuadTakesItsShorterDiagonalUnlessThatFoldsItOver)
{
    const std::vector<Vector3d> kite = {{0, 0, 0}, {2, 1, 0}, {6, 0, 0}, {2, -1, 0}};
    for (const auto& t : split_polygon(kite)) // diagonal 1 - 3
        EXPECT_EQ(std::count(t.begin(), t.end(), 1) + std::count(t.begin(), t.end(), 3), 2);
    const std::vector<Vector3d> dart = {{0, 0, 0},
                                        {4, 1, 0},
                                        {3, 0, 0},
                                        {4, -1, 0}}; // 1 - 3 is shorter, but only 0 - 2 lies
                                                     // inside
    ASSERT_EQ(split_polygon(dart).size(), 2u);
    for (const auto& t : split_polygon(dart))
        EXPECT_EQ(std::count(t.begin(), t.end(), 0) + std::count(t.begin(), t.end(), 2), 2);
    EXPECT_TRUE(
        // crosses itself
        split_polygon(std::vector<Vector3d>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).empty());
}

TEST(SplitPolygon, TrianglesOfAnyStarFillItOnceInAnyAttitude)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> radius(0.2, 1), height(-0.02, 0.02);
    for (int trial = 0; trial < 200; ++trial) {
        const int n = 4 + trial % 30;
        const Eigen::Quaterniond attitude = Eigen::Quaterniond::UnitRandom();
        std::vector<Vector3d> corners;
        Vector3d normal = Vector3d::Zero();
        for (int i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * i / n, r = radius(random);
            corners.push_back(attitude * Vector3d(r * std::cos(angle), r * std::sin(angle), height(random)));
        }
        for (int i = 0; i < n; ++i) // the Newell normal, as a sum over the edges
            normal += corners[size_t(i)].cross(corners[size_t((i + 1) % n)]);
        const auto triangles = split_polygon(corners);
        ASSERT_EQ(int(triangles.size()), n - 2) << "n = " << n;
        Vector3d sum = Vector3d::Zero();
        double total = 0;
        for (const auto& t : triangles) {
            const Vector3d a =
                (corners[size_t(t[1])] - corners[size_t(t[0])]).cross(corners[size_t(t[2])] - corners[size_t(t[0])]);
            EXPECT_GT(a.dot(normal), 0);
            sum += a;
            total += a.dot(normal.normalized());
        }
        EXPECT_NEAR((sum - normal).norm(), 0, 1e-12);
        EXPECT_NEAR(total, normal.norm(), 1e-12); // none is turned over and none lies twice
    }
}

TEST(SplitPolygon, CornersOnAStraightEdgeMakeNoFlatTriangle)
{
    const std::vector<Vector3d> square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {3, 3, 0}, {0, 3, 0}};
    const auto triangles = split_polygon(square);
    ASSERT_EQ(triangles.size(), 5u);
    for (const auto& t : triangles)
        EXPECT_GT((square[size_t(t[1])] - square[size_t(t[0])]).cross(square[size_t(t[2])] - square[size_t(t[0])]).z(),
                  0.1);
}

} // namespace
} // namespace spia
