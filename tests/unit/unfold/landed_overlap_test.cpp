#include "engine/unfold/step/landed_overlap.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/forming/material/material_library.h"
#include "engine/unfold/step/unfold_script.h"
#include "tests/support/bent_parts.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"

namespace spia::landed_overlap_test {
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

/// A plate with a slot from its front edge and a flap bent up from either side of the slot; one
/// more along the edge at the back.
TriMesh slotted(double flap, double back = 0)
{
    const double h = 20; // half the width of the slot
    std::vector<Patch> patches = {{{{{-60, -40, 0}, {-h, -40, 0}, {-h, 20, 0}, {-60, 20, 0}}}, 8, 12},
                                  {{{{h, -40, 0}, {60, -40, 0}, {60, 20, 0}, {h, 20, 0}}}, 8, 12},
                                  {{{{-60, 20, 0}, {-h, 20, 0}, {-h, 40, 0}, {-60, 40, 0}}}, 8, 4},
                                  {{{{-h, 20, 0}, {h, 20, 0}, {h, 40, 0}, {-h, 40, 0}}}, 8, 4},
                                  {{{{h, 20, 0}, {60, 20, 0}, {60, 40, 0}, {h, 40, 0}}}, 8, 4},
                                  {{{{-h, -40, 0}, {-h, -40, flap}, {-h, 10, flap}, {-h, 10, 0}}}, 4, 10},
                                  {{{{h, 10, 0}, {h, 10, flap}, {h, -40, flap}, {h, -40, 0}}}, 4, 10}};
    if (back > 0)
        for (const auto& [from, to] : {std::pair(-60., -h), {-h, h}, {h, 60.}})
            patches.push_back({{{{from, 40, 0}, {to, 40, 0}, {to, 40, back}, {from, 40, back}}}, 8, 4});
    return shapes::patchwork(patches);
}

/// Faces whose middles a test holds for.
template <class Where> FaceSet faces_where(const TriMesh& mesh, const Where& where)
{
    FaceSet faces;
    for (int f = 0; f < mesh.triangles(); ++f)
        if (where(Eigen::Vector3d(mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean())))
            faces.push_back(f);
    return faces;
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
    EXPECT_NEAR(over.first.x(), 100, 26); // the middle of an edge that crosses; edges are up to 25
                                          // mm long
    EXPECT_NEAR(over.first.y(), 20, 21);
}

TEST(LandedOverlap, CountsOnlyWhatLiesOnTheTargetWithItsOuterSideOut)
{
    const TriMesh base = rectangle(0, 0, 100, 60);
    EXPECT_EQ(places(base, rectangle(90, 10, 50, 20, 0.5)), 0);
    TriMesh turned = rectangle(90, 10, 50, 20);
    turned.triangle.row(0).swap(turned.triangle.row(1));
    EXPECT_EQ(places(base, turned), 0); // waits to be unfolded, as a hem does
    const TriMesh low = shapes::patchwork({{{{{30, 20, 0}, {60, 20, 0}, {60, 20.05, 0.2}, {30, 20.05, 0.2}}}, 4, 1}});
    // a wall lower than what the target allows
    EXPECT_EQ(landed_overlap(together(base, low), ground, 0.3).places, 0);
}

TEST(LandedOverlap, FacesThatMeetInACornerDoNotLieOnEachOther)
{
    const TriMesh corner = shapes::patchwork({{{{{0, 0, 0}, {30, 0, 0}, {30, 30, 0}, {0, 30, 0}}}, 3, 3},
                                              {{{{30, 30, 0}, {60, 30, 0}, {60, 60, 0}, {30, 60, 0}}}, 3, 3}});
    EXPECT_EQ(landed_overlap(corner, ground, 1e-9).places, 0);
}

TEST(LandedOverlap, CountsAsLandedOnlyPlacesOfFacesThatWereMoved)
{
    const auto counts = [](const TriMesh& mesh, const FaceSet& moved) {
        const LandedOverlap over = landed_overlap(mesh, ground, 1e-9, moved);
        return std::pair(over.places, over.landed);
    };
    const TriMesh base = rectangle(0, 0, 100, 60), across = rectangle(90, 10, 50, 20),
                  within = rectangle(31, 17, 11, 8);
    const int half = base.triangles();
    for (const TriMesh& other : {across, within}) {
        const TriMesh both = together(base, other);
        const auto [all, none] = counts(both, {});
        EXPECT_GT(all, 0);
        EXPECT_EQ(none, 0);
        EXPECT_EQ(counts(both, faces_where(both, [](auto&&) { return true; })), std::pair(all, all));
        FaceSet first, second;
        for (int f = 0; f < both.triangles(); ++f)
            (f < half ? first : second).push_back(f);
        EXPECT_EQ(counts(both, first), std::pair(all, all)) << "either of the two may have come";
        EXPECT_EQ(counts(both, second), std::pair(all, all));
    }
    const TriMesh three = together(together(base, across), rectangle(200, 0, 10, 10));
    const FaceSet third = faces_where(three, [](const Eigen::Vector3d& x) { return x.x() > 150; });
    EXPECT_EQ(counts(three, third), std::pair(places(base, across), 0));
}

TEST(LandedOverlap, ALaterStepElsewhereOnTheTargetIsNotToBlame)
{
    const TriMesh part = slotted(25, 15);
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    const FaceSet plate = faces_where(part, [](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
    UnfoldScript steps(2);
    steps[0].name = "flaps";
    steps[0].pick.freed = faces_where(part, [](const Eigen::Vector3d& x) { return x.z() > 0 && x.y() < 39; });
    steps[0].pick.fixed = plate;
    steps[1].name = "back";
    steps[1].pick.freed = faces_where(part, [](const Eigen::Vector3d& x) { return x.z() > 0 && x.y() > 39; });
    steps[1].pick.fixed = plate;
    const UnfoldRun run = run_unfolding(part, steps, options);
    ASSERT_EQ(run.states.size(), 2U) << run.failure;
    EXPECT_GT(run.states[0].overlap.places, 0);
    EXPECT_EQ(run.states[0].overlap.landed, run.states[0].overlap.places);
    EXPECT_EQ(run.states[1].overlap.places, run.states[0].overlap.places);
    EXPECT_EQ(run.states[1].overlap.landed, 0);
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

} // namespace spia::landed_overlap_test
