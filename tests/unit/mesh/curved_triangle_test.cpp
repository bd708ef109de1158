#include "engine/mesh/smooth/curved_triangle.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/support/seeded_random.h"

namespace spia {
namespace {

constexpr double radius = 10;

/// About the z axis.
CurvedTriangle on_cylinder(const Eigen::Matrix<double, 2, 3>& flat)
{
    CurvedTriangle result;
    for (int k = 0; k < 3; ++k) {
        const double turn = flat(0, k) / radius;
        result.normal.col(k) << std::cos(turn), std::sin(turn), 0;
        result.corner.col(k) = radius * result.normal.col(k) + Eigen::Vector3d(0, 0, flat(1, k));
    }
    return result;
}

CurvedTriangle on_sphere(const Eigen::Vector3d& about, const Eigen::Matrix<double, 2, 3>& flat)
{
    CurvedTriangle result;
    const Eigen::Vector3d x = about.unitOrthogonal(), y = about.cross(x);
    for (int k = 0; k < 3; ++k) {
        result.normal.col(k) = (about + x * flat(0, k) / radius + y * flat(1, k) / radius).normalized();
        result.corner.col(k) = radius * result.normal.col(k);
    }
    return result;
}

Eigen::Matrix<double, 2, 3> random_triangle(shapes::SeededRandom& random, double size)
{
    Eigen::Matrix<double, 2, 3> flat;
    flat << 0, 1, 0.2, 0, 0.1, 0.9;
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 2; ++i)
            flat(i, k) = size * (flat(i, k) + random.between(-0.15, 0.15));
    return flat;
}

double edge(const Eigen::Matrix<double, 2, 3>& x, int k) { return (x.col((k + 1) % 3) - x.col(k)).norm(); }

} // namespace

TEST(CurvedTriangle, OfACylinderIsLaidAsItUnrolls)
{
    shapes::SeededRandom random(3);
    for (int trial = 0; trial < 100; ++trial) {
        const auto flat = random_triangle(random, 5); // up to half a radian
        const auto laid = on_cylinder(flat).laid();
        ASSERT_TRUE(laid);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(edge(*laid, k) / edge(flat, k), 1, 3e-4) << "chords are shorter by 1e-2";
    }
}

TEST(CurvedTriangle, OfASphereHasTheAreaBetweenGreatCirclesAndTheirRatios)
{
    shapes::SeededRandom random(5);
    for (int trial = 0; trial < 100; ++trial) {
        const Eigen::Vector3d about =
            Eigen::Vector3d(random.between(-1, 1), random.between(-1, 1), random.between(0.1, 1)).normalized();
        const CurvedTriangle triangle = on_sphere(about, random_triangle(random, 4));
        const auto laid = triangle.laid();
        ASSERT_TRUE(laid);
        const Eigen::Matrix3d& n = triangle.normal;
        const auto angle = [&](int k) { return std::acos(n.col(k).dot(n.col((k + 1) % 3))); };
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(edge(*laid, k) / edge(*laid, (k + 1) % 3), angle(k) / angle((k + 1) % 3), 1e-9);
        // [van Oosterom and Strackee 1983]
        const double excess = 2 * std::atan2(n.determinant(), 1 + n.col(0).dot(n.col(1)) + n.col(1).dot(n.col(2)) +
                                                                  n.col(2).dot(n.col(0)));
        const Eigen::Vector2d p = laid->col(1) - laid->col(0), q = laid->col(2) - laid->col(0);
        EXPECT_NEAR((p[0] * q[1] - p[1] * q[0]) / 2 / (radius * radius * excess), 1, 3e-3)
            << "plane ones with these sides are too small by up to 2e-2";
    }
}

TEST(CurvedTriangle, IsOnTheSurfaceToFourthOrder)
{
    const Eigen::Vector3d about = Eigen::Vector3d(1, 2, 3).normalized();
    double before = 0;
    for (const double size : {4., 2., 1.}) {
        shapes::SeededRandom random(7);
        double off = 0;
        for (int trial = 0; trial < 50; ++trial) {
            const CurvedTriangle triangle = on_sphere(about, random_triangle(random, size));
            const Eigen::Vector3d weight =
                Eigen::Vector3d(random.between(0.1, 1), random.between(0.1, 1), random.between(0.1, 1));
            off = std::max(off, std::abs(triangle.on_surface(weight / weight.sum()).norm() - radius));
            for (int k = 0; k < 3; ++k)
                EXPECT_LT((triangle.on_surface(Eigen::Vector3d::Unit(k)) - triangle.corner.col(k)).norm(), 1e-12);
        }
        if (before > 0)
            EXPECT_GT(before / off, 12) << size << " mm: " << off;
        before = off;
    }
}

TEST(CurvedTriangle, ThatIsFlatOrTurnsTooFarIsNotLaid)
{
    CurvedTriangle flat{Eigen::Matrix3d::Identity(), Eigen::Vector3d(1, 1, 1).normalized().replicate<1, 3>()};
    EXPECT_FALSE(flat.laid());
    Eigen::Matrix<double, 2, 3> wide;
    wide << 0, 0.45 * 2 * std::numbers::pi * radius, 5, 0, 0, 20;
    EXPECT_FALSE(on_cylinder(wide).laid());
}

} // namespace spia
