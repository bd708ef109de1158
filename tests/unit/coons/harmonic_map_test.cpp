#include "engine/coons/harmonic_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <complex>
#include <gtest/gtest.h>

#include "engine/coons/boundary.h"
#include "tests/support/shapes.h"
#include "tests/unit/coons/outlines.h"

namespace spia {

namespace {

double smallest_area(const HarmonicMap& map)
{
    double smallest = 1;
    for (int t = 0; t < map.triangle.cols(); ++t) {
        const Eigen::Vector2d u = map.square.col(map.triangle(1, t)) - map.square.col(map.triangle(0, t));
        const Eigen::Vector2d v = map.square.col(map.triangle(2, t)) - map.square.col(map.triangle(0, t));
        smallest = std::min(smallest, (u.x() * v.y() - u.y() * v.x()) / 2);
    }
    return smallest;
}

double total_area(const HarmonicMap& map)
{
    double sum = 0;
    for (int t = 0; t < map.triangle.cols(); ++t) {
        const Eigen::Vector2d u = map.square.col(map.triangle(1, t)) - map.square.col(map.triangle(0, t));
        const Eigen::Vector2d v = map.square.col(map.triangle(2, t)) - map.square.col(map.triangle(0, t));
        sum += (u.x() * v.y() - u.y() * v.x()) / 2;
    }
    return sum;
}

HarmonicMap map_of(const TriMesh& part, const Blank& blank)
{
    return harmonic_map(fill_holes(part, blank.position), split_boundary(blank, part, propose_corners(blank, part)));
}

} // namespace

TEST(HarmonicMap, ARectangleIsScaledToTheSquare)
{
    const TriMesh part = shapes::rectangle(30, 20, 12, 8);
    const HarmonicMap map = map_of(part, outlines::as_blank(part));
    for (int v = 0; v < part.vertices(); ++v)
        EXPECT_LT((map.square.col(v) - part.position.col(v).head<2>().cwiseQuotient(Eigen::Vector2d(30, 20))).norm(),
                  1e-12);
}

TEST(HarmonicMap, IsOneToOneOnDifficultOutlines)
{
    using namespace outlines;
    // Saw teeth are ears: without the cuts they would have no area on a straight side.
    for (const Points& outline :
         {l_shape(10, 3, 0.25), star(3, 10, 8, 0.3), arc(10, 2, 1.6 * pi, 200, 8), saw(10, 0.3, 50)}) {
        const TriMesh flat = part(outline);
        const HarmonicMap map = map_of(flat, as_blank(flat));
        EXPECT_GT(smallest_area(map), 0);
        EXPECT_NEAR(total_area(map), 1, 1e-12);
    }
    // In an arm the area falls by exp(-2 pi length / width): here below the rounding of the
    // positions.
    for (const Points& outline : {u_shape(10, 2, 0.25), slotted(20, 10, 5, 0.2, 4, 0.2)}) {
        const TriMesh flat = part(outline);
        const HarmonicMap map = map_of(flat, as_blank(flat));
        EXPECT_GT(smallest_area(map), -1e-16);
        EXPECT_NEAR(total_area(map), 1, 1e-12);
    }
}

TEST(HarmonicMap, IsOneToOneForABlankThatOverlapsItself)
{
    const auto [strip, blank] = outlines::WoundBand();
    const HarmonicMap map = map_of(strip, blank);
    EXPECT_GT(smallest_area(map), 0);
    EXPECT_NEAR(total_area(map), 1, 1e-12);
}

TEST(HarmonicMap, PlacesOfTheCutMeshAreThoseOfTheFilledMesh)
{
    const TriMesh part = outlines::part(outlines::saw(10, 1, 10));
    const FilledMesh filled = fill_holes(part, part.position.topRows(2));
    const HarmonicMap map = map_of(part, outlines::as_blank(part));
    ASSERT_GT(map.triangle.cols(), part.triangles());
    // A vertex of the map is the same point of the plane from every triangle around it.
    std::vector<Eigen::Vector2d> seen(size_t(map.square.cols()), Eigen::Vector2d::Constant(1e300));
    for (int t = 0; t < map.triangle.cols(); ++t)
        for (int k = 0; k < 3; ++k) {
            const MeshPoint place = map.in_filled_mesh({t, Eigen::Vector3d::Unit(k), 0});
            Eigen::Vector2d p = Eigen::Vector2d::Zero();
            for (int c = 0; c < 3; ++c)
                p += place.barycentric[c] * filled.plane.col(filled.mesh.triangle(c, place.face));
            Eigen::Vector2d& before = seen[size_t(map.triangle(k, t))];
            if (before.x() < 1e299) {
                EXPECT_LT((before - p).norm(), 1e-13);
            }
            before = p;
            if (map.triangle(k, t) < part.vertices()) {
                EXPECT_LT((p - part.position.col(map.triangle(k, t)).head<2>()).norm(), 1e-13);
            }
        }
}

} // namespace spia
