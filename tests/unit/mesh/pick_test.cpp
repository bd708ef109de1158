#include "engine/mesh/pick.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "engine/core/error.h"
#include "engine/core/infinity.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"

namespace spia::pick_test {
namespace {

Eigen::Vector3d random_point(std::mt19937& random, double size)
{
    std::uniform_real_distribution<double> coordinate(-size, size);
    return {coordinate(random), coordinate(random), coordinate(random)};
}

TriMesh soup(std::mt19937& random, int triangles, double size)
{
    TriMesh mesh;
    mesh.position.resize(3, 3 * triangles);
    mesh.triangle.resize(3, triangles);
    for (int f = 0; f < triangles; ++f) {
        const Eigen::Vector3d centre = random_point(random, 100);
        for (int k = 0; k < 3; ++k) {
            mesh.position.col(3 * f + k) = centre + random_point(random, size);
            mesh.triangle(k, f) = 3 * f + k;
        }
    }
    return mesh;
}

/// Distance to one face by solving origin + t direction = a + u (b - a) + v (c - a).
double distance_to(const TriMesh& mesh, int f, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
{
    const auto t = mesh.triangle.col(f);
    const Eigen::Vector3d a = mesh.position.col(t[0]);
    Eigen::Matrix3d system;
    system << mesh.position.col(t[1]) - a, mesh.position.col(t[2]) - a, -direction;
    const Eigen::Vector3d uvt = system.inverse() * (origin - a);
    return uvt[0] >= 0 && uvt[1] >= 0 && uvt[0] + uvt[1] <= 1 && uvt[2] >= 0 ? uvt[2] : infinity;
}

Eigen::Vector3d place(const TriMesh& mesh, const RayHit& hit)
{
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
        result += hit.barycentric[k] * mesh.position.col(mesh.triangle(k, hit.face));
    return result;
}

} // namespace

TEST(RayPicker, MeetsFirstWhatTryingAllFacesMeetsFirst)
{
    std::mt19937 random(7);
    for (const double size : {5., 30., 150.}) { // from grains far from each other to triangles all
                                                // through each other
        const TriMesh mesh = soup(random, 500, size);
        const RayPicker picker(mesh);
        int met = 0;
        for (int i = 0; i < 400; ++i) {
            const Eigen::Vector3d origin = random_point(random, 150), direction = random_point(random, 3);
            int truth = -1;
            double nearest = infinity;
            for (int f = 0; f < mesh.triangles(); ++f)
                if (const double t = distance_to(mesh, f, origin, direction); t < nearest) {
                    nearest = t;
                    truth = f;
                }
            const RayHit hit = picker.first(origin, direction);
            ASSERT_EQ(hit.face, truth);
            if (truth < 0)
                continue;
            ++met;
            EXPECT_NEAR(hit.distance, nearest, 1e-9);
            EXPECT_LT((place(mesh, hit) - origin - hit.distance * direction).norm(), 1e-9);
            EXPECT_GE(hit.barycentric.minCoeff(), 0);
            EXPECT_NEAR(hit.barycentric.sum(), 1, 1e-14);
        }
        EXPECT_GT(met, 10);
    }
}

TEST(RayPicker, NoRaySlipsThroughBetweenTwoFaces)
{
    // Rays at every vertex and every middle of an edge of a tilted plate, where rounding decides
    // for one face or another.
    for (const std::uint64_t seed : {0, 1, 2, 3}) {
        const Eigen::Matrix3d turn = seed == 0 ? Eigen::Matrix3d::Identity() : shapes::random_rotation(seed);
        const TriMesh plate = shapes::transformed(shapes::rectangle(17, 13, 12, 9), turn, {0.1, 0.2, 0.3});
        const RayPicker picker(plate);
        const Eigen::Vector3d above = turn * Eigen::Vector3d(0, 0, 20), viewer = turn * Eigen::Vector3d(8, 6, 90);
        for (int f = 0; f < plate.triangles(); ++f)
            for (int k = 0; k < 3; ++k) {
                const Eigen::Vector3d a = plate.position.col(plate.triangle(k, f));
                const Eigen::Vector3d b = plate.position.col(plate.triangle((k + 1) % 3, f));
                const Eigen::Vector3d local = turn.transpose() * ((a + b) / 2 - Eigen::Vector3d(0.1, 0.2, 0.3));
                const bool on_border = local.x() < 0.01 || local.y() < 0.01 || local.x() > 16.99 || local.y() > 12.99;
                if (on_border && seed > 0)
                    continue; // there rounding may put it outside of all
                for (const Eigen::Vector3d& at : {Eigen::Vector3d((a + b) / 2), Eigen::Vector3d(0.25 * a + 0.75 * b)}) {
                    EXPECT_GE(picker.first(at + above, -above).face, 0);
                    EXPECT_GE(picker.first(viewer, at - viewer).face, 0);
                }
            }
    }
}

TEST(RayPicker, RaysAlongTheAxesMeetPlatesThatLieOnBoxesSides)
{
    // Straight down onto a grid: boxes without height, rays along their sides. Everything is exact
    // here.
    const TriMesh plate = shapes::rectangle(8, 8, 8, 8);
    const RayPicker picker(plate);
    for (int v = 0; v < plate.vertices(); ++v)
        for (const double side : {1., -1.})
            for (const double zero : {0., -0.}) {
                const RayHit hit =
                    picker.first(plate.position.col(v) + Eigen::Vector3d(0, 0, 5 * side), {zero, zero, -side});
                ASSERT_GE(hit.face, 0);
                EXPECT_EQ(hit.distance, 5);
                for (int f = 0; f < hit.face; ++f) // of the faces around the vertex the first
                    EXPECT_FALSE((plate.triangle.col(f).array() == v).any());
            }
}

TEST(RayPicker, FacesBehindTheOriginAreNotMet)
{
    const RayPicker picker(shapes::rectangle(8, 8, 2, 2));
    EXPECT_EQ(picker.first({3, 4, 1}, {0, 0, 1}).face, -1);
    EXPECT_EQ(picker.first({3, 4, -1}, {0, 0, -1}).face, -1);
    EXPECT_NEAR(picker.first({3, 4, 1}, {0, 0, -4}).distance, 0.25, 1e-15);
}

TEST(RayPicker, HiddenIsWhatAnotherFaceStandsBefore)
{
    std::mt19937 random(8);
    const TriMesh mesh = soup(random, 300, 40);
    const RayPicker picker(mesh);
    const Eigen::Vector3d eye(20, -10, 400);
    int hidden = 0;
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Eigen::Vector3d middle = mesh.position.middleCols<3>(3 * f).rowwise().mean();
        bool truth = false;
        for (int g = 0; g < mesh.triangles(); ++g)
            truth = truth || (g != f && distance_to(mesh, g, eye, middle - eye) < 1);
        EXPECT_EQ(picker.hidden(f, middle, eye), truth);
        hidden += truth;
    }
    EXPECT_GT(hidden, 20);
    EXPECT_LT(hidden, 290);
}

TEST(RayPicker, ASecondLayerAtTheSameHeightHidesNothing)
{
    const TriMesh plate = shapes::rectangle(8, 8, 4, 4);
    const TriMesh both = shapes::joined(plate, plate);
    const RayPicker picker(both);
    for (int f = 0; f < both.triangles(); ++f) {
        const Eigen::Vector3d middle =
            (both.position.col(both.triangle(0, f)) + both.position.col(both.triangle(1, f)) +
             both.position.col(both.triangle(2, f))) /
            3;
        EXPECT_FALSE(picker.hidden(f, middle, middle + Eigen::Vector3d(1, 2, 50)));
    }
}

TEST(RayPicker, NearMissesNoFaceInsideAndFewOutside)
{
    std::mt19937 random(9);
    const TriMesh mesh = soup(random, 2000, 3);
    const RayPicker picker(mesh);
    Eigen::Matrix4Xd slab(4, 3); // x > 20, x + y < 60, z > -50
    slab << 1, -1, 0, 0, -1, 0, 0, 0, 1, -20, 60, 50;
    std::vector<int> found = picker.near(slab);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Eigen::Matrix3d t = mesh.position.middleCols<3>(3 * f);
        bool inside = true, far_outside = false;
        for (const auto& plane : slab.colwise()) {
            const Eigen::RowVector3d signed_distance = (plane.head<3>().transpose() * t).array() + plane[3];
            inside = inside && signed_distance.maxCoeff() >= 0;
            far_outside = far_outside || signed_distance.maxCoeff() < -60;
        }
        const bool there = std::binary_search(found.begin(), found.end(), f);
        EXPECT_TRUE(there || !inside);
        EXPECT_FALSE(there && far_outside);
    }
}

TEST(RayPicker, BoxIsThatOfItsFaces)
{
    TriMesh mesh = shapes::rectangle(30, 20, 6, 4);
    EXPECT_EQ(RayPicker(mesh).box().max(), Eigen::Vector3d(30, 20, 0));
    mesh.triangle(1, 4) = 99;
    EXPECT_THROW(RayPicker{mesh}, InputError);
    EXPECT_THROW(RayPicker(TriMesh{}), InputError);
}

} // namespace spia::pick_test
