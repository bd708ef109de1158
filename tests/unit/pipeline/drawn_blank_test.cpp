#include "engine/pipeline/blank/drawn_blank.h"

#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/unfold/automatic_unfolding.h"
#include "tests/support/bent_parts.h"
#include "tests/support/cad/random_bent_solid.h"
#include "tests/support/mesh_file.h"
#include "tests/support/profile.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {
namespace {

using std::numbers::pi;

struct Bent {
    PartFile part;
    BendMap map;
    UnfoldRun run;
};

Bent bent(const TriMesh& mesh)
{
    const ScratchFolder folder;
    shapes::write_mesh(folder / "part.obj", mesh);
    Bent result{read_part(folder / "part.obj"), {}, {}};
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    result.map = find_bends(result.part.mesh);
    result.run = automatic_unfolding(result.part.mesh, result.map, {}, options).run;
    return result;
}

} // namespace

TEST(DrawnBlank, ABendHasItsAngleRadiusSideAndPlace)
{
    std::mt19937 random(9);
    std::uniform_real_distribution<double> any(0, 1);
    for (int trial = 0; trial < 12; ++trial) {
        const double angle = (0.8 + 0.7 * any(random)) * (trial % 2 ? 1 : -1), radius = 3 + 4 * any(random);
        const double first = 40 + 20 * any(random), second = 20 + 10 * any(random), width = 50;
        const Bent l =
            bent(shapes::extruded(shapes::Profile({0, 0}, 0).straight(first).bend(radius, angle).straight(second),
                                  width, 3000)
                     .mesh);
        ASSERT_TRUE(l.run.blank) << l.run.failure;
        const BlankDrawing drawing = drawn_blank(l.part, l.map, *l.run.blank, l.run.states.back().face, true);
        ASSERT_EQ(drawing.bends.size(), 1u);
        const DrawnBend& bend = drawing.bends[0];
        EXPECT_NEAR(bend.angle, std::abs(angle), 0.02);
        EXPECT_NEAR(bend.inner_radius, radius - 0.5, 0.05 * radius) << "a sheet of 1 mm, its middle surface; chords";
        EXPECT_EQ(bend.k, 0.5);
        // Seen from the outer side of the large leg the other comes nearer, or not.
        const TriMesh& mesh = l.part.mesh;
        const Eigen::Matrix3Xd normal = area_vectors(mesh);
        Eigen::Vector3d middle[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}, eye = Eigen::Vector3d::Zero();
        int count[2] = {0, 0};
        for (int f = 0; f < mesh.triangles(); ++f)
            if (const int region = l.map.label[f]; region < 2) {
                middle[region] += mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean();
                ++count[region];
                if (region == 0)
                    eye += normal.col(f);
            }
        EXPECT_EQ(bend.up, eye.dot(middle[1] / count[1] - middle[0] / count[0]) > 0);
        // In the middle of the arc, all across the blank, which lies straight: its length along x.
        ASSERT_EQ(bend.middle.size(), 1u);
        const Eigen::Matrix2Xd& line = bend.middle[0];
        const Eigen::Vector2d size = l.run.blank->position.rowwise().maxCoeff();
        const double at = line(0, 0), half = radius * std::abs(angle) / 2;
        EXPECT_NEAR(std::min(at, size[0] - at), second + half, 0.02 * size[0]);
        EXPECT_NEAR(std::abs(line(1, 0) - line(1, line.cols() - 1)), width, 1e-3);
        EXPECT_EQ(bend.zone.size(), 2u);
    }
}

