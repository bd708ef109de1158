#include "engine/mesh/cut/corner_seam.h"

#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "engine/mesh/curvature.h"
#include "engine/mesh/cut/cut.h"
#include "tests/support/bent_parts.h"
#include "tests/support/developable.h"
#include "tests/support/revolved.h"

namespace spia {
namespace {

using std::numbers::pi;

TriMesh cut_at(const TriMesh& part, const CornerSeam& seam)
{
    SeamOptions given{SeamOptions::Mode::given, seam.path};
    return cut_open(part, given).mesh;
}

/// A pyramid's walls without its bottom: they lack 2 pi - `sides` * angle at the top.
TriMesh pyramid(int sides, double radius, double height)
{
    TriMesh mesh;
    mesh.position.resize(3, sides + 1);
    mesh.triangle.resize(3, sides);
    mesh.position.col(sides) << 0, 0, height;
    for (int i = 0; i < sides; ++i) {
        mesh.position.col(i) << radius * std::cos(2 * pi * i / sides), radius * std::sin(2 * pi * i / sides), 0;
        mesh.triangle.col(i) << i, (i + 1) % sides, sides;
    }
    return mesh;
}

/// Flat walls all around, between two openings.
TriMesh frustum(int sides, double bottom, double top, double height, int rows)
{
    TriMesh mesh;
    mesh.position.resize(3, sides * (rows + 1));
    mesh.triangle.resize(3, 2 * sides * rows);
    for (int r = 0; r <= rows; ++r)
        for (int i = 0; i < sides; ++i) {
            const double share = double(r) / rows, radius = bottom + share * (top - bottom);
            mesh.position.col(r * sides + i) << radius * std::cos(2 * pi * i / sides),
                radius * std::sin(2 * pi * i / sides), share * height;
        }
    for (int r = 0; r < rows; ++r)
        for (int i = 0; i < sides; ++i) {
            const int a = r * sides + i, b = r * sides + (i + 1) % sides;
            mesh.triangle.col(2 * a) << a, b, b + sides;
            mesh.triangle.col(2 * a + 1) << a, b + sides, a + sides;
        }
    return mesh;
}

} // namespace

TEST(CornerSeam, TraysUnrollOnceTheirCornersAreCut)
{
    std::mt19937_64 random(29);
    std::uniform_real_distribution<double> measure(30, 150);
    for (int k = 0; k < 20; ++k) {
        shapes::LippedBox box;
        box.width = measure(random);
        box.depth = measure(random);
        box.height = 0.3 * measure(random);
        box.lip = 5 + 3 * (k % 2);
        box.edge = 3 + k % 5;
        const TriMesh part = shapes::lipped_box(box);
        const auto seam = corner_seam(part);
        ASSERT_TRUE(seam) << k;
        EXPECT_EQ(seam->corner.size(), 4u);
        EXPECT_NEAR(seam->defect, pi / 2, 1e-9);
        EXPECT_NEAR(seam->length, 4 * box.height, 1e-9) << "straight up between two walls";
        const TriMesh cut = cut_at(part, *seam);
        EXPECT_TRUE(surface_type(cut).sheet());
        EXPECT_LT(angle_defects(cut).cwiseAbs().sum(), 1e-9);
    }
}

TEST(CornerSeam, APyramidIsCutFromItsTopToItsBorder)
{
    for (const int sides : {3, 4, 7}) {
        const TriMesh part = pyramid(sides, 30, 25);
        const auto seam = corner_seam(part);
        ASSERT_TRUE(seam) << sides;
        EXPECT_EQ(seam->corner, std::vector<int>{sides});
        EXPECT_NEAR(seam->length, std::hypot(30, 25), 1e-9);
        const double wall = 2 * std::asin(30 * std::sin(pi / sides) / std::hypot(30, 25));
        EXPECT_NEAR(seam->defect, 2 * pi - sides * wall, 1e-9);
    }
}

TEST(CornerSeam, AHoopIsCutFromOneEndToTheOther)
{
    for (const int sides : {4, 24, 90})
        for (const double top : {20., 26., 45.})
            for (const int rows : {1, 3}) {
                const double height = 12, edge = std::hypot(top - 20, height);
                const TriMesh part = frustum(sides, 20, top, height, rows);
                const auto seam = corner_seam(part);
                ASSERT_TRUE(seam) << sides << ", " << top;
                EXPECT_TRUE(seam->corner.empty());
                EXPECT_EQ(seam->opening.size(), 1u);
                EXPECT_NEAR(seam->length, edge, 1e-9) << "along an edge between two walls";
                // the apex of the pyramid that it is a part of: what is left there of a full turn
                const double fan = sides * 2 * std::asin((top - 20) * std::sin(pi / sides) / edge);
                EXPECT_NEAR(seam->defect, 2 * pi - fan, 1e-6);
                EXPECT_TRUE(surface_type(cut_at(part, *seam)).sheet());
            }
}

TEST(CornerSeam, AWasherThatIsNearlyFlatHasNone)
{
    EXPECT_FALSE(corner_seam(frustum(60, 20, 40, 0, 3)));
    EXPECT_FALSE(corner_seam(frustum(60, 20, 40, 2, 3))) << "5 degrees of slope take 0.03 of a turn";
}

TEST(CornerSeam, WhatUnrollsOrIsCurvedAllOverHasNone)
{
    shapes::LippedBox open;
    open.joined = false;
    EXPECT_FALSE(corner_seam(shapes::lipped_box(open)));
    EXPECT_FALSE(corner_seam(shapes::hat_channel().mesh));
    EXPECT_FALSE(corner_seam(shapes::perforated_channel().mesh));
    EXPECT_FALSE(corner_seam(shapes::dome({.triangles = 3000}).mesh));
    EXPECT_FALSE(corner_seam(shapes::round_cup()));
    EXPECT_FALSE(corner_seam(shapes::noisy(shapes::lipped_box(), 0.5))) << "too many corners";
    EXPECT_FALSE(corner_seam(shapes::noisy(shapes::lipped_box(), 0.03))) << "four corners, but it would not unroll";
}

} // namespace spia
