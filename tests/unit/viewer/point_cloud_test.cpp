#include "app/viewer/model/reports/point_cloud.h"

#include <gtest/gtest.h>
#include <random>

namespace spia::viewer {
namespace {

/// Within and beyond the square from 0 to 1, in one corner more than in the others.
struct Points {
    Eigen::VectorXd x{1000}, y{1000};
    Eigen::VectorXi marked{1000};
    Points()
    {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> anywhere(-0.1, 1.1);
        for (int k = 0; k < x.size(); ++k) {
            const double a = anywhere(random);
            x[k] = a * std::abs(a);
            y[k] = anywhere(random);
            marked[k] = k % 3 == 0;
        }
    }
};

} // namespace

TEST(PointCloud, EverySquareHasThePointsThatLieInIt)
{
    const Points points;
    const Eigen::AlignedBox2d range(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
    constexpr int columns = 5, rows = 3;
    const PointCloud cloud = count_points(points.x, points.y, points.marked, range, columns, rows);
    int seen = 0, most = 0;
    for (const auto& square : cloud.squares) {
        int inside = 0, marked = 0;
        for (int k = 0; k < points.x.size(); ++k)
            if (std::floor(points.x[k] * columns) == square.column && std::floor(points.y[k] * rows) == square.row) {
                ++inside;
                marked += points.marked[k];
            }
        EXPECT_EQ(square.points, inside) << square.column << ' ' << square.row;
        EXPECT_EQ(square.marked, marked) << square.column << ' ' << square.row;
        seen += inside;
        most = std::max(most, inside);
    }
    const auto within =
        (points.x.array() >= 0 && points.x.array() <= 1 && points.y.array() >= 0 && points.y.array() <= 1).count();
    EXPECT_EQ(seen, within);
    EXPECT_EQ(cloud.most, most);
}

TEST(PointCloud, WhatLiesOnTheEdgeBelongsToTheLastSquare)
{
    const PointCloud cloud =
        count_points(Eigen::VectorXd::Constant(1, 2.), Eigen::VectorXd::Constant(1, 4.), Eigen::VectorXi::Ones(1),
                     {Eigen::Vector2d(1, 1), Eigen::Vector2d(2, 4)}, 4, 6);
    ASSERT_EQ(cloud.squares.size(), 1u);
    EXPECT_EQ(cloud.squares[0].column, 3);
    EXPECT_EQ(cloud.squares[0].row, 5);
}

TEST(PointCloud, TheNearestPointIsThatOfTheScaledPlane)
{
    const Points points;
    const Eigen::Vector2d reach(0.02, 0.3);
    for (int k = 0; k <= 20; ++k) {
        const Eigen::Vector2d at(k / 20. - 0.3, 0.45);
        int best = 0;
        const auto distance = [&](int p) {
            return std::hypot((points.x[p] - at[0]) / reach[0], (points.y[p] - at[1]) / reach[1]);
        };
        for (int p = 1; p < points.x.size(); ++p)
            if (distance(p) < distance(best))
                best = p;
        const auto found = nearest_point(points.x, points.y, at, reach);
        EXPECT_EQ(found.has_value(), distance(best) <= 1) << k;
        EXPECT_EQ(found.value_or(best), best) << k;
    }
}

TEST(PointCloud, FarFromAllPointsNoneIsNearest)
{
    const Eigen::VectorXd x = Eigen::VectorXd::Zero(3), y = Eigen::VectorXd::LinSpaced(3, 0, 1);
    EXPECT_FALSE(nearest_point(x, y, {0.11, 0.5}, {0.1, 0.1}));
    EXPECT_EQ(nearest_point(x, y, {0.09, 0.5}, {0.1, 0.1}), 1);
}

TEST(PointCloud, ABoxHoldsItsEdgeToo)
{
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(5, 0, 4), y = Eigen::VectorXd::LinSpaced(5, 0, 8);
    EXPECT_EQ(points_within(x, y, {Eigen::Vector2d(1, 2), Eigen::Vector2d(3.5, 6)}), (std::vector{1, 2, 3}));
    EXPECT_TRUE(points_within(x, y, {Eigen::Vector2d(1, 2.5), Eigen::Vector2d(3.5, 3.5)}).empty());
}

} // namespace spia::viewer
