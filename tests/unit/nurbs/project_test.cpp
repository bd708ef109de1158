#include "engine/nurbs/project.h"

#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "engine/core/error.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/tessellate.h"
#include "tests/support/known_surfaces.h"

namespace spia {

TEST(SurfaceProjection, FootOnASphereIsOnTheLineThroughItsCentre)
{
    const double radius = 50;
    const SurfaceProjection projection(surfaces::sphere_patch(radius), 4);
    std::mt19937 random(1);
    // from near the centre to far outside
    std::uniform_real_distribution<double> angle(-0.78, 0.78), size(0.05, 3);
    for (int i = 0; i < 2000; ++i) {
        const double azimuth = angle(random), latitude = angle(random);
        const Eigen::Vector3d direction(std::cos(latitude) * std::cos(azimuth), std::cos(latitude) * std::sin(azimuth),
                                        std::sin(latitude));
        const Eigen::Vector3d point = size(random) * radius * direction;
        const SurfaceFoot foot = projection.nearest(point);
        EXPECT_NEAR(foot.distance, std::abs(point.norm() - radius), 1e-10);
        EXPECT_LT((foot.position - radius * direction).norm(), 1e-7);
        EXPECT_EQ(foot.position, evaluate(surfaces::sphere_patch(radius), foot.u, foot.v).position);
    }
}

TEST(SurfaceProjection, PointBesideTheCylinderGoesToItsEdgeOrCorner)
{
    const double radius = 30, length = 40; // from (0, y, 30) to (30, y, 0)
    const SurfaceProjection projection(surfaces::quarter_cylinder(radius, length), 2);
    const auto expect_foot = [&](const Eigen::Vector3d& point, const Eigen::Vector3d& truth) {
        EXPECT_LT((projection.nearest(point).position - truth).norm(), 1e-9) << point.transpose();
    };
    const double c = std::cos(0.7), s = std::sin(0.7);
    // beyond an end, inside the round
    expect_foot({20 * c, 55, 20 * s}, {radius * c, length, radius * s});
    expect_foot({90 * c, -5, 90 * s}, {radius * c, 0, radius * s});
    expect_foot({35, 10, -8}, {radius, 10, 0}); // below a straight edge
    expect_foot({35, 50, -8}, {radius, length, 0});
    expect_foot({-3, -4, 31}, {0, 0, radius});
}

TEST(SurfaceProjection, NothingOnACrookedSurfaceIsNearerThanTheFoot)
{
    const NurbsSurface surface = surfaces::crooked();
    const SurfaceProjection projection(surface, 4);
    const Tessellation dense = tessellate(surface, 60);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> x(-10, 80), y(-10, 60), z(-15, 15);
    for (int i = 0; i < 300; ++i) {
        Eigen::Vector3d point;
        for (const int k : {2, 1, 0}) // the same points with every compiler
            point[k] = k == 2 ? z(random) : k == 1 ? y(random) : x(random);
        const double among_samples =
            std::sqrt((dense.mesh.position.colwise() - point).colwise().squaredNorm().minCoeff());
        EXPECT_LE(projection.nearest(point).distance, among_samples + 1e-9) << point.transpose();
    }
}

TEST(SurfaceProjection, PointOfTheSurfaceIsItsOwnFoot)
{
    const NurbsSurface surface = surfaces::crooked();
    const SurfaceProjection projection(surface);
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j)
            EXPECT_LT(projection.nearest(evaluate(surface, i / 20., j / 20.).position).distance, 1e-11)
                << i << ' ' << j;
}

TEST(SurfaceProjection, ThatIsBeingMadeCanBeCancelled)
{
    constexpr int samples = 150; // 10^5 triangles and more
    int seen = 0;
    const SurfaceProjection made(surfaces::crooked(), samples, Progress([&](double, std::string_view) { ++seen; }));
    EXPECT_GT(seen, 8) << "while it is tessellated, and while the triangles are sorted";
    for (const int stop : {1, seen / 2, seen - 1}) {
        const auto cancel = std::make_shared<std::atomic<bool>>(false);
        int now = 0;
        EXPECT_THROW(SurfaceProjection(surfaces::crooked(), samples,
                                       Progress([&](double, std::string_view) { *cancel = ++now == stop; }, cancel)),
                     Cancelled)
            << stop;
    }
}

} // namespace spia