TEST(DrawnBlank, WhatTheTableOfBendsHasIsDrawn)
{
    const double radius = 5;
    const Bent l =
        bent(shapes::extruded(shapes::Profile({0, 0}, 0).straight(50).bend(radius, 1.2).straight(30), 40, 3000).mesh);
    ASSERT_TRUE(l.run.blank) << l.run.failure;
    SheetBend known;
    known.inner_radius = 4.5;
    known.angle = 1.2;
    known.k = 0.4;
    known.allowance = 6;
    known.laid = true;
    known.line = {{{33, 0}, {33, 40}}};
    for (int f = 0; f < l.part.mesh.triangles(); ++f)
        if (l.map.label[f] >= int(l.map.regions.size()))
            known.faces.push_back(f);
    const BendTable table{.thickness = 1, .surface = "neutral fibre, K 0.4", .bends = {known}, .kept = {}, .notes = {}};
    const BlankDrawing drawing = drawn_blank(l.part, l.map, *l.run.blank, l.run.states.back().face, true, &table);
    ASSERT_EQ(drawing.bends.size(), 1u) << "not a second time";
    EXPECT_EQ(drawing.bends[0].inner_radius, 4.5);
    EXPECT_EQ(drawing.bends[0].k, 0.4);
    ASSERT_EQ(drawing.bends[0].zone.size(), 2u);
    EXPECT_NEAR((drawing.bends[0].zone[0] - drawing.bends[0].zone[1]).norm(), 6 * std::sqrt(2.), 1e-9);
    EXPECT_NEAR(drawing.bends[0].middle[0](0, 1), 33, 1e-12);
}

TEST(DrawnBlank, BendsThatTheTableHasNotAreNumberedAfterItsRows)
{
    const Bent z =
        bent(shapes::extruded(
                 shapes::Profile({0, 0}, 0).straight(50).bend(5, 1.2).straight(40).bend(4, -0.9).straight(30), 40, 3000)
                 .mesh);
    ASSERT_TRUE(z.run.blank) << z.run.failure;
    ASSERT_EQ(z.map.bends.size(), 2u);
    BendTable table{.thickness = 1, .surface = "", .bends = {{}}, .kept = {}, .notes = {}};
    table.bends[0].line = {{{33, 0}, {33, 40}}};
    for (int f = 0; f < z.part.mesh.triangles(); ++f)
        if (z.map.label[f] == z.map.label_of_bend(1))
            table.bends[0].faces.push_back(f);
    const BlankDrawing drawing = drawn_blank(z.part, z.map, *z.run.blank, z.run.states.back().face, true, &table);
    ASSERT_EQ(drawing.bends.size(), 2u);
    EXPECT_EQ(drawing.bends[0].name, "bend 2");
    EXPECT_NEAR(drawing.bends[0].angle, std::abs(z.map.bends[0].angle), 1e-12);
    EXPECT_EQ(drawing.bends[1].name, "bend 1");
}

TEST(DrawnBlank, HolesThroughABendMakeNoFurtherBends)
{
    const ScratchFolder folder;
    int holes = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const shapes::BentSolid solid = shapes::random_bent_solid(seed);
        if (!solid.hole)
            continue;
        SCOPED_TRACE(seed);
        const Session session = solved_bent_solid(folder / "part.step", solid);
        const BlankDrawing drawing = drawn_blank(*session.part, find_bends(session.part->mesh), session.blank->blank,
                                                 session.blank->face, true, session.bends.get());
        EXPECT_EQ(drawing.bends.size(), solid.bend.size());
        EXPECT_EQ(drawing.lengths_of, session.bends->surface);
        EXPECT_NEAR(drawing.thickness, solid.thickness, 1e-9);
        ++holes;
    }
    EXPECT_GE(holes, 12);
}

TEST(DrawnBlank, OfADrawnPartOnlyStraightBendsAreLeft)
{
    const Bent cup = bent(shapes::round_cup({.triangles = 2000}));
    ASSERT_TRUE(cup.run.blank) << cup.run.failure;
    EXPECT_TRUE(drawn_blank(cup.part, cup.map, *cup.run.blank, cup.run.states.back().face, true).bends.empty());
    EXPECT_FALSE(drawn_blank(cup.part, cup.map, *cup.run.blank, cup.run.states.back().face).bends.empty());
}

} // namespace spia
