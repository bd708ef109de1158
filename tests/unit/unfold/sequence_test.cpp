#include "engine/unfold/plan/sequence.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/unfold/step/unfold_script.h"
#include "engine/unfold/target/fit_target.h"
#include "tests/support/bent_parts.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"
#include "tests/support/square_cup.h"

namespace spia {
namespace {

using shapes::Profile;
using std::numbers::pi;

/// What must hold of every pick, told by the faces alone.
void expect_valid(const TriMesh& part, const BendMap& map, const UnfoldSequence& sequence)
{
    ASSERT_FALSE(sequence.steps.empty());
    const FaceSet stays = map.faces_of(sequence.root);
    std::set<int> on_root(stays.begin(), stays.end());
    for (const PlannedStep& step : sequence.steps) {
        std::vector<char> role(size_t(part.triangles()), 0); // 1 fixed, 2 freed
        for (const int f : step.pick.fixed)
            role[size_t(f)] = 1;
        for (const int f : step.pick.freed) {
            EXPECT_EQ(role[size_t(f)], 0) << step.name << ": face " << f << " is fixed and freed";
            role[size_t(f)] = 2;
            if (step.carrier == sequence.root)
                on_root.insert(f);
        }
        for (const int f : step.pick.carrying)
            EXPECT_EQ(role[size_t(f)], step.kind == UnfoldKind::unroll ? 2 : 1) << step.name;
        std::vector<char> moves(size_t(part.vertices()), 0);
        for (const int f : step.pick.freed)
            for (const int v : part.triangle.col(f))
                moves[size_t(v)] = 1;
        for (int f = 0; f < part.triangles(); ++f)
            if (role[size_t(f)] == 0) {
                for (const int v : part.triangle.col(f))
                    EXPECT_FALSE(moves[size_t(v)]) << step.name << ": face " << f << " would be torn off";
            }
        if (step.kind == UnfoldKind::lay) {
            EXPECT_TRUE(fit_target(part, step.pick.carrying, step.within_mm > 0 ? 0.05 : 1e-4))
                << step.name << ": nothing to lay it on";
        }
    }
    const PlannedStep& last = sequence.steps.back();
    EXPECT_EQ(last.kind == UnfoldKind::flatten ? last.pick.freed.size() : on_root.size(), size_t(part.triangles()))
        << "all comes to lie on the root";
}

std::vector<std::string> step_names(const UnfoldSequence& sequence)
{
    std::vector<std::string> names;
    for (const PlannedStep& step : sequence.steps)
        names.push_back(step.name);
    return names;
}

UnfoldSequence proposed(const TriMesh& part, const SequenceOptions& options = {})
{
    return propose_sequence(part, find_bends(part), options);
}

TriMesh joggled_box() // walls, their radii and the ball corners between them, with a flange all
                      // around
{
    return shapes::square_cup({.punch_radius = 5, .die_radius = 5, .triangles = 6000});
}

} // namespace

TEST(Sequence, EveryPickMovesOnlyWhatMayMove)
{
    for (const TriMesh& part :
         {shapes::hat_channel({.triangles = 3000}).mesh, shapes::lipped_channel({.triangles = 3000}).mesh,
          shapes::extruded(Profile({0, 0}, 0).straight(40).bend(5, pi / 2).straight(30).bend(5, -pi / 2).straight(40),
                           120, 2000)
              .mesh,
          shapes::extruded(Profile({0, 0}, 0).straight(60).bend(2, pi).straight(15), 120, 4000).mesh,
          shapes::extruded(Profile({0, 0}, 0).bend(150, pi / 3).bend(5, pi / 2).straight(20), 150, 4000).mesh,
          shapes::swept(Profile({100, 0}, 0).straight(60).bend(6, pi / 2).straight(20).bend(4, -pi / 2).straight(12),
                        pi / 3, 3),
          shapes::lipped_box(), shapes::lipped_box({.joined = false}), shapes::round_cup(), joggled_box(),
          shapes::perforated_channel().mesh, shapes::dome().mesh, shapes::sphere_cap().mesh, shapes::plate(),
          shapes::noisy(shapes::hat_channel({.triangles = 3000}).mesh, 0.1)})
        for (const bool unite : {true, false}) {
            const BendMap map = find_bends(part);
            const UnfoldSequence sequence = propose_sequence(part, map, {.unite = unite});
            if (!sequence.steps.empty()) { // of a plate there are none
                expect_valid(part, map, sequence);
            }
        }
}

TEST(Sequence, EndsFlatAlsoWhereTheRootIsOnlyNearlyAPlane)
{
    // the first row of the bend belongs to the bottom
    const TriMesh part = shapes::round_cup({.triangles = 1500});
    FlattenOptions steel;
    steel.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    for (const double off : {0., 1e-6, 1e-5, 1e-4}) { // mm
        TriMesh near = part;
        for (int v = 0; v < near.vertices(); ++v)
            near.position(2, v) += off * std::sin(7. * v);
        const UnfoldRun run = run_unfolding(near, proposed(near).steps, steel);
        EXPECT_TRUE(run.blank) << off << run.failure;
    }
}

TEST(Sequence, AHatIsLaidOutFromItsFlangesInwards)
{
    // regions: 1 top, 2 and 3 walls, 4 and 5 flanges
    const TriMesh part = shapes::hat_channel({.triangles = 3000}).mesh;
    EXPECT_EQ(step_names(proposed(part)),
              (std::vector<std::string>{"region 4 onto region 2", "region 5 onto region 3",
                                        "region 2, region 3, region 4, region 5 onto region 1"}));
    const UnfoldSequence one_by_one = proposed(part, {.unite = false});
    ASSERT_EQ(one_by_one.steps.size(), 4u);
    EXPECT_EQ(one_by_one.steps[2].name, "region 2, region 4 onto region 1");
    EXPECT_EQ(one_by_one.steps[3].name, "region 3, region 5 onto region 1");
    EXPECT_TRUE(one_by_one.notes.empty());
    // region 4: then all goes one way
    const UnfoldSequence on_a_flange = proposed(part, {.root = 3});
    ASSERT_EQ(on_a_flange.steps.size(), 4u);
    EXPECT_EQ(on_a_flange.steps[0].name, "region 5 onto region 3");
    EXPECT_EQ(on_a_flange.steps[3].carrier, 3);
    EXPECT_EQ(on_a_flange.steps[3].pick.freed.size() + on_a_flange.steps[3].pick.fixed.size(),
              size_t(part.triangles()));
}

TEST(Sequence, NamesBentEdgesBesideTheRegionsThatItMoves)
{
    const TriMesh part =
        shapes::extruded(Profile({0, 0}, 0).bend(0.2, 0.8).straight(40).bend(5, pi / 2).straight(20), 60, 2000).mesh;
    EXPECT_EQ(step_names(proposed(part)), std::vector<std::string>{"region 2, 1 bent edge onto region 1"});
}

TEST(Sequence, WallsJoinedAtTheirCornersMoveTogetherOthersMayMoveAlone)
{
    const UnfoldSequence joined = proposed(shapes::lipped_box(), {.unite = false}),
                         apart = proposed(shapes::lipped_box({.joined = false}), {.unite = false});
    ASSERT_EQ(joined.steps.size(), 5u) << "four lips, then all walls at once";
    ASSERT_EQ(apart.steps.size(), 8u) << "four lips, four walls";
    for (size_t k = 0; k < 4; ++k)
        EXPECT_NE(joined.steps[k].carrier, joined.root) << "lips go onto their walls";
    EXPECT_EQ(joined.steps[4].carrier, joined.root);
    EXPECT_EQ(joined.steps[4].freed.size(), 8u);
}

TEST(Sequence, ARoundWallIsNotLaidOnItself)
{
    const UnfoldSequence sequence = proposed(shapes::round_cup({.flange = 30}));
    ASSERT_FALSE(sequence.notes.empty()) << "the bottom cannot be laid on a wall that goes all around it";
    EXPECT_EQ(sequence.steps[0].carrier, sequence.root);
    for (const PlannedStep& step : sequence.steps)
        EXPECT_TRUE(step.carrier == sequence.root || step.carrier < 0);
}

TEST(Sequence, AFlangeAroundACupIsNotWhatStays)
{
    const TriMesh cup = shapes::square_cup({.triangles = 4000});
    const BendMap map = find_bends(cup);
    const UnfoldSequence sequence = propose_sequence(cup, map);
    EXPECT_NE(sequence.root, 0) << "the flange is the largest";
    EXPECT_NEAR(map.regions[size_t(sequence.root)].place.z(), 0, 1e-6) << "the bottom";
}

TEST(Sequence, BendsThatTouchAtTheCornersOfWallsAreNoWayAroundTheWalls)
{
    const TriMesh cup = shapes::square_cup({.triangles = 4000});
    const BendMap map = find_bends(cup);
    const UnfoldSequence sequence = propose_sequence(cup, map);
    ASSERT_EQ(map.regions.size(), 6u) << "flange, bottom, four walls";
    for (int r = 0; r < 6; ++r) {
        const double up = std::abs(map.regions[size_t(r)].normal.z());
        EXPECT_EQ(sequence.depth[size_t(r)], r == sequence.root ? 0 : up < 0.5 ? 1 : 2) << map.name(r);
    }
}

TEST(Sequence, WhatClosesATubeIsNotLaidOnTheTube)
{
    const TriMesh cup = shapes::sharp_cup({.radius = 40, .height = 20, .triangles = 4000}).mesh;
    const BendMap map = find_bends(cup);
    ASSERT_EQ(map.regions.size(), 2u);
    const int wall = map.regions[0].flatness < map.regions[1].flatness ? 0 : 1;
    const UnfoldSequence sequence = propose_sequence(cup, map, {.root = wall});
    ASSERT_EQ(sequence.notes.size(), 1u);
    EXPECT_NE(sequence.notes[0].find("surrounds"), std::string::npos) << sequence.notes[0];
    ASSERT_EQ(sequence.steps.size(), 1u);
    EXPECT_EQ(sequence.steps[0].kind, UnfoldKind::flatten);
}

TEST(Sequence, ALipJoinedToAllWallsMovesWithThem)
{
    const auto ring = [](double x, double y, double z) {
        return std::array<Eigen::Vector3d, 4>{{{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}}};
    };
    const auto low = ring(50, 35, 0), high = ring(50, 35, 30), in = ring(40, 25, 30);
    std::vector<shapes::Patch> patches = {{{low[0], low[3], low[2], low[1]}, 14, 20}};
    for (size_t k = 0; k < 4; ++k) {
        const size_t n = (k + 1) % 4;
        const int cells = k % 2 ? 14 : 20;
        patches.push_back({{low[k], low[n], high[n], high[k]}, cells, 6});
        patches.push_back({{high[k], high[n], in[n], in[k]}, cells, 2});
    }
    const TriMesh box = shapes::patchwork(patches);
    const BendMap map = find_bends(box);
    ASSERT_EQ(map.regions.size(), 6u);
    const UnfoldSequence sequence = propose_sequence(box, map);
    expect_valid(box, map, sequence);
    ASSERT_EQ(sequence.steps.size(), 1u);
    EXPECT_EQ(sequence.steps[0].freed.size(), 5u);
    ASSERT_EQ(sequence.notes.size(), 1u);
    EXPECT_NE(sequence.notes[0].find("joined to more"), std::string::npos) << sequence.notes[0];
}

TEST(Sequence, AFaceThatTheFreedOnesTouchInOneVertexIsHeld)
{
    const Eigen::Vector3d x(100, 0, 0), y(0, 70, 0), z(0, 0, 30), o(0, 0, 0), out(0, -15, 0);
    // A bottom, a wall, and at the end of the wall a tab that meets the bottom in the corner.
    const TriMesh part = shapes::patchwork(
        {{{o, x, x + y, y}, 20, 14}, {{o, z, x + z, x}, 6, 20}, {{x, x + z, x + z + out, x + out}, 6, 3}});
    const BendMap map = find_bends(part);
    ASSERT_EQ(map.regions.size(), 3u);
    const UnfoldSequence sequence = propose_sequence(part, map);
    expect_valid(part, map, sequence);
    ASSERT_EQ(sequence.steps.size(), 2u);
    const UnfoldPick& tab = sequence.steps[0].pick;
    EXPECT_EQ(sequence.steps[0].name, "region 3 onto region 2");
    EXPECT_EQ(int(tab.carrying.size()), map.regions[1].faces);
    EXPECT_GT(tab.fixed.size(), tab.carrying.size()) << "the bottom's faces in the corner";
}

TEST(Sequence, OnACylinderTheLastStepUnrollsIt)
{
    const TriMesh part =
        shapes::extruded(Profile({0, 0}, 0).bend(150, pi / 3).bend(5, pi / 2).straight(20), 150, 4000).mesh;
    const UnfoldSequence sequence = proposed(part);
    ASSERT_EQ(sequence.steps.size(), 2u);
    EXPECT_EQ(sequence.steps[1].kind, UnfoldKind::unroll);
    const auto fit = fit_target(part, sequence.steps[1].pick.carrying);
    ASSERT_TRUE(fit && name(fit->face) == "cylinder");
    EXPECT_NEAR(std::get<CylinderFace>(fit->face).radius, 150, 1e-3);
}

TEST(Sequence, WhatLiesOnNoSuchFaceIsFlattenedAtOnce)
{
    const TriMesh part = shapes::noisy(shapes::hat_channel({.triangles = 3000}).mesh, 0.3);
    const UnfoldSequence sequence = proposed(part);
    EXPECT_EQ(sequence.steps.back().kind, UnfoldKind::flatten);
    EXPECT_FALSE(sequence.notes.empty());
}

TEST(Sequence, TheOrderDoesNotDependOnNumbers)
{
    const TriMesh part = shapes::lipped_channel({.triangles = 3000}).mesh;
    const shapes::Permuted other = shapes::permuted(part, 5);
    const UnfoldSequence one = proposed(part, {.unite = false}), two = proposed(other.mesh, {.unite = false});
    const auto picks = [](const UnfoldSequence& sequence, const std::function<int(int)>& face) {
        std::set<std::pair<std::set<int>, std::set<int>>> result; // equal regions may change places
        for (const PlannedStep& step : sequence.steps) {
            std::set<int> fixed, freed;
            for (const int f : step.pick.fixed)
                fixed.insert(face(f));
            for (const int f : step.pick.freed)
                freed.insert(face(f));
            result.emplace(fixed, freed);
        }
        return result;
    };
    EXPECT_EQ(picks(one, [&](int f) { return other.face[size_t(f)]; }), picks(two, [](int f) { return f; }));
}

TEST(Sequence, RefusesAMapOfAnotherPartAndAPartInPieces)
{
    const TriMesh part = shapes::lipped_box();
    const BendMap map = find_bends(part);
    EXPECT_THROW(propose_sequence(shapes::plate(), map), InputError);
    EXPECT_THROW(propose_sequence(part, map, {.root = 9}), InputError);
    const TriMesh two = shapes::joined(part, shapes::transformed(part, Eigen::Matrix3d::Identity(), {500, 0, 0}));
    EXPECT_THROW(propose_sequence(two, find_bends(two)), InputError);
}

} // namespace spia
