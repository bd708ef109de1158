// Sheet whose border is chamfered or rounded: what is laid flat ends at its walls.
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/flat_area.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solid_size.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {
namespace {

using shapes::BentSolid;
using shapes::CadForm;

/// A plate, or one with one or two bends.
BentSolid random_broken_edges(std::uint64_t seed)
{
    shapes::SeededRandom random(seed + 11000);
    BentSolid solid;
    const double t = solid.thickness = random.between(1, 4);
    solid.width = random.between(30, 80);
    solid.pose = seed;
    solid.leg = {random.between(30, 60)};
    const int bends = random.whole(0, 2);
    for (int b = 0; b < bends; ++b) {
        solid.bend.push_back({t * random.between(0.6, 3), random.between(0.4, 1.6) * (random.coin() ? 1 : -1)});
        solid.leg.push_back(random.between(30, 60));
    }
    solid.broken = {t * random.between(0.03, 0.3), random.coin(), random.coin()};
    solid.broken.both = random.coin();
    solid.kind = fmt::format("broken edges {}: {} bends, {} of {:.3g} mm, {}", seed, bends,
                             solid.broken.round ? "round" : "chamfer", solid.broken.size,
                             solid.broken.both   ? "both"
                             : solid.broken.left ? "left"
                                                 : "right");
    return solid;
}

/// Chamfered at both sides, with holes sunk from both sides in the legs, plain ones beside them.
BentSolid random_with_sinks(std::uint64_t seed)
{
    shapes::SeededRandom random(seed + 13000);
    BentSolid solid = random_broken_edges(seed + 200);
    solid.broken.round = false;
    solid.broken.both = true;
    const double t = solid.thickness;
    solid.kind = fmt::format("sinks behind chamfers {}", seed);
    for (int leg = 0; leg < int(solid.leg.size()); ++leg)
        for (int k = random.whole(1, 3); k > 0; --k) {
            const double cell = solid.width / 3, room = std::min(solid.leg[size_t(leg)] / 2, cell / 2);
            const Eigen::Vector2d centre(solid.leg[size_t(leg)] / 2, (k - 0.5) * cell);
            const double hole = room * random.between(0.2, 0.45);
            if (random.whole(0, 3) == 0) {
                shapes::Cutout plain;
                plain.leg = leg;
                plain.centre = centre;
                plain.length = plain.width = 2 * hole;
                plain.radius = hole;
                solid.cutout.push_back(plain);
                continue;
            }
            shapes::Sink sink;
            sink.leg = leg;
            sink.centre = centre;
            sink.hole = hole;
            sink.counterbore = random.coin();
            sink.left = random.coin();
            sink.depth = random.between(0.3, 0.6) * t; // shallower wide ones are marks
            sink.wide = hole + random.between(0.3, 0.9) * std::min(0.9 * room - hole, sink.depth);
            sink.above = 0.1 * t;
            solid.sink.push_back(sink);
        }
    return solid;
}

} // namespace

TEST(BrokenEdges, DoNotMoveTheBorder)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const BentSolid solid = random_broken_edges(seed);
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            if (form == CadForm::stl && solid.broken.round)
                // facets of a rounding go on from the skin: its outer skin is laid, which is a
                // doubt
                continue;
            SCOPED_TRACE(fmt::format("{}, {}", solid.kind, form == CadForm::stl ? "STL" : "STEP"));
            const auto file = folder / (std::string("part") + extension(form));
            shapes::write_bent_solid(file, solid, form);
            const Session session = solved_part(file);
            ASSERT_TRUE(session.part->solid);
            const Eigen::Matrix2Xd& X = session.blank->blank.position;
            const double within = size_within(form);
            expect_developed_size(session, solid, within);
            EXPECT_NEAR(shapes::flat_area(X, session.part->mesh.triangle) / developed_area(solid), 1, within / 10);
        }
    }
}

TEST(BrokenEdges, BesideSunkHolesDoNotMoveTheBorder)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const BentSolid solid = random_with_sinks(seed);
        SCOPED_TRACE(solid.kind);
        shapes::write_bent_solid(folder / "part.step", solid);
        const Session session = solved_part(folder / "part.step");
        ASSERT_TRUE(session.part->solid);
        EXPECT_TRUE(session.part->doubts.empty()) << fmt::format("{}", fmt::join(session.part->doubts, "\n"));
        const Eigen::Matrix2Xd& X = session.blank->blank.position;
        expect_developed_size(session, solid, size_within(CadForm::step));
        double holes = 0;
        for (const shapes::Sink& sink : solid.sink)
            holes += round_area(sink.hole);
        for (const shapes::Cutout& hole : solid.cutout)
            holes += round_area(hole.radius);
        // chords of up to 0.2 radians take 0.7 % of a hole
        EXPECT_NEAR(shapes::flat_area(X, session.part->mesh.triangle), developed_area(solid) - holes, 0.01 * holes);
    }
}

