#include "engine/coons/adapt_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/coons/boundary.h"
#include "engine/coons/lift.h"
#include "engine/core/error.h"
#include "tests/support/check_grid.h"
#include "tests/support/shapes.h"
#include "tests/unit/coons/outlines.h"

namespace spia::adapt_grid_test {
namespace {

using std::numbers::pi;
constexpr double length = 100, width = 40, radius = 2, bend_at = 60; // mm

/// The strip bent by a right angle: of its middle line at the arc length s.
Eigen::Vector2d profile(double s)
{
    const double angle = std::clamp((s - bend_at) / radius, 0.0, pi / 2);
    const double after = std::max(0.0, s - bend_at - radius * pi / 2);
    return {std::min(s, bend_at) + radius * std::sin(angle), radius * (1 - std::cos(angle)) + after};
}

TriMesh bent(const TriMesh& flat)
{
    TriMesh part = flat;
    for (int v = 0; v < part.vertices(); ++v) {
        const Eigen::Vector2d p = profile(flat.position(0, v));
        part.position.col(v) << p.x(), flat.position(1, v), p.y();
    }
    return part;
}

struct Strip {
    TriMesh flat = shapes::rectangle(length, width, 800, 8);
    TriMesh part = bent(flat);
    Blank blank{flat.position.topRows(2)};
    BlankBoundary boundary = split_boundary(blank, part, corners());

