#include "engine/layout/spokes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/layout/plane_lines.h"
#include "engine/mesh/flat/inside_polygon.h"

namespace spia {
namespace {

Eigen::Matrix2Xd points(std::initializer_list<Eigen::Vector2d> list)
{
    Eigen::Matrix2Xd result(2, Eigen::Index(list.size()));
    Eigen::Index i = 0;
    for (const Eigen::Vector2d& p : list)
        result.col(i++) = p;
    return result;
}

/// No two lines meet but in the centre, and none meets the border but where it starts.
void expect_apart(const Spokes& s, const Eigen::Matrix2Xd& polygon, const std::vector<int>& start)
{
    ASSERT_EQ(s.line.size(), start.size());
    EXPECT_TRUE(inside_polygon(polygon, s.centre));
    for (size_t a = 0; a < s.line.size(); ++a) {
        EXPECT_EQ(s.line[a].col(0), polygon.col(start[a]));
        EXPECT_EQ(s.line[a].rightCols<1>(), s.centre);
        for (Eigen::Index i = 0; i + 1 < s.line[a].cols(); ++i) {
            for (Eigen::Index e = 0; i > 0 && e < polygon.cols(); ++e)
                EXPECT_FALSE(segments_meet(s.line[a].col(i), s.line[a].col(i + 1), polygon.col(e),
                                           polygon.col((e + 1) % polygon.cols())));
            for (size_t b = 0; b < a; ++b)
                for (Eigen::Index j = 0; j + 1 < s.line[b].cols(); ++j)
                    if (i + 2 < s.line[a].cols() || j + 2 < s.line[b].cols()) {
                        EXPECT_FALSE(segments_meet(s.line[a].col(i), s.line[a].col(i + 1), s.line[b].col(j),
                                                   s.line[b].col(j + 1)));
                    }
        }
    }
}

} // namespace

TEST(Spokes, OfARegularHexagonAreItsRadii)
{
    Eigen::Matrix2Xd polygon(2, 12); // corners and middles
    for (int k = 0; k < 6; ++k) {
        const auto corner = [](int c) {
            return Eigen::Vector2d(std::cos(c * std::numbers::pi / 3), std::sin(c * std::numbers::pi / 3));
        };
        polygon.col(2 * k) = corner(k);
        polygon.col(2 * k + 1) = (corner(k) + corner(k + 1)) / 2;
    }
    const std::vector<int> start = {1, 3, 5, 7, 9, 11};
    const auto found = spokes(polygon, start);
    ASSERT_TRUE(found);
    EXPECT_LT(found->centre.norm(), 0.05); // the triangles are uneven
    expect_apart(*found, polygon, start);
    for (const Eigen::Matrix2Xd& line : found->line) // straight, but for the unevenness of the
                                                     // triangles
        for (Eigen::Index i = 0; i < line.cols(); ++i) {
            const Eigen::Vector2d along = line.col(0).normalized();
            EXPECT_LT(std::abs(along.x() * line(1, i) - along.y() * line(0, i)), 0.06);
        }
}

TEST(Spokes, BendAroundWhatIsInTheirWay)
{
    // A U whose two ends and bottom are to be joined: no place sees them all.
    const Eigen::Matrix2Xd u = points(
        {{0, 0}, {30, 0}, {60, 0}, {60, 50}, {55, 50}, {50, 50}, {50, 10}, {10, 10}, {10, 50}, {5, 50}, {0, 50}});
    const std::vector<int> start = {1, 4, 9};
    const auto found = spokes(u, start);
    ASSERT_TRUE(found);
    expect_apart(*found, u, start);
    for (const Eigen::Matrix2Xd& line : found->line)
        for (Eigen::Index i = 1; i + 1 < line.cols(); ++i)
            EXPECT_TRUE(inside_polygon(u, line.col(i)));
}

TEST(Spokes, OfAPolygonThatCrossesItselfAreNone)
{
    EXPECT_FALSE(spokes(points({{0, 0}, {10, 10}, {10, 0}, {0, 10}}), {0, 1, 2}));
}

} // namespace spia
