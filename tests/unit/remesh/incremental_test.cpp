#include "engine/remesh/incremental.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

TriMesh divided(const TriMesh& mesh, double size, double most_edges)
{
    const KeptLines lines = kept_lines(mesh, {}, 0.7, 0.7, size);
    return remesh_incrementally(mesh, lines, Eigen::VectorXd::Constant(mesh.vertices(), size), ClosestPointSearch(mesh),
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

} // namespace
} // namespace spia