    std::array<int, 4> corners() const
    {
        std::array<int, 4> vertex;
        const std::array<Eigen::Vector2d, 4> place = {Eigen::Vector2d(0, 0), Eigen::Vector2d(length, 0),
                                                      Eigen::Vector2d(length, width), Eigen::Vector2d(0, width)};
        for (size_t k = 0; k < 4; ++k)
            vertex[k] = outlines::nearest_vertex(flat, place[k]);
        return vertex;
    }
    GridResult grid(double line_grading) const
    {
        GridOptions options;
        options.columns = 40;
        options.rows = 10;
        options.line_grading = line_grading;
        return coons_grid(part, blank, boundary, options);
    }
};

/// How far the straight edges along u are from the strip.
double chord_height(const GridResult& grid)
{
    double greatest = 0;
    const QuadGrid& planar = grid.planar;
    for (int i = 0; i < planar.columns; ++i) {
        const double a = planar.position(0, planar.node(i, 3)), b = planar.position(0, planar.node(i + 1, 3));
        const Eigen::Vector2d chord = profile(b) - profile(a);
        for (int k = 1; k < 50; ++k) {
            const Eigen::Vector2d way = profile(a + (b - a) * k / 50) - profile(a);
            greatest = std::max(greatest, std::abs(way.x() * chord.y() - way.y() * chord.x()) / chord.norm());
        }
    }
    return greatest;
}

TEST(GradeLines, GoToTheBendOfAStrip)
{
    const Strip strip;
    const GridResult even = strip.grid(0), graded = strip.grid(0.5);
    EXPECT_EQ(even.line_grading, 0);
    EXPECT_GT(graded.line_grading, 0);
    EXPECT_EQ(shapes::fault_of(graded, strip.boundary), "");
    EXPECT_LT(chord_height(graded), chord_height(even) / 8);
    int inside = 0; // 1.3 of an even grid
    for (int i = 0; i <= 40; ++i) {
        const double s = graded.planar.position(0, graded.planar.node(i, 5));
        inside += s > bend_at && s < bend_at + radius * pi / 2;
    }
    EXPECT_GE(inside, 10);
    for (int j = 0; j <= 10; ++j)
        for (int i = 0; i <= 40; ++i) {
            const Eigen::Vector3d node = graded.planar.position.col(graded.planar.node(i, j));
            EXPECT_NEAR(node.x(), graded.planar.position(0, graded.planar.node(i, 5)), 1e-9) << "they stay straight";
            EXPECT_NEAR(node.y(), 4 * j, 1e-9) << "nothing bends across these lines";
        }
}

TEST(GradeLines, MoreOfThemTheLargerTheShare)
{
    const Strip strip;
    double before = chord_height(strip.grid(0));
    for (const double share : {0.2, 0.5, 0.8}) {
        const double now = chord_height(strip.grid(share));
        EXPECT_LT(now, before) << share;
        before = now;
    }
}

/// How far lines of a plate with two holes go from even ones, in cells.
double farthest_line(const TriMesh& part, bool bends)
{
    const TriMesh plate = shapes::plate();
    const Blank blank{plate.position.topRows(2)};
    const BlankBoundary boundary = split_boundary(blank, part, propose_corners(blank, part));
    GridOptions options;
    const GridResult even = coons_grid(part, blank, boundary, options);
    options.line_grading = 0.6;
    const GridResult graded = coons_grid(part, blank, boundary, options);
    EXPECT_EQ(graded.line_grading > 0, bends);
    EXPECT_EQ(graded.no_bends, !bends);
    return (graded.planar.position - even.planar.position).cwiseAbs().maxCoeff() / (120. / even.planar.columns);
}

TEST(GradeLines, StayWhereNothingBends)
{
    TriMesh part = shapes::plate();
    EXPECT_EQ(farthest_line(part, false), 0);
    for (int v = 0; v < part.vertices(); ++v) // slips of the last digits
        part.position(2, v) += 1e-12 * (v % 7);
    EXPECT_EQ(farthest_line(part, false), 0);
}

TEST(GradeLines, CannotMoveWhereThereAreNone)
{
    Strip strip;
    GridOptions options;
    options.columns = options.rows = 1;
    options.line_grading = 0.5;
    for (int v = 0; v < strip.part.vertices(); ++v) // twisted: the normals of the only cell's
                                                    // corners differ
        strip.part.position(2, v) += 1e-3 * strip.flat.position(0, v) * strip.flat.position(1, v);
    options.even_cells = true;
    const GridResult one = coons_grid(strip.part, strip.blank, strip.boundary, options);
    EXPECT_TRUE(one.no_bends);
    EXPECT_EQ(one.line_grading, 0);
    EXPECT_FALSE(one.evened);
}

TEST(GradeLines, AreNotDrawnByWhatFillsAHole)
{
    TriMesh part = shapes::plate();
    for (int v = 0; v < part.vertices(); ++v) { // rolled up evenly: what fills its holes is flatter
                                                // than it
        const double angle = part.position(0, v) / 60;
        part.position(0, v) = 60 * std::sin(angle);
        part.position(2, v) = -60 * std::cos(angle);
    }
    EXPECT_LT(farthest_line(part, true), 0.3);
}

TEST(GradeLines, SeeABendBesideHolesWhereThereIsNothingElse)
{
    // The inner nodes of 3 x 3 cells lie in holes: every other one is beside one.
    TriMesh part = shapes::plate({120, 80, {{{40, 26}, 9}, {{80, 26}, 9}, {{40, 54}, 9}, {{80, 54}, 9}}, 4000});
    const Blank blank{part.position.topRows(2)};
    for (int v = 0; v < part.vertices(); ++v)
        part.position(2, v) = 0.5 * std::abs(part.position(0, v) - 62);
    GridOptions options;
    options.columns = options.rows = 3;
    options.line_grading = 0.5;
    const GridResult grid = coons_grid(part, blank, split_boundary(blank, part, propose_corners(blank, part)), options);
    EXPECT_FALSE(grid.no_bends);
    EXPECT_GT(grid.line_grading, 0);
    options.line_grading = 0;
    const GridResult even = coons_grid(part, blank, split_boundary(blank, part, propose_corners(blank, part)), options);
    const std::vector<char> on_fill = lift(even).on_fill;
    EXPECT_EQ(std::count(on_fill.begin(), on_fill.end(), 1), 4) << "else this test says nothing";
}

TEST(GradeLines, RefusesAShareWithoutSense)
{
    const Strip strip;
    EXPECT_THROW(strip.grid(-0.1), InputError);
    EXPECT_THROW(strip.grid(0.95), InputError);
    EXPECT_THROW(strip.grid(std::nan("")), InputError);
}

/// A plate whose upper side is a wave: the lines of its Coons patch are not at right angles.
struct Wave {
    TriMesh flat;
    Blank blank;
    BlankBoundary boundary;

