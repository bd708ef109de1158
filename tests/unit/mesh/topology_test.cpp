#include "engine/mesh/halfedges.h"
#include "engine/mesh/topology.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/support/shapes.h"

namespace spia {

TEST(Topology, BoundaryOfARectangleRunsCounterClockwiseAroundIt)
{
    const TriMesh mesh = shapes::rectangle(30, 20, 3, 2);
    const auto loops = boundary_loops(mesh);
    ASSERT_EQ(loops.size(), 1u);
    double doubled_area = 0;
    for (size_t i = 0; i < loops[0].size(); ++i) {
        const auto a = mesh.position.col(loops[0][i]), b = mesh.position.col(loops[0][(i + 1) % loops[0].size()]);
        doubled_area += a.x() * b.y() - a.y() * b.x();
    }
    EXPECT_EQ(loops[0].size(), 10u);
    EXPECT_EQ(loops[0][0], 0);
    EXPECT_NEAR(doubled_area, 2 * 30 * 20, 1e-9);
    EXPECT_NEAR(area(mesh), 600, 1e-9);
}

TEST(Topology, ThirdFaceOnAnEdgeIsNamed)
{
    TriMesh mesh;
    mesh.position.setRandom(3, 5);
    mesh.triangle.resize(3, 3);
    mesh.triangle << 0, 1, 0, /**/ 1, 0, 1, /**/ 2, 3, 4;
    try {
        halfedges(mesh);
        FAIL() << "three faces on the edge 0-1 were accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("face 2"), std::string::npos) << error.what();
    }
}

TEST(Topology, AMeshWithoutVerticesHasNoExtent) { EXPECT_EQ(bounding_diagonal(TriMesh{}), 0); }

} // namespace spia
