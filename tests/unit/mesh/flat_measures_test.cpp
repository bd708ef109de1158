#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <random>

#include "engine/mesh/flat/distortion.h"
#include "engine/mesh/flat/outline.h"
#include "engine/mesh/flat/overlap.h"
#include "engine/mesh/orient2d.h"
#include "engine/mesh/topology.h"
#include "tests/support/developable.h"
#include "tests/support/shapes.h"

namespace spia {

TEST(Distortion, OfAnIsometryIsZeroAndOfASimilarityToo)
{
    const auto part = shapes::quarter_cylinder({.triangles = 400});
    for (double scale : {1.0, 3.0}) {
        const Distortion d = distortion(part.mesh, scale * part.flat);
        EXPECT_LT(d.angular_rms, 1e-12);
        EXPECT_LT(d.area_rms, 1e-12);
    }
}

TEST(Distortion, OfAShearedEquilateralTriangleIsTheHandComputedOne)
{
    TriMesh triangle;
    triangle.position.resize(3, 3);
    triangle.position << 0, 1, 0.5, 0, 0, std::sqrt(3) / 2, 0, 0, 0;
    triangle.triangle.resize(3, 1);
    triangle.triangle << 0, 1, 2;
    Eigen::Matrix2Xd flat(2, 3);
    flat << 0, 1, 0, 0, 0, 1; // angles 90, 45, 45 degrees against 60 each
    const double expected = std::sqrt((0.25 + 0.0625 + 0.0625) / 3);
    EXPECT_NEAR(distortion(triangle, flat).angular_rms, expected, 1e-12);
}

TEST(Distortion, CountsTheAreaOfUnevenStretch)
{
    // Half of a strip keeps its area, the other half doubles it: q = 2/3 and 4/3 of the mean.
    const TriMesh strip = shapes::rectangle(2, 1, 2, 1);
    Eigen::Matrix2Xd flat = strip.position.topRows<2>();
    for (int v = 0; v < strip.vertices(); ++v)
        if (flat(0, v) > 1.5)
            flat(0, v) = 3;
    EXPECT_NEAR(distortion(strip, flat).area_rms, 1.0 / 3, 1e-12);
}

TEST(Outline, AFigureEightCrossesItselfOnceAndASquareNever)
{
    Eigen::Matrix2Xd points(2, 4);
    points << 0, 1, 1, 0, 0, 0, 1, 1;
    EXPECT_EQ(crossings({{0, 1, 2, 3}}, points), 0);
    EXPECT_EQ(crossings({{0, 2, 1, 3}}, points), 1);
    EXPECT_DOUBLE_EQ(length({0, 1, 2, 3}, points), 4);
}

TEST(Outline, LoopsThatOverlapCrossEachOther)
{
    Eigen::Matrix2Xd points(2, 8);
    points << 0, 2, 2, 0, 1, 3, 3, 1, /**/ 0, 0, 2, 2, 1, 1, 3, 3;
    EXPECT_EQ(crossings({{0, 1, 2, 3}, {4, 5, 6, 7}}, points), 2);
}

TEST(Outline, ACornerOnAnEdgeTouchesAndOneBeyondItCrosses)
{
    // A corner of the second loop lies on an edge of the first one, up to one unit in the last
    // place.
    Eigen::Matrix2Xd points(2, 6);
    points << 0, 0.3, 0, /**/ 0.1, 1, 1, /**/ 0, 0.9, 0.9, /**/ 0.3, 0.3, 0.4;
    const double on = points(1, 3); // 0.1 * 3 is not 0.3: the line through 0 and (0.3, 0.9) passes
                                    // beside (0.1, 0.3)
    ASSERT_EQ(on, 0.3);
    const auto found = outline_crossings({{0, 1, 2}, {3, 4, 5}}, points);
    const int side = orient2d(points.col(0), points.col(1), points.col(3));
    EXPECT_EQ(found.size(), side > 0 ? 2u : 0u);
    points.col(1) << 0.5, 1.5;
    for (const double mirror : {1.0, -1.0}) { // either loop comes first in the sweep
        const auto times = [&](const Eigen::Vector2d& corner) {
            Eigen::Matrix2Xd seen = points;
            seen.col(3) = corner;
            seen.row(0) *= mirror;
            return outline_crossings({{0, 1, 2}, {3, 4, 5}}, seen);
        };
        EXPECT_TRUE(times({0.25, 0.75}).empty()) << "on it, exactly";
        const auto beyond = times({std::nextafter(0.25, 0), 0.75});
        ASSERT_EQ(beyond.size(), 2u) << "with both edges of the corner";
        EXPECT_EQ(mirror > 0 ? beyond[0].edge : beyond[0].other, (std::array{0, 1}));
    }
}

namespace {

/// Two squares of one corner in common, the second one turned about it by so many right angles;
/// each has its own vertices.
int crossings_of_squares(int quarters)
{
    Eigen::Matrix2Xd points(2, 8);
    points << 0, 1, 1, 0, /**/ 0, 1, 1, 0, /**/ 0, 0, 1, 1, /**/ 0, 0, 1, 1;
    for (int k = 0; k < quarters; ++k)
        for (int v = 4; v < 8; ++v)
            points.col(v) = Eigen::Vector2d(-points(1, v), points(0, v));
    return crossings({{0, 1, 2, 3}, {4, 5, 6, 7}}, points);
}

} // namespace

TEST(Outline, SquaresThatMeetInACornerOrAlongASideTouch)
{
    EXPECT_EQ(crossings_of_squares(1), 0); // beside each other
    EXPECT_EQ(crossings_of_squares(2), 0); // over the corner
    EXPECT_EQ(crossings_of_squares(3), 0);
    EXPECT_EQ(crossings_of_squares(0), 4) << "on each other";
}

TEST(Outline, WaysThroughOnePlaceCrossIfTheyChangeSides)
{
    // The tips of two triangles at the origin: one points up, the other down, or one stands in the
    // other.
    Eigen::Matrix2Xd points(2, 6);
    points << 0, -1, 1, /**/ 0, 1, -1, /**/ 0, -1, -1, /**/ 0, 1, 1;
    EXPECT_EQ(crossings({{0, 1, 2}, {3, 4, 5}}, points), 0);
    points.col(4) << 3, -1; // now its sides are on both sides of the first one's right side
    points.col(5) << 0, -3;
    EXPECT_GT(crossings({{0, 1, 2}, {3, 4, 5}}, points), 0);
}

TEST(Outline, AnEdgeThatGoesBackOnItsNeighbourCounts)
{
    Eigen::Matrix2Xd points(2, 4);
    points << 0, 2, 1, 1, /**/ 0, 0, 0, 1; // 0 -> 2 and back to 1
    const auto found = outline_crossings({{0, 1, 2, 3}}, points);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0], (OutlineCrossing{{0, 1}, {1, 2}}));
    points.col(2) << 3, 0; // straight on
    EXPECT_TRUE(outline_crossings({{0, 1, 2, 3}}, points).empty());
}

