#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/remesh/triangle_quality.h"
#include "tests/support/shapes.h"

namespace spia::total_curvature_test {
namespace {

constexpr double pi = std::numbers::pi;

/// The grid over [0, 1]^2 put in space.
template <class Place> TriMesh placed(int columns, int rows, const Place& place)
{
    TriMesh mesh = shapes::rectangle(1, 1, columns, rows);
    for (int v = 0; v < mesh.vertices(); ++v)
        mesh.position.col(v) = place(mesh.position(0, v), mesh.position(1, v));
    return mesh;
}

TEST(TotalCurvature, OfStripsThatUnrollIsNothing)
{
    const TriMesh strips = placed(
        40, 3, [](double s, double t) { return Eigen::Vector3d(10 * std::sin(2 * s), 80 * t, 10 * std::cos(2 * s)); });
    EXPECT_LT(total_curvature(strips), 1e-12);
    const TriMesh cone = placed(40, 3, [](double s, double t) {
        const double r = 10 + 30 * t;
        return Eigen::Vector3d(r * std::cos(2 * s), r * std::sin(2 * s), 50 * t);
    });
    EXPECT_LT(total_curvature(cone), 1e-12);
}

TEST(TotalCurvature, OfASphereIsItsSolidAngle)
{
    EXPECT_NEAR(total_curvature(shapes::closed_sphere(30, 2000)), 4 * pi, 1e-9)
        << "Gauss and Bonnet, whatever the triangles";
}

TEST(TotalCurvature, OfASaddleAddsWhatIsNegative)
{
    const double bend = 0.05; // z = bend x y: K = -bend^2 / (1 + bend^2 (x^2 + y^2))^2
    const int cells = 60;
    const TriMesh saddle = placed(cells, cells, [&](double s, double t) {
        const double x = 2 * s - 1, y = 2 * t - 1;
        return Eigen::Vector3d(x, y, bend * x * y);
    });
    double expected = 0; // K dA over the dual cells of the vertices off the boundary, by the middle
                         // of each
    for (int i = 1; i < cells; ++i)
        for (int j = 1; j < cells; ++j) {
            const double h = 2.0 / cells, x = i * h - 1, y = j * h - 1;
            expected += bend * bend * h * h / std::pow(1 + bend * bend * (x * x + y * y), 1.5);
        }
    EXPECT_NEAR(total_curvature(saddle) / expected, 1, 1e-2);
}

} // namespace
} // namespace spia::total_curvature_test
