// Regions of the plane: what rows of points go around together, and its triangles.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>
#include <vector>

#include "engine/mesh/flat/polygon_union.h"
#include "engine/mesh/mesh_polygon.h"
#include "engine/mesh/vectors.h"
#include "tests/support/seeded_random.h"

namespace spia {
namespace {

using Points = Eigen::Matrix2Xd;

Points rectangle(double x, double y, double length, double width)
{
    Points result(2, 4);
    result << x, x + length, x + length, x, y, y, y + width, y + width;
    return result;
}

/// Counter-clockwise; n chords of a circle.
Points round(const Eigen::Vector2d& centre, double radius, int n)
{
    Points result(2, n);
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        result.col(i) = centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    return result;
}

double signed_area(const Points& ring)
{
    double sum = 0;
    for (Eigen::Index i = 0; i < ring.cols(); ++i)
        sum += cross(ring.col(i), ring.col((i + 1) % ring.cols())) / 2;
    return sum;
}

double area_of(const std::vector<Points>& rings)
{
    double sum = 0;
    for (const Points& ring : rings)
        sum += signed_area(ring);
    return sum;
}

} // namespace

TEST(PolygonUnion, OfRectanglesHasTheAreaOfTheSetsOfTheirCells)
{
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        shapes::SeededRandom random(seed);
        std::vector<Points> given, without;
        std::set<std::pair<int, int>> covered;
        for (int k = 0; k < 12; ++k) {
            const int x = random.whole(0, 12), y = random.whole(0, 12), length = random.whole(1, 6),
                      width = random.whole(1, 6);
            const bool taken = k >= 9;
            (taken ? without : given).push_back(rectangle(x, y, length, width));
            for (int i = x; i < x + length; ++i)
                for (int j = y; j < y + width; ++j)
                    if (taken)
                        covered.erase({i, j});
                    else
                        covered.insert({i, j});
        }
        EXPECT_NEAR(area_of(polygon_union(given, without)), double(covered.size()), 1e-6) << seed;
    }
}

TEST(PolygonUnion, KeepsPointsAndHolesExactlyAndLeavesStraightCornersOut)
{
    Points outline = rectangle(0, 0, 100, 50);
    outline.conservativeResize(2, 5);
    outline.col(4) << 0, 25; // straight
    const Points hole = round({30.123456789, 20.987654321}, 7, 36).rowwise().reverse();
    const std::vector<Points> rings = polygon_union({outline, hole});
    ASSERT_EQ(rings.size(), 2u);
    const Points &outer = rings[signed_area(rings[0]) > 0 ? 0 : 1], &inner = rings[signed_area(rings[0]) > 0 ? 1 : 0];
    EXPECT_EQ(outer.cols(), 4);
    ASSERT_EQ(inner.cols(), hole.cols());
    for (const auto& p : inner.colwise())
        EXPECT_EQ((hole.colwise() - p).colwise().norm().minCoeff(), 0);
    EXPECT_LT(signed_area(inner), 0);
}

TEST(PolygonUnion, OfRowsThatGoAroundTwiceCoversOnce)
{
    const Points square = rectangle(0, 0, 10, 10), clockwise = rectangle(2, 2, 4, 4).rowwise().reverse();
    // Twice around less once around is once around.
    EXPECT_NEAR(area_of(polygon_union({square, square, clockwise})), 100, 1e-6);
    EXPECT_NEAR(area_of(polygon_union({square, clockwise})), 84, 1e-6);
    EXPECT_TRUE(polygon_union({}).empty());
}

TEST(TriangulatedPolygon, CoversWhatIsBetweenItsRings)
{
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        shapes::SeededRandom random(seed);
        std::vector<Points> rings{round({0, 0}, 20, random.whole(3, 60))};
        // In the circle that is in any of the outlines.
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j)
                if (random.coin())
                    rings.push_back(Points(round({5.0 * i + random.between(-0.5, 0.5), 5.0 * j},
                                                 random.between(0.2, 1.9), random.whole(3, 40))
                                               .rowwise()
                                               .reverse()));
        std::erase_if(rings, [&](const Points& ring) { // a triangle's circle is smaller
            return &ring != &rings.front() && ring.colwise().norm().maxCoeff() > 0.49 * 20;
        });
        const PlanarMesh mesh = triangulate_polygon(rings);
        Eigen::Index points = 0;
        for (const Points& ring : rings)
            points += ring.cols();
        ASSERT_EQ(mesh.position.cols(), points) << seed;
        // n + 2 holes - 2: Euler's formula
        EXPECT_EQ(mesh.triangle.cols(), points + 2 * (Eigen::Index(rings.size()) - 1) - 2) << seed;
        double sum = 0;
        for (const auto& t : mesh.triangle.colwise()) {
            const double part = cross(mesh.position.col(t[1]) - mesh.position.col(t[0]),
                                      mesh.position.col(t[2]) - mesh.position.col(t[0])) /
                                2;
            EXPECT_GT(part, 0);
            sum += part;
        }
        EXPECT_NEAR(sum, area_of(rings), 1e-9 * sum) << seed;
    }
}

TEST(TriangulatedPolygon, IsNoneWhereRingsCross)
{
    const Points hole = rectangle(8, 2, 4, 4).rowwise().reverse();
    EXPECT_EQ(triangulate_polygon({rectangle(0, 0, 10, 10), hole}).triangle.cols(), 0);
    Points eight(2, 4);
    eight << 0, 10, 0, 10, 0, 10, 10, 0;
    EXPECT_EQ(triangulate_polygon({eight}).triangle.cols(), 0);
}

} // namespace spia
