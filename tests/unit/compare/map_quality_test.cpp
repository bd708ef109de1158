#include "engine/compare/map_quality.h"

#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include "tests/support/developable.h"
#include "tests/unit/compare/layouts.h"

namespace spia {

TEST(MapQuality, OfAnIsometryOfAnySizeIsTheBestThereIs)
{
    const auto part = shapes::cone_sector({.triangles = 500});
    for (double scale : {0.01, 1.0, 30.0}) {
        const MapQuality q = map_quality(part.mesh, scale * part.flat);
        EXPECT_LT(q.angular_rms, 1e-11);
        EXPECT_LT(q.area_rms, 1e-11);
        EXPECT_NEAR(q.l2_stretch, 1, 1e-13);
        EXPECT_NEAR(q.symmetric_dirichlet, 4, 1e-12);
        EXPECT_EQ(q.flips, 0);
        EXPECT_EQ(q.crossings, 0);
    }
}

TEST(MapQuality, OfAnAffineMapIsTheHandComputedOne)
{
    // Stretched to 4 by 1 (s1 = 4, s2 = 1; at the part's area 2 and 1/2). Squares cut by a
    // diagonal: their right angles stay, those of 45 degrees become atan(4) and atan(1/4).
    const TriMesh part = shapes::rectangle(6, 6, 6, 6);
    Eigen::Matrix2Xd flat = part.position.topRows<2>();
    flat.row(0) *= 4;
    const MapQuality q = map_quality(part, flat);
    const double quarter = std::numbers::pi / 4, off = (std::atan(4.0) - quarter) / quarter;
    EXPECT_NEAR(q.angular_rms, off * std::sqrt(2.0 / 3), 1e-12);
    EXPECT_NEAR(q.area_rms, 0, 1e-12);
    EXPECT_NEAR(q.l2_stretch, std::sqrt((0.25 + 4) / 2), 1e-12);
    EXPECT_NEAR(q.symmetric_dirichlet, 4 + 0.25 + 0.25 + 4, 1e-12);
}

TEST(MapQuality, OfTwoStretchesInOneSheetIsTheHandComputedOne)
{
    // One half keeps its size, the other is stretched twofold one way: sum A s^2 = 2 + 5, sum A /
    // s^2 = 2 + 1.25, flat area 3 of 2.
    const TriMesh strip = shapes::rectangle(2, 1, 2, 1);
    Eigen::Matrix2Xd flat = strip.position.topRows<2>();
    for (int v = 0; v < strip.vertices(); ++v)
        if (flat(0, v) > 1.5)
            flat(0, v) = 3;
    const MapQuality q = map_quality(strip, flat);
    EXPECT_NEAR(q.area_rms, 1.0 / 3, 1e-12);
    EXPECT_NEAR(q.l2_stretch, std::sqrt(3.25 / 2 * 1.5 / 2), 1e-12);
    EXPECT_NEAR(q.symmetric_dirichlet, 2 * std::sqrt(7 * 3.25) / 2, 1e-12);
}

TEST(MapQuality, CountsFlipsAndOverlapsAndCallsTheStretchOfAFlipInfinite)
{
    const TriMesh part = shapes::rectangle(4, 1, 4, 1);
    Eigen::Matrix2Xd flat = part.position.topRows<2>();
    for (int v = 0; v < part.vertices(); ++v)
        if (flat(0, v) > 2.5)
            flat(0, v) = 5.75 - flat(0, v) - 0.5; // folded back onto the cells before: x 3, 4 to
                                                  // 2.25, 1.25
    const MapQuality q = map_quality(part, flat);
    EXPECT_EQ(q.flips, 2); // the last cell runs backwards, the one before is only short
    EXPECT_GT(q.crossings, 0);
    EXPECT_EQ(q.l2_stretch, std::numeric_limits<double>::infinity());
    EXPECT_EQ(q.symmetric_dirichlet, std::numeric_limits<double>::infinity());
}

} // namespace spia
