#include "engine/forming/process/held_edges.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace spia {

TEST(HeldEdges, AreThoseOfTheOutlineEachWithItsFace)
{
    const TriMesh part = shapes::rectangle(50, 40, 5, 4);
    const std::vector<HeldEdge> held = held_edges(part);
    EXPECT_EQ(held.size(), 18u);
    for (const HeldEdge& edge : held) {
        const auto corner = part.triangle.col(edge.face);
        EXPECT_TRUE((corner.array() == edge.from).any() && (corner.array() == edge.to).any());
    }
}

TEST(HeldEdges, AreNoneOnASeam)
{
    // The long sides of a strip lie on each other, as where a tube was cut open.
    TriMesh part = shapes::rectangle(50, 40, 5, 4);
    for (int v = 0; v < part.vertices(); ++v) {
        const double angle = 2 * M_PI * part.position(1, v) / 40;
        const bool end = part.position(1, v) == 40;
        part.position.col(v) << part.position(0, v), end ? 1 : std::cos(angle), end ? 0 : std::sin(angle);
    }
    EXPECT_EQ(held_edges(part).size(), 8u); // the ends of the tube
}

} // namespace spia
