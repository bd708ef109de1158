// Shallow marks over bends of sheet solids: what is laid flat is the sheet without them.
#include <Eigen/Geometry>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/mesh/topology.h"
#include "engine/pipeline/session.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/flat_area.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {
namespace {

using shapes::BentSolid;
using shapes::CadForm;
using shapes::Stamp;
using std::numbers::pi;
using Loop = std::vector<Eigen::Vector2d>;

Loop ring(double radius, int corners, double wave)
{
    Loop loop;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * pi * i / corners;
        loop.emplace_back(Eigen::Vector2d(std::cos(angle), std::sin(angle)) * radius *
                          (1 + wave * std::cos(3 * angle)));
    }
    return loop;
}

/// H, O, L, a wavy disc and a star, as high as 1.
std::vector<Loop> letter(int kind)
{
    switch (kind) {
    case 0:
        return {{{-.4, -.5},
                 {-.2, -.5},
                 {-.2, -.1},
                 {.2, -.1},
                 {.2, -.5},
                 {.4, -.5},
                 {.4, .5},
                 {.2, .5},
                 {.2, .1},
                 {-.2, .1},
                 {-.2, .5},
                 {-.4, .5}}};
    case 1: return {ring(.5, 30, 0), ring(.3, 22, 0)};
    case 2: return {{{-.3, -.5}, {.3, -.5}, {.3, -.3}, {-.1, -.3}, {-.1, .5}, {-.3, .5}}};
    case 3: return {ring(.4, 41, .2)};
    default: return {ring(.35, 10, .4)};
    }
}

/// A bracket with letters on and beside its bend.
BentSolid random_drawn_solid(std::uint64_t seed)
{
    shapes::SeededRandom random(seed);
    BentSolid solid;
    solid.kind = "bracket";
    solid.thickness = random.between(0.8, 3);
    solid.leg = {random.between(25, 40), random.between(25, 40)};
    solid.bend = {{random.between(1, 6) * solid.thickness, (random.coin() ? 1 : -1) * random.between(0.3, 1.75)}};
    solid.width = 70;
    solid.pose = seed;
    const double depth = solid.thickness * random.between(0.03, 0.19) * (random.whole(0, 3) ? 1 : -1);
    const double high = random.between(8, 14);
    for (int k = 0; k < 3; ++k) {
        const double turn = random.between(0, 2 * pi), aside = random.between(-6, 6);
        Stamp stamp{0, letter(random.whole(0, 4)), depth};
        for (Loop& loop : stamp.outline)
            for (Eigen::Vector2d& p : loop)
                p = Eigen::Rotation2Dd(turn) * (high * p) + Eigen::Vector2d(aside, 15 + 20 * k);
        solid.stamp.push_back(std::move(stamp));
    }
    return solid;
}

void expect_taken_out(const Session& session, const BentSolid& solid, double exact)
{
    const PartFile& part = *session.part;
    ASSERT_TRUE(part.solid);
    EXPECT_EQ(part.solid->skin, Skin::middle);
    EXPECT_TRUE(part.doubts.empty());
    EXPECT_EQ(part.doctor.boundary_loops, 1);
    EXPECT_NEAR(part.solid->thickness, solid.thickness, exact * solid.thickness);
    const double length = solid.developed(0.5);
    EXPECT_NEAR(shapes::flat_area(session.blank->blank.position, part.mesh.triangle), length * solid.width,
                exact * length * solid.width);
    const Finding* marks = part.doctor.find(Fault::mark);
    ASSERT_TRUE(marks);
    EXPECT_EQ(marks->count, int(solid.stamp.size()));
    EXPECT_GE(part.solid->marks.size(), solid.stamp.size());
}

} // namespace

TEST(StampedBends, OfCadFilesAreLaidFlatAsIfTheyWerePlain)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        const BentSolid solid = random_drawn_solid(seed);
        shapes::write_bent_solid(folder / "part.step", solid);
        SCOPED_TRACE(fmt::format("seed {}, t {:.3g}, R {:.3g}, {:.3g} rad, {:.3g} deep", seed, solid.thickness,
                                 solid.bend[0].inner_radius, solid.bend[0].angle, solid.stamp[0].depth));
        const Session session = solved_part(folder / "part.step");
        expect_taken_out(session, solid, 1e-4);
        ASSERT_TRUE(session.bends);
        ASSERT_EQ(session.bends->bends.size(), 1u);
        EXPECT_NEAR(session.bends->bends[0].inner_radius, solid.bend[0].inner_radius,
                    1e-9 * solid.bend[0].inner_radius);
        EXPECT_NEAR(std::abs(session.bends->bends[0].angle), std::abs(solid.bend[0].angle), 1e-9);
    }
}

TEST(StampedBends, OfMeshesAreLaidFlatAsIfTheyWerePlain)
{
    const ScratchFolder folder;
    int fallen_back = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        const BentSolid solid = random_drawn_solid(seed);
        shapes::write_bent_solid(folder / "part.stl", solid, CadForm::stl);
        SCOPED_TRACE(fmt::format("seed {}, t {:.3g}, R {:.3g}, {:.3g} rad, {:.3g} deep", seed, solid.thickness,
                                 solid.bend[0].inner_radius, solid.bend[0].angle, solid.stamp[0].depth));
        const Session session = solved_part(folder / "part.stl");
        ASSERT_TRUE(session.part->solid);
        if (session.part->solid->skin != Skin::middle) { // the outer skin is laid flat instead,
                                                         // which is said
            EXPECT_FALSE(session.part->doubts.empty());
            ++fallen_back;
            continue;
        }
        // The bend is as the triangles have it: their chords are not the arc.
        expect_taken_out(session, solid, 1e-3);
    }
    EXPECT_LE(fallen_back, 1) << "seed 14, raised by 0.16 of the thickness";
}

} // namespace spia
