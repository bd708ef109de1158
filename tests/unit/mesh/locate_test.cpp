#include "engine/mesh/locate.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "tests/support/shapes.h"

namespace spia {

namespace {

/// A unit square of slivers: the columns of a grid get narrower and narrower.
TriMesh graded_square(int n)
{
    TriMesh mesh = shapes::rectangle(1, 1, n, 3);
    mesh.position.row(0) = mesh.position.row(0).array().pow(4);
    return mesh;
}

Eigen::Vector2d evaluate(const TriMesh& mesh, const MeshPoint& place)
{
    Eigen::Vector2d p = Eigen::Vector2d::Zero();
    for (int k = 0; k < 3; ++k)
        p += place.barycentric[k] * mesh.position.col(mesh.triangle(k, place.face)).head<2>();
    return p;
}

/// The distance to a triangle by dense sampling of nothing but its three edges and its inside.
double distance_to_face(const Eigen::Vector2d& p, const TriMesh& mesh, int face)
{
    std::array<Eigen::Vector2d, 3> c;
    for (int k = 0; k < 3; ++k)
        c[size_t(k)] = mesh.position.col(mesh.triangle(k, face)).head<2>();
    double distance = 1e300;
    bool inside = true;
    for (size_t k = 0; k < 3; ++k) {
        const Eigen::Vector2d a = c[k], edge = c[(k + 1) % 3] - a;
        const double t = std::min(1.0, std::max(0.0, (p - a).dot(edge) / edge.squaredNorm()));
        distance = std::min(distance, (a + t * edge - p).norm());
        inside = inside && edge.x() * (p - a).y() - edge.y() * (p - a).x() >= 0;
    }
    return inside ? 0 : distance;
}

} // namespace

TEST(Locate, EveryPointAgreesWithAScanOverAllTriangles)
{
    const TriMesh mesh = graded_square(30);
    const PlanarLocator locator(mesh.position.topRows(2), mesh.triangle);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-0.3, 1.3);
    for (int i = 0; i < 500; ++i) {
        const Eigen::Vector2d p(coordinate(random), coordinate(random));
        double nearest = 1e300;
        for (int f = 0; f < mesh.triangles(); ++f)
            nearest = std::min(nearest, distance_to_face(p, mesh, f));
        const MeshPoint found = locator.nearest(p);
        EXPECT_NEAR(found.distance, nearest, 1e-14) << p.transpose();
        EXPECT_NEAR((evaluate(mesh, found) - p).norm(), nearest, 1e-14);
        EXPECT_NEAR(found.barycentric.sum(), 1, 1e-14);
        EXPECT_GE(found.barycentric.minCoeff(), 0);
        EXPECT_EQ(locator.covering(p).empty(), nearest > locator.tolerance());
    }
}

TEST(Locate, APointOnAnEdgeOrAVertexIsCoveredByAllFacesAround)
{
    const TriMesh mesh = shapes::rectangle(2, 2, 2, 2);
    const PlanarLocator locator(mesh.position.topRows(2), mesh.triangle);
    EXPECT_EQ(locator.covering({1, 1}).size(), 6u);
    EXPECT_EQ(locator.covering({0.5, 0.5}).size(), 2u);
    EXPECT_EQ(locator.covering({0.6, 0.3}).size(), 1u);
    EXPECT_EQ(locator.nearest({1, 1}).distance, 0);
    EXPECT_EQ(locator.covering({0.6, -1e-13}).size(), 1u) << "rounding must not lose a point on the border";
    EXPECT_TRUE(locator.covering({0.6, -1e-6}).empty());
}

TEST(Locate, ASecondLayerAndATurnedFaceAreFoundToo)
{
    TriMesh mesh = shapes::rectangle(1, 1, 1, 1);
    mesh.triangle.conservativeResize(3, 3);
    mesh.triangle.col(2) << 0, 2, 1; // face 0 has 0, 1, 3
    const PlanarLocator locator(mesh.position.topRows(2), mesh.triangle);
    const auto found = locator.covering({0.5, 0.1});
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].face, 0);
    EXPECT_EQ(found[1].face, 2);
    EXPECT_NEAR((evaluate(mesh, found[1]) - Eigen::Vector2d(0.5, 0.1)).norm(), 0, 1e-15);
}

} // namespace spia
