#include "tests/support/mesh_tools.h"

#include <Eigen/LU>

#include "tests/support/shapes.h"
#include "tests/unit/support/expectations.h"

namespace spia::shapes {
namespace {

TEST(MeshTools, ConvergenceOrderOfAPowerIsItsExponent)
{
    EXPECT_NEAR(convergence_order({1, 0.5, 0.25, 0.125}, {3, 0.75, 0.1875, 0.046875}), 2, 1e-12);
}

TEST(MeshTools, RandomRotationIsARotation)
{
    for (std::uint64_t seed : {1, 2, 3}) {
        const Eigen::Matrix3d R = random_rotation(seed);
        EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
        EXPECT_NEAR(R.determinant(), 1, 1e-14);
        EXPECT_EQ(R, random_rotation(seed));
        EXPECT_NE(R, random_rotation(seed + 1));
    }
}

TEST(MeshTools, PermutationCarriesEveryFaceAlong)
{
    const TriMesh mesh = rectangle(30, 20, 6, 5);
    const Permuted shuffled = permuted(mesh, 7);
    EXPECT_NE(shuffled.mesh.triangle, mesh.triangle);
    const Eigen::Matrix3Xd before = area_vectors(mesh), after = area_vectors(shuffled.mesh);
    for (int f = 0; f < mesh.triangles(); ++f) {
        EXPECT_LT((before.col(f) - after.col(shuffled.face[f])).norm(), 1e-12);
        int sum = 0;
        for (int k = 0; k < 3; ++k)
            sum += shuffled.vertex[mesh.triangle(k, f)];
        EXPECT_EQ(sum, shuffled.mesh.triangle.col(shuffled.face[f]).sum());
    }
    for (int v = 0; v < mesh.vertices(); ++v)
        EXPECT_EQ(mesh.position.col(v), shuffled.mesh.position.col(shuffled.vertex[v]));
}

TEST(MeshTools, MirrorImageKeepsItsOuterSide)
{
    const TriMesh mesh = rectangle(30, 20, 3, 2), image = mirrored(mesh);
    EXPECT_GT(least_upward(image), 0.999);
    EXPECT_EQ(image.position.row(0).minCoeff(), -30);
}

TEST(MeshTools, MeasuresOfAGridOfSquares)
{
    const TriMesh mesh = rectangle(4, 4, 4, 4); // 20 + 20 sides of 1 mm and 16 diagonals
    EXPECT_NEAR(mean_edge(mesh), (40 + 16 * std::sqrt(2.0)) / 56, 1e-14);
    EXPECT_NEAR(least_angles(mesh).maxCoeff(), std::numbers::pi / 4, 1e-14);
    EXPECT_LT(largest_angle_defect(mesh), 1e-14);
    EXPECT_EQ(share_below(edge_lengths(mesh), 1.2), 40.0 / 56);
    EXPECT_EQ(boundary_loops(joined(mesh, mesh)).size(), 2u);
}

} // namespace
} // namespace spia::shapes
