#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/mesh/distortion.h"
#include "engine/mesh/outline.h"
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
    triangle.triangle = Eigen::Vector3i(0, 1, 2);
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

} // namespace spia
