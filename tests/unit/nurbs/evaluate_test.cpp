#include "engine/nurbs/evaluate.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/known_surfaces.h"

namespace spia {

TEST(Evaluate, QuarterCylinderWithWeightsIsExactlyRound)
{
    const double radius = 37, length = 80;
    const NurbsSurface s = surfaces::quarter_cylinder(radius, length);
    for (int i = 0; i <= 20; ++i)
        for (double v : {0., 0.3, 1.}) {
            const SurfacePoint p = evaluate(s, i / 20., v);
            EXPECT_NEAR(std::hypot(p.position.x(), p.position.z()), radius, 1e-13 * radius);
            EXPECT_NEAR(p.position.y(), v * length, 1e-13 * length);
            const Eigen::Vector3d outward(p.position.x() / radius, 0, p.position.z() / radius);
            EXPECT_LT((p.normal() - outward).norm(), 1e-13);
            // curvature along u = L / E, of the fundamental forms
            EXPECT_NEAR(p.normal().dot(p.S_uu) / p.S_u.squaredNorm(), -1 / radius, 1e-12 / radius);
        }
}

TEST(Evaluate, SphereHasTheSameCurvatureInEveryDirection)
{
    const double radius = 50;
    const NurbsSurface s = surfaces::sphere_patch(radius);
    for (int i = 0; i <= 10; ++i)
        for (int j = 0; j <= 10; ++j) {
            const SurfacePoint p = evaluate(s, i / 10., j / 10.);
            const Eigen::Vector3d n = p.normal();
            EXPECT_NEAR(p.position.norm(), radius, 1e-13 * radius);
            EXPECT_LT((n - p.position / radius).norm(), 1e-13);
            // On a sphere the second fundamental form is the first one times -1 / radius.
            EXPECT_NEAR(n.dot(p.S_uu), -p.S_u.squaredNorm() / radius, 1e-10);
            EXPECT_NEAR(n.dot(p.S_uv), -p.S_u.dot(p.S_v) / radius, 1e-10);
            EXPECT_NEAR(n.dot(p.S_vv), -p.S_v.squaredNorm() / radius, 1e-10);
        }
}

TEST(Evaluate, DerivativesOfARationalSurfaceAreTheLimitsOfDifferences)
{
    const NurbsSurface s = surfaces::crooked();
    const double h = 1e-5;
    const auto expect_equal = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        EXPECT_LT((a - b).norm(), 1e-5 * (10 + b.norm())) << a.transpose() << " and " << b.transpose();
    };
    for (double u : {0.1, 0.3, 0.5, 0.8})
        for (double v : {0.15, 0.35, 0.7}) {
            const SurfacePoint p = evaluate(s, u, v);
            const SurfacePoint left = evaluate(s, u - h, v), right = evaluate(s, u + h, v);
            const SurfacePoint below = evaluate(s, u, v - h), above = evaluate(s, u, v + h);
            expect_equal(p.S_u, (right.position - left.position) / (2 * h));
            expect_equal(p.S_v, (above.position - below.position) / (2 * h));
            expect_equal(p.S_uu, (right.S_u - left.S_u) / (2 * h));
            expect_equal(p.S_uv, (above.S_u - below.S_u) / (2 * h));
            expect_equal(p.S_uv, (right.S_v - left.S_v) / (2 * h));
            expect_equal(p.S_vv, (above.S_v - below.S_v) / (2 * h));
        }
}

TEST(Evaluate, CornersAreCornerControlPointsAndThereIsNothingBeyond)
{
    const NurbsSurface s = surfaces::crooked();
    EXPECT_LT((evaluate(s, 0, 0).position - s.control.col(0)).norm(), 1e-14);
    EXPECT_LT((evaluate(s, 1, 1).position - s.control.col(34)).norm(), 1e-13);
    EXPECT_EQ(evaluate(s, 1.5, -0.2).position, evaluate(s, 1, 0).position);
}

TEST(Evaluate, NormalOfACollapsedSideIsZeroAndNotRounding)
{
    NurbsSurface s = surfaces::quarter_cylinder(10, 20);
    for (int i = 0; i < 3; ++i)
        s.control.col(s.index(i, 0)) << 1, 2, 3;
    EXPECT_EQ(evaluate(s, 0.3, 0).normal(), Eigen::Vector3d::Zero());
    EXPECT_NEAR(evaluate(s, 0.3, 0.5).normal().norm(), 1, 1e-15);
}

} // namespace spia
