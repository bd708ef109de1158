#include "engine/remesh/incremental.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/core/error.h"
#include "engine/mesh/edge_graph.h"
#include "engine/mesh/topology.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/samples.h"
#include "tests/support/shapes.h"
#include "tests/unit/remesh/same_size.h"

namespace spia {
namespace {

TriMesh divided(const TriMesh& mesh, double size, double most_edges)
{
    const KeptLines lines = kept_lines(mesh, {}, 0.7, 0.7, size);
    return remesh_incrementally(mesh, lines, shapes::same_size(mesh, size), ClosestPointSearch(mesh),
                                {0.01, most_edges});
}

TEST(RemeshIncrementally, EndsWhereItWouldMakeTooManyEdges)
{
    const TriMesh plate = shapes::rectangle(10, 10, 10, 10); // becomes some 7000 edges
    EXPECT_GT(divided(plate, 0.2, 1e5).triangles(), 4000);
    try {
        divided(plate, 0.2, 1000);
        FAIL() << "more than 1000 edges were made";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("into more than 0.001 million edges"), std::string::npos) << text;
        double x = -1, y = -1, z = -1;
        ASSERT_EQ(std::sscanf(text.c_str(), "remeshing would cut the needles near %lf, %lf, %lf mm", &x, &y, &z), 3)
            << text;
        EXPECT_TRUE(x >= 0 && x <= 10 && y >= 0 && y <= 10 && z == 0) << text;
    }
}

/// The length of edges around vertices nearer than that to a place, mean, mm.
double edge_length_near(const TriMesh& mesh, const Eigen::Vector3d& place, double way)
{
    double sum = 0;
    int edges = 0;
    for (const EdgeGraph::Edge& edge : edge_graph(mesh).edge)
        if ((mesh.position.col(edge.low) - place).norm() < way) {
            sum += edge.length;
            ++edges;
        }
    return sum / edges;
}

/// Shares drawn at random for the vertices around random places of a dome, among them such on its
/// border.
TEST(RemeshIncrementally, RefinesWhereItIsToldAndLeavesAllElseAsItIs)
{
    const TriMesh dome = shapes::sample("dome").make(4000);
    const double size = 3;
    const KeptLines lines = kept_lines(dome, {}, 0.7, 0.7, size);
    const SizeField sizes = shapes::same_size(dome, size);
    const ClosestPointSearch search(dome);
    std::mt19937 random(3);
    for (int trial = 0; trial < 12; ++trial) {
        IncrementalRemesh remesh(dome, lines, sizes, search, {0.1});
        remesh.run();
        const TriMesh before = remesh.snapshot().mesh;
        Eigen::VectorXd share = Eigen::VectorXd::Ones(before.vertices());
        const std::vector<int> border = boundary_loops(before).at(0);
        const int v = trial % 3 == 0 ? border[random() % border.size()] : int(random() % unsigned(before.vertices()));
        share[v] = 0.4;
        const Eigen::Vector3d place = before.position.col(v);
        remesh.refine(share, 0.1, 0.35);
        const IncrementalRemesh::Snapshot after = remesh.snapshot();
        EXPECT_LT(edge_length_near(after.mesh, place, 1.5), 0.8 * edge_length_near(before, place, 1.5)) << trial;
        EXPECT_GT(after.mesh.triangles(), before.triangles());
        EXPECT_LT(after.mesh.triangles(), before.triangles() + 200) << "finer at one place only";
        EXPECT_EQ(boundary_loops(after.mesh).size(), 1u);
        EXPECT_GT(shapes::least_angles(after.mesh).minCoeff(), 0.4); // radians
        int same = 0;
        for (int f = 0; f < after.mesh.triangles(); ++f) {
            const int was = after.was[size_t(f)];
            const Eigen::Matrix3d now = after.mesh.position(Eigen::all, after.mesh.triangle.col(f));
            if (was >= 0) {
                ++same;
                EXPECT_EQ(now, before.position(Eigen::all, before.triangle.col(was)));
            } else
                EXPECT_LT((now.rowwise().mean() - place).norm(), 16 * size) << "far from what was to change";
        }
        EXPECT_GT(same, 0.5 * before.triangles());
    }
}

} // namespace
} // namespace spia