    Wave()
    {
        outlines::Points outline;
        for (int k = 0; k < 50; ++k)
            outline.emplace_back(2 * k, 0);
        outline.emplace_back(100, 0);
        for (int k = 1; k < 20; ++k)
            outline.emplace_back(100, 2 * k);
        for (int k = 50; k >= 0; --k)
            outline.emplace_back(2 * k, 40 + 12 * std::sin(3 * pi * k / 50));
        for (int k = 19; k > 0; --k)
            outline.emplace_back(0, 2 * k);
        flat = outlines::part(outline);
        blank = outlines::as_blank(flat);
        std::array<int, 4> corner;
        const std::array<Eigen::Vector2d, 4> place = {Eigen::Vector2d(0, 0), Eigen::Vector2d(100, 0),
                                                      Eigen::Vector2d(100, 40), Eigen::Vector2d(0, 40)};
        for (size_t k = 0; k < 4; ++k)
            corner[k] = outlines::nearest_vertex(flat, place[k]);
        boundary = split_boundary(blank, flat, corner);
    }
};

TEST(EvenCells, AreNearerToRightAnglesAndSound)
{
    const Wave wave;
    GridOptions options;
    const GridResult plain = coons_grid(wave.flat, wave.blank, wave.boundary, options);
    options.even_cells = true;
    const GridResult evened = coons_grid(wave.flat, wave.blank, wave.boundary, options);
    EXPECT_EQ(plain.route, evened.route);
    EXPECT_TRUE(evened.evened);
    EXPECT_EQ(shapes::fault_of(evened, wave.boundary), "");
    const auto mean_off = [](const GridResult& grid) { return 1 - scaled_jacobians(grid.planar).mean(); };
    EXPECT_LT(mean_off(evened), mean_off(plain) * 0.8);
    for (int i = 0; i <= plain.planar.columns; ++i)
        for (const int j : {0, plain.planar.rows})
            EXPECT_EQ(evened.planar.position.col(evened.planar.node(i, j)),
                      plain.planar.position.col(plain.planar.node(i, j)));
}

TEST(EvenCells, KeepTheSpacingOfTheLines)
{
    const Strip strip;
    GridOptions options;
    options.columns = 40;
    options.rows = 10;
    options.line_grading = 0.5;
    const GridResult graded = coons_grid(strip.part, strip.blank, strip.boundary, options);
    options.even_cells = true;
    const GridResult both = coons_grid(strip.part, strip.blank, strip.boundary, options);
    EXPECT_TRUE(both.line_grading == 0.5 && both.evened);
    EXPECT_LT((both.planar.position - graded.planar.position).cwiseAbs().maxCoeff(), 1e-3)
        << "rectangles have right angles";
}

class AdaptedOutline : public testing::TestWithParam<int> {};

/// Outlines at random, with waves across them for the part, as if they had been formed.
TEST_P(AdaptedOutline, HasAGridWithoutAFold)
{
    int graded = 0, evened = 0;
    for (int number = 0; number < 4; ++number) {
        const shapes::RandomOutline drawn = shapes::random_outline(GetParam(), number);
        TriMesh part = drawn.part;
        const double size = (part.position.rowwise().maxCoeff() - part.position.rowwise().minCoeff()).norm();
        for (int v = 0; v < part.vertices(); ++v)
            part.position(2, v) = 0.05 * size * std::tanh(60 * (part.position(0, v) + part.position(1, v)) / size);
        const Blank blank{drawn.part.position.topRows(2)};
        const BlankBoundary boundary = split_boundary(blank, part, drawn.corner);
        GridOptions options;
        options.line_grading = 0.6;
        options.even_cells = number % 2 == 0;
        const GridResult grid = coons_grid(part, blank, boundary, options);
        EXPECT_EQ(shapes::fault_of(grid, boundary), "") << drawn.name;
        graded += grid.line_grading > 0;
        evened += grid.evened;
    }
    EXPECT_GE(graded, 3);
    EXPECT_GE(evened, 1);
}

// Without spirals (4), of which many have no grid.
INSTANTIATE_TEST_SUITE_P(Random, AdaptedOutline, testing::Values(0, 1, 2, 3, 5, 6, 7), [](const auto& param) {
    std::string name(shapes::outline_kind(param.param));
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

} // namespace
} // namespace spia::adapt_grid_test