TEST(BrokenEdges, OfSomeBordersDoNotMoveThemThroughBends)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        shapes::SeededRandom random(seed + 19000);
        BentSolid solid;
        const double t = solid.thickness = random.between(1, 5);
        solid.leg = {t * random.between(8, 20), t * random.between(8, 20)};
        solid.bend = {{t * random.between(0.7, 2), random.between(0.5, 1.6) * (random.coin() ? 1 : -1)}};
        solid.width = t * random.between(10, 20); // some are told to be more like blocks
        solid.pose = seed;
        // what a chamfer leaves of the wall crosses the middle of the sheet, or ends before it
        const double share = random.coin() ? random.between(0.1, 0.45) : random.between(0.52, 0.8);
        solid.broken = {t * share, share < 0.3 && random.coin(), random.coin(), share < 0.3, random.whole(2, 14)};
        if (share > 0.5 && random.coin())
            solid.broken_too = {t * random.between(0.05, 0.95 - share), false, !solid.broken.left};
        SCOPED_TRACE(fmt::format("{} of {} edges, {:.3g} of {:.3g} mm", solid.broken.round ? "round" : "chamfers",
                                 solid.broken.edges, solid.broken.size, t));
        shapes::write_bent_solid(folder / "part.step", solid);
        const Session session = solved_part(folder / "part.step");
        for (const std::string& doubt : session.part->doubts)
            EXPECT_THAT(doubt, testing::HasSubstr("more like a block"));
        expect_developed_size(session, solid, size_within(CadForm::step));
        expect_developed_area(session, solid, 0, 1e-5 * developed_area(solid));
    }
}

TEST(BrokenEdges, OfBendsThatAreAlmostSharpDoNotMoveTheBorder)
{
    const ScratchFolder folder;
    constexpr int family = 40;
    int told = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        shapes::SeededRandom random(seed + 47000);
        BentSolid solid;
        const double t = solid.thickness = random.between(1, 5);
        solid.leg = {t * random.between(10, 20), t * random.between(10, 20)};
        solid.bend = {{t * random.between(0.02, 0.1), random.between(0.7, 1.6) * (random.coin() ? 1 : -1)}};
        solid.width = t * random.between(14, 20);
        solid.pose = seed;
        const bool outside = solid.bend[0].angle > 0; // of the bend: to its left are the centres of bends to the left
        solid.broken = {t * random.between(0.15, 0.45), true, !outside};
        if (random.coin())
            solid.broken_too = {t * random.between(0.05, 0.3), false, outside};
        SCOPED_TRACE(fmt::format("{}: R {:.3g} t, {:.3g} radians, rounding {:.3g}, chamfer {:.3g}, t {:.3g}", seed,
                                 solid.bend[0].inner_radius / t, solid.bend[0].angle, solid.broken.size,
                                 solid.broken_too.size, t));
        shapes::write_bent_solid(folder / "part.step", solid);
        const Session session = solved_part(folder / "part.step");
        if (!session.part->doubts.empty()) {
            ++told;
            continue;
        }
        expect_developed_size(session, solid, size_within(CadForm::step));
        expect_developed_area(session, solid, 0, 1e-5 * developed_area(solid));
    }
    EXPECT_LE(told, family / 20);
}

TEST(BrokenEdges, MayBeChamferedAtOneSideAndRoundedAtTheOther)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        shapes::SeededRandom random(seed + 21000);
        BentSolid solid;
        const double t = solid.thickness = random.between(0.5, 5);
        solid.leg = {t * random.between(15, 40)};
        if (random.coin()) {
            solid.bend = {{t * random.between(0.7, 3), random.between(0.4, 1.6) * (random.coin() ? 1 : -1)}};
            solid.leg.push_back(t * random.between(15, 40));
        }
        solid.width = t * random.between(15, 40);
        solid.pose = seed;
        const bool left = random.coin();
        const int edges = random.whole(0, 1) * 2; // or all
        solid.broken = {t * random.between(0.05, 0.4), false, left, false, edges};
        solid.broken_too = {t * random.between(0.05, 0.4), true, !left, false, edges};
        for (const CadForm form : {CadForm::step, CadForm::iges, CadForm::stl}) {
            if (form == CadForm::stl && !solid.bend.empty()) // facets of a rounding beside a bend are a doubt
                continue;
            SCOPED_TRACE(fmt::format("{}: chamfer {:.3g}, rounding {:.3g}, t {:.3g}, {} edges{}", seed,
                                     solid.broken.size, solid.broken_too.size, t, edges, extension(form)));
            const auto file = folder / (std::string("part") + extension(form));
            shapes::write_bent_solid(file, solid, form);
            const Session session = solved_part(file);
            ASSERT_TRUE(session.part->solid);
            for (const std::string& doubt : session.part->doubts)
                EXPECT_THAT(doubt, testing::HasSubstr("more like a block"));
            expect_developed_size(session, solid, size_within(form));
            expect_developed_area(session, solid, 0, size_within(form) / 10 * developed_area(solid));
        }
    }
}

