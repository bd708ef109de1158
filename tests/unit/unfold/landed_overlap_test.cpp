#include "engine/unfold/landed_overlap.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/forming/material_library.h"
#include "engine/unfold/unfold_script.h"
#include "tests/support/bent_parts.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"

namespace spia {
namespace {

using shapes::Patch;
using std::numbers::pi;

const PlaneFace ground{{0, 0, 0}, Eigen::Matrix<double, 3, 2>::Identity()};

TriMesh rectangle(double x, double y, double width, double depth, double z = 0)
{
    return shapes::patchwork({{{{{x, y, z}, {x + width, y, z}, {x + width, y + depth, z}, {x, y + depth, z}}}, 4, 3}});
}

TriMesh together(const TriMesh& a, const TriMesh& b)
{
    TriMesh both;
    both.position.resize(3, a.vertices() + b.vertices());
    both.position << a.position, b.position;
    both.triangle.resize(3, a.triangles() + b.triangles());
    both.triangle << a.triangle, (b.triangle.array() + a.vertices()).matrix();
    return both;
}

int places(const TriMesh& a, const TriMesh& b) { return landed_overlap(together(a, b), ground, 1e-9).places; }

/// A plate with a slot from its front edge and a flap bent up from either side of the slot.
TriMesh slotted(double flap)
{
    const double h = 20; // half the width of the slot
    std::vector<Patch> patches = {{{{{-60, -40, 0}, {-h, -40, 0}, {-h, 20, 0}, {-60, 20, 0}}}, 8, 12},
                                  {{{{h, -40, 0}, {60, -40, 0}, {60, 20, 0}, {h, 20, 0}}}, 8, 12},
                                  {{{{-60, 20, 0}, {-h, 20, 0}, {-h, 40, 0}, {-60, 40, 0}}}, 8, 4},
                                  {{{{-h, 20, 0}, {h, 20, 0}, {h, 40, 0}, {-h, 40, 0}}}, 8, 4},
                                  {{{{h, 20, 0}, {60, 20, 0}, {60, 40, 0}, {h, 40, 0}}}, 8, 4},
                                  {{{{-h, -40, 0}, {-h, -40, flap}, {-h, 10, flap}, {-h, 10, 0}}}, 4, 10},
                                  {{{{h, 10, 0}, {h, 10, flap}, {h, -40, flap}, {h, -40, 0}}}, 4, 10}};
    return shapes::patchwork(patches);
}

UnfoldRun automatic(const TriMesh& part)
{
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return run_unfolding(part, propose_sequence(part, find_bends(part), {.root = 0}).steps, options);
}

/// A band around z with outer side out, from one angle to another.
TriMesh band(double from, double to)
{
    return shapes::grid_surface({72, 3}, [&](double u, double v) {
        const double angle = from + u * (to - from);
        return Eigen::Vector3d(50 * std::cos(angle), 50 * std::sin(angle), 30 * v);
    });
}

} // namespace

TEST(LandedOverlap, TellsPiecesThatCrossOrLieInEachOtherFromThoseThatDoNot)
{
    const TriMesh base = rectangle(0, 0, 100, 60);
    EXPECT_EQ(places(base, rectangle(101, 0, 50, 60)), 0);
    EXPECT_GT(places(base, rectangle(90, 10, 50, 20)), 0);
    EXPECT_EQ(places(base, rectangle(31, 17, 11, 8)), 1); // no outline meets another
    EXPECT_EQ(places(rectangle(31, 17, 11, 8), base), 1);
}

TEST(LandedOverlap, NamesAPlaceNearWhereItIs)
{
    const TriMesh both = together(rectangle(0, 0, 100, 60), rectangle(90, 10, 50, 20));
    const LandedOverlap over = landed_overlap(both, ground, 1e-9);
    ASSERT_GT(over.places, 0);
    EXPECT_NEAR(over.first.x(), 100, 26); // the middle of an edge that crosses; edges are up to 25 mm long
    EXPECT_NEAR(over.first.y(), 20, 21);
}

TEST(LandedOverlap, CountsOnlyWhatLiesOnTheTargetWithItsOuterSideOut)
{
    const TriMesh base = rectangle(0, 0, 100, 60);
    EXPECT_EQ(places(base, rectangle(90, 10, 50, 20, 0.5)), 0);
    TriMesh turned = rectangle(90, 10, 50, 20);
    turned.triangle.row(0).swap(turned.triangle.row(1));
    EXPECT_EQ(places(base, turned), 0); // waits to be unfolded, as a hem does
}

TEST(LandedOverlap, FacesThatMeetInACornerDoNotLieOnEachOther)
{
    const TriMesh corner = shapes::patchwork({{{{{0, 0, 0}, {30, 0, 0}, {30, 30, 0}, {0, 30, 0}}}, 3, 3},
                                              {{{{30, 30, 0}, {60, 30, 0}, {60, 60, 0}, {30, 60, 0}}}, 3, 3}});
    EXPECT_EQ(landed_overlap(corner, ground, 1e-9).places, 0);
}

TEST(LandedOverlap, GoesAroundACylinderOnce)
{
    const CylinderFace cylinder{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 50, true};
    for (const double start : {0.0, 1.0, 3.0, 5.0}) {
        EXPECT_EQ(landed_overlap(band(start, start + 350 * pi / 180), cylinder, 1e-9).places, 0) << start;
        EXPECT_GT(landed_overlap(band(start, start + 375 * pi / 180), cylinder, 1e-9).places, 0) << start;
    }
}

TEST(LandedOverlap, FlapsOfASlotLandOnEachOtherIfTheyAreLongerThanHalfOfIt)
{
    for (const double flap : {15.0, 25.0}) {
        const TriMesh part = slotted(flap);
        const UnfoldRun run = automatic(part);
        ASSERT_TRUE(run.blank) << run.failure;
        EXPECT_EQ(run.flipped, 0);
        const LandedOverlap& over = run.states.back().overlap;
        EXPECT_EQ(over.places > 0, flap > 20) << over.places;
        if (over.places > 0) {
            EXPECT_LT(std::abs(over.first.x()), 10);
            EXPECT_LT(over.first.y(), 12);
        }
    }
}

} // namespace spia