namespace {

/// A flat fan of triangles around vertex 0, each of the given angle; closed if the last spoke is
/// the first.
std::pair<TriMesh, Eigen::Matrix2Xd> fan(int triangles, double angle, bool closed)
{
    TriMesh mesh;
    const int spokes = closed ? triangles : triangles + 1;
    mesh.position = Eigen::Matrix3Xd::Zero(3, spokes + 1);
    mesh.triangle.resize(3, triangles);
    for (int i = 0; i < spokes; ++i) // the radius grows, so that an open fan may wind without
                                     // touching itself
        mesh.position.col(i + 1) << (1 + 0.1 * i) * std::cos(angle * i), (1 + 0.1 * i) * std::sin(angle * i), 0;
    for (int i = 0; i < triangles; ++i)
        mesh.triangle.col(i) << 0, i + 1, (i + 1) % spokes + 1;
    return {mesh, mesh.position.topRows<2>()};
}

} // namespace

TEST(OverlapOf, AFanIsFoundWhereItGoesAroundTwice)
{
    using std::numbers::pi;
    const auto [once, flat_once] = fan(6, pi / 3, true);
    EXPECT_TRUE(overlap(once, flat_once).none());
    const auto [twice, flat_twice] = fan(12, pi / 3, true); // an inner vertex
    EXPECT_EQ(overlap(twice, flat_twice).wound, std::vector{0});
    const auto [nearly, flat_nearly] = fan(11, 2 * pi / 11.5, false);
    EXPECT_TRUE(overlap(nearly, flat_nearly).none());
    // on the boundary: a winding stair
    const auto [more, flat_more] = fan(12, 2 * pi / 11.5, false);
    EXPECT_EQ(overlap(more, flat_more).wound, std::vector{0});
}

