// Sheet whose borders are chamfered, rounded and stepped at once, with corners cut off and holes
// sunk from both sides that are open to them: what is laid flat is the solid's outline, seen square
// to the sheet.
#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

#include "tests/support/cad/bent_solid.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solid_size.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {
namespace {

using shapes::BentSolid;
using shapes::CadForm;

struct MixedSolid {
    BentSolid solid;
    double cut = 0;   ///< mm2, of corners
    double holes = 0; ///< mm2
};

/// A plate, or one with one or two bends.
MixedSolid random_mixed_borders(std::uint64_t seed)
{
    shapes::SeededRandom random(seed + 17000);
    MixedSolid result;
    BentSolid& solid = result.solid;
    const double t = solid.thickness = random.between(0.8, 5);
    solid.width = t * random.between(20, 40);
    solid.pose = seed;
    solid.leg = {t * random.between(20, 35)};
    const int bends = random.whole(0, 2);
    for (int b = 0; b < bends; ++b) {
        solid.bend.push_back({t * random.between(0.8, 3), random.between(0.4, 1.6) * (random.coin() ? 1 : -1)});
        solid.leg.push_back(t * random.between(20, 35));
    }
    solid.kind = fmt::format("mixed borders {}: t {:.3g}, {} bends", seed, t, bends);
    if (random.whole(0, 2) > 0) {
        solid.broken = {t * random.between(0.03, 0.2), random.coin(), random.coin(), random.coin()};
        solid.kind += fmt::format(", {} {:.3g} {}", solid.broken.round ? "round" : "chamfer", solid.broken.size,
                                  solid.broken.both   ? "both"
                                  : solid.broken.left ? "left"
                                                      : "right");
    }
    for (const bool across : {false, true})
        if (random.coin()) {
            solid.rebate.push_back({t * random.between(0.04, 0.19), t * random.between(1, 4), random.coin(), across});
            solid.kind +=
                fmt::format(", rebate {:.3g} x {:.3g} {} {}", solid.rebate.back().depth, solid.rebate.back().breadth,
                            solid.rebate.back().left ? "left" : "right", across ? "across" : "along");
        }
    if (random.coin()) {
        const double c = t * random.between(2, 8), side = 4 * c;
        shapes::Cutout corner;
        corner.length = corner.width = side;
        corner.radius = 0;
        corner.turn = std::numbers::pi / 4;
        corner.centre = Eigen::Vector2d::Constant((c / std::numbers::sqrt2 - side / 2) / std::numbers::sqrt2);
        solid.cutout.push_back(corner);
        result.cut = c * c / 2;
        solid.kind += fmt::format(", corner {:.3g}", c);
    }
    if (random.coin()) {
        shapes::Sink sink;
        sink.counterbore = true;
        sink.hole = t * random.between(1, 2);
        sink.wide = sink.hole + t * random.between(1, 1.5);
        sink.depth = t * random.between(0.25, 0.4);
        sink.centre = {0.55 * solid.leg[0], solid.width - sink.hole - t * random.between(0.4, 0.8)};
        for (const bool left : {true, false}) {
            sink.left = left;
            solid.sink.push_back(sink);
        }
        result.holes = round_area(sink.hole);
        solid.kind += fmt::format(", open counterbores {:.3g}", sink.wide);
    }
    return result;
}

} // namespace

TEST(MixedBorders, AreThoseOfTheSolidSeenSquareToTheSheetOrADoubt)
{
    const ScratchFolder folder;
    constexpr int family = 60;
    int unsaid = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        const MixedSolid mixed = random_mixed_borders(seed);
        SCOPED_TRACE(mixed.solid.kind);
        shapes::write_bent_solid(folder / "part.step", mixed.solid);
        const Session session = solved_part(folder / "part.step");
        ASSERT_TRUE(session.part->solid);
        if (!session.part->doubts.empty())
            continue;
        ++unsaid;
        expect_developed_size(session, mixed.solid, size_within(CadForm::step));
        // chords of 3 degrees take 0.05 % of a hole
        expect_developed_area(session, mixed.solid, mixed.cut + mixed.holes,
                              1e-5 * developed_area(mixed.solid) + 1e-3 * mixed.holes);
    }
    EXPECT_GE(unsaid, family * 5 / 6); // without the projection 26
}

