#include "tests/support/check_grid.h"

#include <gtest/gtest.h>

#include "engine/coons/boundary.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

/// 8 x 6 cells over a rectangle of 8 x 6 mm.
struct Made {
    TriMesh part = shapes::rectangle(8, 6, 16, 12);
    Blank blank{part.position.topRows(2)};
    BlankBoundary boundary = split_boundary(blank, part, propose_corners(blank, part));
    GridResult grid = coons_grid(part, blank, boundary, {8, 6});

    std::string fault() const { return shapes::fault_of(grid, boundary); }
    bool names(const char* word) const { return fault().find(word) != std::string::npos; }
};

TEST(CheckGrid, FindsNothingInAGoodGrid) { EXPECT_EQ(Made().fault(), ""); }

TEST(CheckGrid, FindsAFold)
{
    Made made;
    made.grid.planar.position.col(made.grid.planar.node(3, 3)) += Eigen::Vector3d(1.5, 1.5, 0);
    EXPECT_TRUE(made.names("cell 3, 2 of 8 x 6 folds")) << made.fault();
    Made flat; // three nodes in a row: an angle of 180 degrees
    flat.grid.planar.position.col(flat.grid.planar.node(3, 3)) =
        (flat.grid.planar.position.col(flat.grid.planar.node(4, 3)) +
         flat.grid.planar.position.col(flat.grid.planar.node(3, 4))) /
        2;
    EXPECT_TRUE(flat.names("cell 3, 3")) << flat.fault();
    Made lost;
    lost.grid.planar.position(0, lost.grid.planar.node(2, 2)) = std::nan("");
    EXPECT_NE(lost.fault(), "");
}

TEST(CheckGrid, FindsANodeThatIsNotWhereItIsSaidToBe)
{
    Made moved;
    const int node = moved.grid.planar.node(3, 2);
    moved.grid.planar.position(0, node) += 1e-6;
    EXPECT_TRUE(moved.names("away from its place")) << moved.fault();
    Made off;
    off.grid.place[size_t(node)].face = -1;
    EXPECT_TRUE(off.names("is not on the blank")) << off.fault();
    Made beside; // the same point, of a triangle that it is not in
    MeshPoint& place = beside.grid.place[size_t(node)];
    place.barycentric = {1.5, -0.25, -0.25};
    EXPECT_TRUE(beside.names("is not on the blank")) << beside.fault();
}

TEST(CheckGrid, FindsABorderThatLeavesTheOutline)
{
    Made inside; // of the blank, and said so
    const int node = inside.grid.planar.node(3, 0);
    MeshPoint& place = inside.grid.place[size_t(node)];
    place.barycentric = (0.999 * place.barycentric.array() + 0.001 / 3).matrix();
    Eigen::Vector2d p = Eigen::Vector2d::Zero();
    for (int k = 0; k < 3; ++k)
        p += place.barycentric[k] * inside.grid.filled->plane.col(inside.grid.filled->mesh.triangle(k, place.face));
    inside.grid.planar.position.col(node) << p, 0;
    EXPECT_TRUE(inside.names("is not on an edge of it")) << inside.fault();

    Made turned; // the corners are those of another grid
    std::rotate(turned.boundary.corner.begin(), turned.boundary.corner.begin() + 1, turned.boundary.corner.end());
    std::rotate(turned.boundary.side.begin(), turned.boundary.side.begin() + 1, turned.boundary.side.end());
    EXPECT_TRUE(turned.names("is not on its vertex")) << turned.fault();
}

} // namespace
} // namespace spia