TEST(BrokenEdges, GoAroundRoundCorners)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        shapes::SeededRandom random(seed + 23000);
        BentSolid solid;
        const double t = solid.thickness = random.between(0.5, 4);
        solid.leg = {t * random.between(15, 60)};
        if (random.whole(0, 3) > 0) {
            solid.bend = {{t * random.between(0.7, 3), random.between(0.4, 1.6) * (random.coin() ? 1 : -1)}};
            solid.leg.push_back(t * random.between(15, 60));
        }
        solid.width = t * random.between(20, 80);
        solid.corner = random.between(0.1, 0.8) * std::min({solid.leg.front(), solid.leg.back(), solid.width / 2});
        solid.pose = seed;
        solid.broken = {t * random.between(0.05, 0.3), random.coin(), random.coin(), random.coin()};
        SCOPED_TRACE(fmt::format("{}: corners {:.3g}, t {:.3g}, {} {:.3g} {}", seed, solid.corner, t,
                                 solid.broken.round ? "round" : "chamfer", solid.broken.size,
                                 solid.broken.both ? "both" : "one"));
        shapes::write_bent_solid(folder / "part.step", solid);
        const Session session = solved_part(folder / "part.step");
        for (const std::string& doubt : session.part->doubts)
            EXPECT_THAT(doubt, testing::HasSubstr("more like a block"));
        expect_developed_size(session, solid, size_within(CadForm::step));
        // 120 chords of 3 degrees take 0.0015 of the radius squared
        const double r2 = solid.corner * solid.corner, made = developed_area(solid) - 4 * r2 + round_area(solid.corner);
        EXPECT_NEAR(shapes::flat_area(session.blank->blank.position, session.part->mesh.triangle), made - 0.0007 * r2,
                    0.001 * r2 + 1e-5 * made);
    }
}

TEST(BrokenEdges, OfPartsThatAreDeburredAllAroundLeaveTheirSize)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        shapes::SeededRandom random(seed + 53000);
        BentSolid solid;
        const double t = solid.thickness = random.between(1.5, 5);
        solid.leg = {t * random.between(15, 40)};
        if (random.coin()) {
            solid.bend = {{t * random.between(0.7, 2), random.between(0.5, 1.6) * (random.coin() ? 1 : -1)}};
            solid.leg.push_back(t * random.between(15, 40));
        }
        solid.width = t * random.between(15, 40);
        solid.pose = seed;
        solid.broken = {random.between(0.1, 0.3), random.coin(), true, true, 0, false, true};
        if (solid.bend.empty() && random.coin()) { // its edges, too
            shapes::Cutout hole;
            hole.centre = {solid.leg[0] * random.between(0.3, 0.7), solid.width * random.between(0.3, 0.7)};
            hole.radius = t * random.between(1.5, 4);
            hole.length = hole.width = 2 * hole.radius;
            solid.cutout = {hole};
            solid.broken.cut = true;
        }
        SCOPED_TRACE(fmt::format("{}: t {:.3g}, {} {:.3g}, {} bends, {} holes", seed, t,
                                 solid.broken.round ? "round" : "chamfers", solid.broken.size, solid.bend.size(),
                                 solid.cutout.size()));
        shapes::write_bent_solid(folder / "part.step", solid);
        const Session session = solved_part(folder / "part.step");
        for (const std::string& doubt : session.part->doubts)
            EXPECT_THAT(doubt, testing::HasSubstr("more like a block"));
        constexpr double fine = 2e-3; // of the thickness: nearer than that nothing is put right
        expect_developed_size(session, solid, 2 * fine * t);
    }
}