TEST(OverlapOf, ASpiralStripIsFoundByItsOutline)
{
    // A strip that turns by 500 degrees in the plane: no vertex is gone around twice, the outline
    // crosses itself.
    const auto strip = [](double turn) {
        TriMesh mesh = shapes::rectangle(1, 1, 60, 2);
        for (auto x : mesh.position.colwise()) {
            const double angle = turn * x[0], r = 2 - x[1];
            x << r * std::sin(angle), -r * std::cos(angle), 0;
        }
        mesh.triangle.row(1).swap(mesh.triangle.row(2));
        return mesh;
    };
    for (const auto& [degrees, overlaps] : {std::pair(350.0, false), {500.0, true}}) {
        TriMesh mesh = strip(degrees * std::numbers::pi / 180);
        Eigen::Matrix2Xd flat = mesh.position.topRows<2>();
        if (orient2d(flat.col(mesh.triangle(0, 0)), flat.col(mesh.triangle(1, 0)), flat.col(mesh.triangle(2, 0))) < 0)
            mesh.triangle.row(1).swap(mesh.triangle.row(2));
        const Overlap found = overlap(mesh, flat);
        EXPECT_TRUE(found.wound.empty());
        EXPECT_EQ(!found.crossings.empty(), overlaps) << degrees;
    }
}

/// A sheet with a slit that runs in from its left side, turns up and ends: cells of the tongue have
/// vertices of their own along it, at other places than those opposite to them.
struct SlitSheet {
    TriMesh mesh;
    std::vector<int> lip; ///< vertices of the tongue along the slit
};

SlitSheet slit_sheet(std::mt19937& draw)
{
    const int columns = 6 + int(draw() % 10), rows = 6 + int(draw() % 10), corner = 2 + int(draw() % (columns - 3)),
              row = 1 + int(draw() % (rows - 4)), end = row + 2 + int(draw() % (rows - row - 2));
    std::uniform_real_distribution<double> along(-0.4, 0.4);
    std::vector<Eigen::Vector3d> place;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            place.emplace_back(i, j, 0);
    std::map<int, int> copy;
    SlitSheet sheet;
    const auto split = [&](int i, int j, double dx, double dy) {
        copy[i + j * (columns + 1)] = int(place.size());
        sheet.lip.push_back(int(place.size()));
        place.emplace_back(i + dx, j + dy, 0);
    };
    for (int i = 0; i < corner; ++i)
        split(i, row, i > 0 ? along(draw) : 0, 0);
    split(corner, row, 0, 0);
    for (int j = row + 1; j < end; ++j)
        split(corner, j, 0, along(draw));
    std::vector<Eigen::Vector3i> triangle;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto at = [&](int a, int b) {
                const int v = a + b * (columns + 1);
                return j >= row && j < end && i < corner && copy.contains(v) ? copy.at(v) : v;
            };
            triangle.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            triangle.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    sheet.mesh.position.resize(3, Eigen::Index(place.size()));
    for (size_t v = 0; v < place.size(); ++v)
        sheet.mesh.position.col(Eigen::Index(v)) = place[v];
    sheet.mesh.triangle.resize(3, Eigen::Index(triangle.size()));
    for (size_t f = 0; f < triangle.size(); ++f)
        sheet.mesh.triangle.col(Eigen::Index(f)) = triangle[f];
    return sheet;
}

TEST(OverlapOf, LipsThatLieOnEachOtherUpToRoundingTouch)
{
    std::mt19937 draw(83);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int round = 0; round < 200; ++round) {
        const SlitSheet sheet = slit_sheet(draw);
        const double size = 30 * std::exp(3 * unit(draw));
        const Eigen::Rotation2Dd turn(4 * unit(draw));
        Eigen::Matrix2Xd flat = size / 20 * (turn.toRotationMatrix() * sheet.mesh.position.topRows<2>());
        for (double& x : flat.reshaped())
            x += (round % 2 ? 1e-13 : 1e-7) * size * unit(draw);
        SCOPED_TRACE(round);
        EXPECT_TRUE(overlap(sheet.mesh, flat).none());
        for (const int v : sheet.lip) // out over the other side
            flat.col(v) += 1e-5 * size * (turn * Eigen::Vector2d(1, -1));
        EXPECT_FALSE(overlap(sheet.mesh, flat).crossings.empty());
    }
}

} // namespace spia
