// Rows of patches along the bent arcs of the border, measured at their corners.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/layout/layout.h"
#include "tests/support/check_layout.h"
#include "tests/support/random_outlines.h"
#include "tests/support/shapes.h"

namespace spia {

namespace {

using std::numbers::pi;

/// Degrees, the least and the greatest inner corner of all patches, as their sides leave it over a
/// tenth of their length.
std::array<double, 2> corners_of(const Layout& layout)
{
    std::array<double, 2> result = {180, 0};
    for (const LayoutPatch& patch : layout.patch)
        for (size_t k = 0; k < 4; ++k) {
            const CurveUse ahead = patch[k], behind = patch[(k + 3) % 4];
            const auto leave = [&](CurveUse use, bool from_end) -> Eigen::Vector2d {
                const Eigen::Matrix2Xd p =
                    points_on(layout.curve[size_t(use.curve)],
                              use.reversed != from_end ? std::vector<double>{0.9, 1} : std::vector<double>{0, 0.1});
                return use.reversed != from_end ? p.col(0) - p.col(1) : p.col(1) - p.col(0);
            };
            const Eigen::Vector2d a = leave(ahead, false), b = leave(behind, true);
            const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) * 180 / pi;
            const double inner = angle < 0 ? angle + 360 : angle;
            result = {std::min(result[0], inner), std::max(result[1], inner)};
        }
    return result;
}

Layout layered(const TriMesh& part)
{
    LayoutOptions options;
    options.layers = true;
    return make_layout(part, Blank{part.position.topRows(2)}, options);
}

} // namespace

TEST(Layers, CornersAroundRoundHolesAreFarFromFlat)
{
    const auto [least, greatest] =
        corners_of(layered(shapes::plate({100, 80, {{{30, 30}, 12}, {{62, 45}, 14}}, 6000})));
    EXPECT_GT(least, 10);
    EXPECT_LT(greatest, 160);
}

TEST(Layers, KeepClearOfCuts)
{
    const TriMesh part = shapes::plate({100, 80, {{{30, 30}, 12}, {{66, 45}, 14}}, 6000});
    const Blank blank{part.position.topRows(2)};
    const auto nearest = [&](double x, double y) { return shapes::vertex_near(blank, x, y); };
    LayoutOptions options;
    options.layers = true;
    options.cuts = {{nearest(46, 0), nearest(46, 80)}};
    const Layout layout = make_layout(part, blank, options);
    EXPECT_EQ(shapes::fault_of_layout(layout, part, blank), "");
    double kept = 0;
    for (const LayoutCurve& curve : layout.curve)
        kept += curve.kept ? length(curve) : 0;
    EXPECT_NEAR(kept, 80, 0.5);
    const auto [least, greatest] = corners_of(layout);
    EXPECT_GT(least, 10);
    EXPECT_LT(greatest, 165);
}

class LayersOfPlates : public testing::TestWithParam<int> {};
// Of those that had a corner of more than 180 degrees, or folds, with straight lines from the
// border alone.
INSTANTIATE_TEST_SUITE_P(Random, LayersOfPlates, testing::Values(54, 59, 70, 77, 86, 91));

TEST_P(LayersOfPlates, HaveRoomForCellsAtEveryCorner)
{
    const auto drawn = shapes::random_outline(shapes::outline_kinds - 1, GetParam());
    const Layout layout = layered(drawn.part);
    const auto [least, greatest] = corners_of(layout);
    EXPECT_GT(least, 0.5);
    EXPECT_LT(greatest, 179.5);
    double sheet = 0, patches = 0;
    for (int f = 0; f < drawn.part.triangles(); ++f) {
        const Eigen::Vector3d a = drawn.part.position.col(drawn.part.triangle(0, f)),
                              b = drawn.part.position.col(drawn.part.triangle(1, f)),
                              c = drawn.part.position.col(drawn.part.triangle(2, f));
        sheet += 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
    }
    for (const LayoutPatch& patch : layout.patch)
        patches += area(layout, patch);
    EXPECT_NEAR(patches, sheet, 1e-9 * sheet);
}

} // namespace spia