TEST(BrokenEdges, BesideATaperedFlangeDoNotMoveTheEndOfTheBend)
{
    const ScratchFolder folder;
    constexpr int family = 60;
    int told = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        shapes::SeededRandom random(seed + 33000);
        BentSolid solid;
        const double t = solid.thickness = random.between(0.6, 4);
        solid.leg = {t * random.between(15, 25), t * random.between(15, 25)};
        solid.bend = {{t * random.between(0.4, 2), random.between(0.5, 1.6) * (random.coin() ? 1 : -1)}};
        solid.width = t * random.between(20, 30);
        solid.pose = seed;
        solid.broken = {t * random.between(0.25, 0.45), false, random.coin(), false, 0, seed % 4 < 2};
        if (seed % 2 == 0)
            solid.broken_too = {t * random.between(0.35, 0.45), true, !solid.broken.left, false, 0, solid.broken.cut};
        // from a little after the bend on, 15 to 34 degrees: about as much as chords of coarse arcs
        // turn by
        const double from = t * random.between(1.1, 3), angle = random.between(0.26, 0.6), run = solid.leg[1] - from,
                     side = 4 * solid.leg[1];
        shapes::Cutout taper;
        taper.leg = 1;
        taper.length = taper.width = side;
        taper.radius = 0;
        taper.turn = angle;
        const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), below(std::sin(angle), -std::cos(angle));
        taper.centre = Eigen::Vector2d(from, 0) + side / 2 * (0.9 * along + below);
        solid.cutout = {taper};
        SCOPED_TRACE(fmt::format("{}: t {:.3g}, chamfer {:.3g}, taper from {:.3g}, {:.3g} radians", seed, t,
                                 solid.broken.size, from, angle));
        shapes::write_bent_solid(folder / "part.step", solid);
        const Session session = solved_part(folder / "part.step");
        if (std::ranges::any_of(session.part->doubts, [](const std::string& doubt) {
                return doubt.find("more like a block") == std::string::npos;
            })) {
            ++told;
            continue;
        }
        expect_developed_size(session, solid, 0.01 * t); // what is nearer to its place is not told
        const double made = developed_area(solid) - run * run * std::tan(angle) / 2;
        EXPECT_NEAR(shapes::flat_area(session.blank->blank.position, session.part->mesh.triangle) / made, 1, 1e-4);
    }
    EXPECT_LE(told, family / 20);
}

TEST(BrokenEdges, OfWhatIsNoSheetLeaveAHollowBodyWithADoubt)
{
    const ScratchFolder folder;
    BentSolid solid; // half as thick over a fifth of it, and so thick that it may be a box
    solid.thickness = 8;
    solid.leg = {50};
    solid.width = 40;
    solid.broken.size = 1;
    solid.rebate = {{4, 8, true, false}};
    shapes::write_bent_solid(folder / "part.stl", solid, CadForm::stl);
    const PartFile part = read_part(folder / "part.stl");
    EXPECT_FALSE(part.solid);
    EXPECT_THAT(part.doubts, testing::Contains(testing::HasSubstr("It is taken as a hollow body")));
}

TEST(BrokenEdges, OfOneSideDoNotMoveWhatIsBesideThem)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        shapes::SeededRandom random(seed + 15000);
        BentSolid solid;
        solid.thickness = random.between(1, 4);
        solid.leg = {random.between(60, 100)};
        solid.width = random.between(30, 50);
        solid.pose = seed;
        solid.broken.size = solid.thickness * random.between(0.05, 0.3);
        solid.broken.left = random.coin();
        solid.broken.edges = random.whole(1, 3);
        shapes::Cutout hole;
        hole.centre = {random.between(10, 25), random.between(8, 13)};
        hole.length = hole.width = 6;
        hole.radius = 3;
        solid.cutout = {hole};
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            SCOPED_TRACE(fmt::format("one side broken {}{}", seed, extension(form)));
            const auto file = folder / (std::string("part") + extension(form));
            shapes::write_bent_solid(file, solid, form);
            const Session session = solved_part(file);
            const Eigen::Matrix2Xd& X = session.blank->blank.position;
            const Eigen::Vector2d low = X.rowwise().minCoeff(), size = X.rowwise().maxCoeff() - low;
            EXPECT_NEAR(size.minCoeff(), solid.width, 2e-3);
            EXPECT_NEAR(size.maxCoeff(), solid.leg[0], 2e-3);
            ASSERT_EQ(session.blank->blank.position.cols(), session.part->mesh.vertices());
            const auto loops = boundary_loops(session.part->mesh);
            ASSERT_EQ(loops.size(), 2u);
            const Eigen::Matrix2Xd rim = X(Eigen::all, loops[1]); // the longest comes first
            const Eigen::Vector2d middle = (rim.rowwise().maxCoeff() + rim.rowwise().minCoeff()) / 2 - low;
            // from the nearer borders, whichever way the blank is turned
            EXPECT_NEAR(std::min(middle.x(), size.x() - middle.x()), hole.centre.x(), 0.02);
            EXPECT_NEAR(std::min(middle.y(), size.y() - middle.y()), hole.centre.y(), 0.02);
        }
    }
}

} // namespace spia
