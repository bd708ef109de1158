#include "engine/coons/area_balanced_map.h"

#include <gtest/gtest.h>

#include "engine/coons/boundary.h"
#include "engine/coons/map_grid.h"
#include "engine/mesh/orient2d.h"
#include "tests/unit/coons/outlines.h"

namespace spia {

namespace {

/// A square with a long finger that hangs on its side v = 0.
struct Finger {
    TriMesh part = outlines::part(
        outlines::divided({{0, 0}, {4.5, 0}, {4.5, -8}, {5.5, -8}, {5.5, 0}, {10, 0}, {10, 10}, {0, 10}}, 0.25));
    Blank blank = outlines::as_blank(part);
    BlankBoundary boundary =
        split_boundary(blank, part,
                       {outlines::nearest_vertex(part, {0, 0}), outlines::nearest_vertex(part, {10, 0}),
                        outlines::nearest_vertex(part, {10, 10}), outlines::nearest_vertex(part, {0, 10})});
    HarmonicMap harmonic = harmonic_map(fill_holes(part, blank.position), boundary);
};

/// What the outer half of the finger takes of the unit square.
double share_of_finger(const HarmonicMap& map)
{
    double doubled = 0;
    for (int t = 0; t < map.triangle.cols(); ++t) {
        const Eigen::Vector3i v = map.triangle.col(t);
        if (map.plane(1, v[0]) + map.plane(1, v[1]) + map.plane(1, v[2]) > -12)
            continue;
        const Eigen::Vector2d p = map.square.col(v[1]) - map.square.col(v[0]),
                              q = map.square.col(v[2]) - map.square.col(v[0]);
        doubled += p.x() * q.y() - p.y() * q.x();
    }
    return doubled / 2;
}

} // namespace

TEST(AreaBalancedMap, GivesALobeItsShareOfTheSquareWithoutAFold)
{
    const Finger finger;
    const double share_of_blank = 4.0 / 108;
    ASSERT_LT(share_of_finger(finger.harmonic), 0.02 * share_of_blank);
    for (const bool slide : {false, true}) {
        const auto opened = area_balanced_map(finger.harmonic, {.slide = slide});
        ASSERT_TRUE(opened);
        // Fixed sides give the finger what its long edge takes of them; sliding ones shrink that.
        EXPECT_GT(share_of_finger(*opened), (slide ? 0.08 : 0.3) * share_of_blank);
        for (int t = 0; t < opened->triangle.cols(); ++t)
            EXPECT_EQ(orient2d(opened->square.col(opened->triangle(0, t)), opened->square.col(opened->triangle(1, t)),
                               opened->square.col(opened->triangle(2, t))),
                      1);
    }
}

TEST(AreaBalancedMap, SidesStayOnTheSidesOfTheSquareAndSlideOnlyIfAsked)
{
    const Finger finger;
    const auto fixed = area_balanced_map(finger.harmonic, {}),
               slid = area_balanced_map(finger.harmonic, {.slide = true});
    ASSERT_TRUE(fixed && slid);
    double most = 0;
    for (int k = 0; k < 4; ++k)
        for (const int v : finger.boundary.side[size_t(k)]) {
            EXPECT_EQ(fixed->square.col(v), finger.harmonic.square.col(v));
            EXPECT_EQ(slid->square(1 - k % 2, v), finger.harmonic.square(1 - k % 2, v));
            most = std::max(most, (slid->square.col(v) - finger.harmonic.square.col(v)).norm());
        }
    EXPECT_GT(most, 0.01);
    // Where the map's border says: between evenly shared sides these are the even ones.
    const BorderParameters even = border_of_map(*fixed, finger.boundary, even_lines(9, 7));
    for (size_t k = 0; k < 4; ++k)
        EXPECT_LT((even[k] - even_border(9, 7)[k]).cwiseAbs().maxCoeff(), 1e-12);
    const BorderParameters border = border_of_map(*slid, finger.boundary, even_lines(9, 7));
    const Eigen::VectorXd chord = chord_parameters(finger.boundary.side[1], finger.blank.position);
    for (int i = 1; i < 7; ++i) { // side 1: the place of chord length border[1][i] has y = i / 7
        const SidePoint place = point_on_side(finger.boundary.side[1], chord, border[1][i]);
        const double y = (1 - place.weight) * slid->square(1, place.a) + place.weight * slid->square(1, place.b);
        EXPECT_NEAR(y, i / 7.0, 1e-12);
    }
}

} // namespace spia