TEST(MixedBorders, MayBeSteppedAtBothSidesThroughBends)
{
    const ScratchFolder folder;
    constexpr int family = 40;
    int unsaid = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        shapes::SeededRandom random(seed + 27000);
        BentSolid solid;
        const double t = solid.thickness = random.between(1, 5);
        solid.leg = {t * random.between(10, 20), t * random.between(10, 20)};
        solid.bend = {{t * random.between(0.7, 3), random.between(0.5, 1.6) * (random.coin() ? 1 : -1)}};
        solid.width = t * random.between(20, 40);
        solid.pose = seed;
        const int sides = random.whole(0, 2); // left, right, both
        for (const bool left : {true, false})
            if (sides == 2 || left == (sides == 0))
                // marks of a fifth of the thickness are the deepest that are passed over
                solid.rebate.push_back(
                    {t * (random.coin() ? 0.2 : random.between(0.05, 0.19)), t * random.between(0.7, 3), left, false});
        SCOPED_TRACE(fmt::format("{}: t {:.3g}, {} steps, the first {:.3g} x {:.3g}", seed, t, solid.rebate.size(),
                                 solid.rebate[0].depth, solid.rebate[0].breadth));
        shapes::write_bent_solid(folder / "part.step", solid);
        const Session session = solved_part(folder / "part.step");
        ASSERT_TRUE(session.part->solid);
        if (!session.part->doubts.empty() || !std::ranges::all_of(session.bends->bends, &SheetBend::laid))
            continue; // told: a floor may have other chords than its skin
        ++unsaid;
        expect_developed_size(session, solid, size_within(CadForm::step));
        expect_developed_area(session, solid, 0, 1e-5 * developed_area(solid));
    }
    EXPECT_GE(unsaid, family - 1);
}

TEST(MixedBorders, OfMeshesMayBeSteppedAndRounded)
{
    const ScratchFolder folder;
    constexpr int family = 20;
    int unsaid = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        shapes::SeededRandom random(seed + 31000);
        BentSolid solid;
        const double t = solid.thickness = random.between(1, 5);
        solid.leg = {t * random.between(15, 40)};
        solid.width = t * random.between(15, 40);
        solid.pose = seed;
        solid.broken = {t * random.between(0.1, 0.3), random.coin(), random.coin()};
        solid.rebate = {{t * random.between(0.05, 0.19), t * random.between(1, 4), random.coin(), random.coin()}};
        SCOPED_TRACE(fmt::format("{}: t {:.3g}, {} {:.3g}, step {:.3g} x {:.3g}", seed, t,
                                 solid.broken.round ? "rounding" : "chamfer", solid.broken.size, solid.rebate[0].depth,
                                 solid.rebate[0].breadth));
        shapes::write_bent_solid(folder / "part.stl", solid, CadForm::stl);
        const Session session = solved_part(folder / "part.stl");
        ASSERT_TRUE(session.part->solid);
        if (!session.part->doubts.empty()) // the chords of a rounding may be a bend beside a step
            continue;
        ++unsaid;
        expect_developed_size(session, solid, size_within(CadForm::stl));
        expect_developed_area(session, solid, 0, 1e-4 * developed_area(solid));
    }
    EXPECT_GE(unsaid, family * 4 / 5);
}

TEST(MixedBorders, MayHaveCountersinksOpenToAStep)
{
    const ScratchFolder folder;
    constexpr int family = 20;
    int unsaid = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        shapes::SeededRandom random(seed + 29000);
        BentSolid solid;
        const double t = solid.thickness = random.between(2, 8);
        solid.leg = {t * random.between(12, 20)};
        solid.width = t * random.between(8, 12);
        solid.pose = seed;
        shapes::Sink sink;
        sink.left = random.coin();
        sink.hole = t * random.between(0.4, 0.8);
        sink.depth = t * random.between(0.4, 0.8);
        sink.wide = sink.hole + sink.depth;
        sink.centre = {solid.leg[0] / 2, random.between(sink.hole + 0.15 * t, sink.wide)};
        solid.sink = {sink};
        solid.rebate = {{t * random.between(0.05, 0.2), t * random.between(0.1, 0.5), sink.left, false}};
        SCOPED_TRACE(fmt::format("{}: t {:.3g}, hole {:.3g}, {:.3g} wide at {:.3g}, step {:.3g} x {:.3g}", seed, t,
                                 sink.hole, sink.wide, sink.centre.y(), solid.rebate[0].depth,
                                 solid.rebate[0].breadth));
        shapes::write_bent_solid(folder / "part.step", solid);
        const Session session = solved_part(folder / "part.step");
        ASSERT_TRUE(session.part->solid);
        if (!session.part->doubts.empty())
            continue;
        ++unsaid;
        expect_developed_size(session, solid, size_within(CadForm::step));
        expect_developed_area(session, solid, round_area(sink.hole), 1e-3 * round_area(sink.hole));
    }
    EXPECT_GE(unsaid, 13); // the others are told
}

} // namespace spia
