#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <random>

#include "engine/mesh/doctor/doctor.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// A sheet of two halves with a row of vertices each at x = 10, the second moved by up to `gap` in
/// x and y.
PolygonSoup torn_sheet(double gap)
{
    PolygonSoup soup;
    for (const int half : {0, 1})
        for (int i = 0; i <= 2; ++i)
            for (int j = 0; j <= 4; ++j) {
                const bool seam = half == 1 && i == 0;
                soup.position.emplace_back(10 * half + 5 * i + (seam ? gap * (0.5 + 0.5 * (j % 2)) : 0.), 5 * j, 0);
            }
    for (const int half : {0, 1})
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 4; ++j) {
                const int a = 15 * half + 5 * i + j;
                soup.add_polygon(std::array{a, a + 5, a + 6, a + 1});
            }
    return soup;
}

TEST(Cracks, ACrackIsNotedWithTheGapThatClosesIt)
{
    for (const double gap : {0.0049, 0.01, 1e-4}) {
        const Examination torn = examine(torn_sheet(gap), {.weld = true});
        const Finding* crack = torn.report.find(Fault::crack);
        ASSERT_TRUE(crack) << gap;
        EXPECT_EQ(crack->count, 10);
        EXPECT_GE(crack->weld_gap.value(), gap);
        EXPECT_LE(crack->weld_gap.value(), 1.11 * gap);
        EXPECT_EQ(torn.report.components, 2);
        EXPECT_NE(torn.report.find(Fault::several_components)->advice.find(crack->advice), std::string::npos);

        const Examination whole = examine(torn_sheet(gap), {.weld = true, .weld_gap = crack->weld_gap});
        EXPECT_TRUE(whole.report.healthy());
        EXPECT_EQ(whole.report.components, 1);
        EXPECT_EQ(whole.report.boundary_loops, 1);
        EXPECT_FALSE(whole.report.find(Fault::crack));
        EXPECT_NEAR(area(whole.mesh), 20 * 20, 20 * gap);
    }
    EXPECT_FALSE(examine(torn_sheet(0.2), {.weld = true}).report.find(Fault::crack)) << "a slit that was cut";
    EXPECT_FALSE(examine(torn_sheet(0), {.weld = true}).report.find(Fault::crack));
}

/// A curved sheet of two halves that are divided otherwise on each side of x = 10, where the second
/// is off by up to `gap`.
PolygonSoup unlike_halves(std::array<int, 2> divisions, double gap, std::mt19937& draw)
{
    std::uniform_real_distribution<double> off(-gap / 2, gap / 2);
    PolygonSoup soup;
    for (const size_t half : {0u, 1u}) {
        const int first = soup.vertices(), n = divisions[half];
        for (int i = 0; i <= 2; ++i)
            for (int j = 0; j <= n; ++j) {
                const bool seam = half == 1 && i == 0;
                const double x = 10. * double(half) + 5 * i, y = 20. * j / n;
                soup.position.emplace_back(x + (seam ? off(draw) : 0), y, 2 * std::sin(x / 8));
            }
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < n; ++j) {
                const int a = first + (n + 1) * i + j;
                soup.add_polygon(std::array{a, a + n + 1, a + n + 2});
                soup.add_polygon(std::array{a, a + n + 2, a + 1});
            }
    }
    return soup;
}

TEST(Cracks, SidesOfACrackNeedNotBeDividedAlike)
{
    std::mt19937 draw(29);
    for (int round = 0; round < 100; ++round) {
        const std::array divisions{1 + int(draw() % 20), 1 + int(draw() % 20)};
        SCOPED_TRACE(fmt::format("{} and {} edges", divisions[0], divisions[1]));
        // 2 % of the shorter edges at either side would be a crack; so close together two vertices
        // are one.
        const double gap = 0.008 * 20 / std::max(divisions[0], divisions[1]);
        const PolygonSoup soup = unlike_halves(divisions, gap, draw);
        const Examination torn = examine(soup, {.weld = true});
        const Finding* crack = torn.report.find(Fault::crack);
        ASSERT_TRUE(crack);
        EXPECT_LE(crack->weld_gap.value(), gap);
        const Examination whole = examine(soup, {.weld = true, .weld_gap = gap});
        EXPECT_TRUE(whole.report.healthy());
        EXPECT_EQ(whole.report.components, 1);
        EXPECT_EQ(whole.report.boundary_loops, 1);
        EXPECT_EQ(whole.report.euler_characteristic, 1);
        EXPECT_FALSE(whole.report.find(Fault::crack));
        EXPECT_FALSE(whole.report.find(Fault::polygon)) << "all have three corners in the file";
        EXPECT_NEAR(area(whole.mesh), area(torn.mesh), 20 * gap);
        const bool even = std::min(divisions[0], divisions[1]) > 3 && divisions[0] * divisions[1] < 60;
        EXPECT_FALSE(even && whole.report.find(Fault::sliver)) << "no edge is below a third of a millimetre";
    }
}

TEST(Cracks, VerticesOnEdgesAreJoinedWithThemIfFacesMeetThere)
{
    std::mt19937 draw(30);
    for (int round = 0; round < 20; ++round) {
        const int n = 1 + int(draw() % 6);
        const PolygonSoup soup = unlike_halves({n, n * (2 + int(draw() % 3))}, 0, draw);
        const Examination whole = examine(soup, {.weld = true});
        EXPECT_TRUE(whole.report.healthy());
        EXPECT_EQ(whole.report.boundary_loops, 1);
        EXPECT_EQ(examine(soup, {.weld = true, .weld_tolerance = 0}).report.components, 2);
    }
    // A triangle whose tip touches an edge has no edge in common with it.
    PolygonSoup touching;
    touching.position = {{0, 0, 0}, {10, 0, 0}, {5, -5, 0}, {4, 0, 0}, {3, 5, 0}, {6, 5, 0}};
    touching.add_polygon(std::array{0, 2, 1});
    touching.add_polygon(std::array{3, 5, 4});
    EXPECT_EQ(examine(touching, {.weld = true}).mesh.triangles(), 2);
    // A slit that was cut is wider.
    PolygonSoup slit = unlike_halves({10, 13}, 0, draw);
    for (int v = 33; v < slit.vertices(); ++v)
        slit.position[size_t(v)].x() += 0.2;
    const Examination cut = examine(slit, {.weld = true});
    EXPECT_FALSE(cut.report.find(Fault::crack));
    EXPECT_EQ(cut.report.components, 2);
}

} // namespace
} // namespace spia
