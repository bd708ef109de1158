// Parts as other programs leave them: far from the origin in files of few digits, of splines alone,
// with holes and slits that are tiny beside them.
#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>
#include <tuple>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/curvature.h"
#include "engine/part/curved_faces.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/cad/joined_tray.h"
#include "tests/support/cad/random_bent_solid.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {
namespace {

void expect_bends(const Session& session, const shapes::BentSolid& solid)
{
    const double area = solid.developed(0.5) * solid.width;
    EXPECT_NEAR(sheet_area(*session.part), area, 1e-4 * area);
    const auto& bends = session.bends->bends;
    EXPECT_EQ(bends.size(), solid.bend.size());
    for (const shapes::SolidBend& made : solid.bend)
        EXPECT_TRUE(std::ranges::any_of(bends,
                                        [&](const SheetBend& bend) {
                                            return std::abs(bend.angle - std::abs(made.angle)) < 2e-3 &&
                                                   std::abs(bend.inner_radius - made.inner_radius) <
                                                       2e-3 * solid.thickness;
                                        }))
            << "R " << made.inner_radius << ", " << made.angle << " radians";
}

} // namespace

/// What it is moved by, mm, and how it is written.
class FarParts : public testing::TestWithParam<std::tuple<double, shapes::CadForm>> {};

TEST_P(FarParts, HaveAllOfTheirBends)
{
    const auto [away, form] = GetParam();
    const ScratchFolder folder;
    constexpr std::uint64_t family = 20;
    int read = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        shapes::BentSolid solid = shapes::random_bent_solid(seed + 91000);
        solid.pose = seed;
        solid.away = away;
        solid.hole = false;
        SCOPED_TRACE(fmt::format("{}: {}, t {:.3g}, {} bends", seed, solid.kind, solid.thickness, solid.bend.size()));
        const auto file = folder / fmt::format("part{}", shapes::extension(form));
        shapes::write_bent_solid(file, solid, form);
        try {
            const Session session = solved_part(file, solid.thickness);
            ++read;
            if (!session.part->doubts.empty() || !session.part->doctor.healthy())
                continue;
            expect_bends(session, solid);
        } catch (const InputError& error) { // coarser than the thinnest of them
            EXPECT_GT(std::string(error.what()).size(), 20u);
        }
    }
    EXPECT_GE(read, int(family * 3 / 4));
}

// As programs write them that know nothing but splines.
TEST(SplineParts, HaveTheirBends)
{
    const ScratchFolder folder;
    for (const shapes::CadForm form : {shapes::CadForm::step, shapes::CadForm::iges})
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            shapes::BentSolid solid = shapes::random_bent_solid(seed + 92000);
            solid.splines = true;
            solid.hole = false;
            SCOPED_TRACE(fmt::format("{}: {}, t {:.3g}, {}", seed, solid.kind, solid.thickness, extension(form)));
            const auto file = folder / fmt::format("part{}", shapes::extension(form));
            shapes::write_bent_solid(file, solid, form);
            expect_bends(solved_part(file, solid.thickness), solid);
        }
}

// Lower than a millionth of their length, and right: what is between a small hole and the far ends.
TEST(LongProfiles, MayHaveTinyHoles)
{
    const ScratchFolder folder;
    for (const double length : {1000., 3000., 6000.})
        for (const double radius : {0.5, 1., 1.5}) {
            SCOPED_TRACE(fmt::format("{} mm long, hole of radius {}", length, radius));
            shapes::BentSolid solid;
            solid.kind = "channel";
            solid.width = length;
            solid.leg = {60, 150, 60};
            solid.bend = {{2, std::numbers::pi / 2}, {2, std::numbers::pi / 2}};
            solid.cutout = {
                {.leg = 1, .centre = {75, length / 2}, .length = 2 * radius, .width = 2 * radius, .radius = radius}};
            shapes::write_bent_solid(folder / "part.step", solid);
            const Session session = solved_part(folder / "part.step", solid.thickness);
            const double area = solid.developed(0.5) * length - std::numbers::pi * radius * radius;
            EXPECT_NEAR(sheet_area(*session.part), area, 1e-5 * area);
            EXPECT_EQ(session.bends->bends.size(), 2u);
        }
}

// Rounded where they are bent up: what lacks at a corner is all along the mitre of both bends.
TEST(JoinedTrays, UnrollOnceTheirMitresAreCut)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        shapes::SeededRandom random(seed + 93000);
        shapes::JoinedTray tray;
        const double t = tray.thickness = random.between(0.6, 3);
        tray.radius = t * random.between(0.4, 4);
        const double least = 2 * (tray.radius + t);
        tray.length = least + t * random.between(10, 60);
        tray.width = least + t * random.between(10, 60);
        tray.height = tray.radius + t + t * random.between(2, 12);
        SCOPED_TRACE(fmt::format("{}: {:.4g} x {:.4g} x {:.4g}, t {:.3g}, R {:.3g}", seed, tray.length, tray.width,
                                 tray.height, t, tray.radius));
        shapes::write_joined_tray(folder / "tray.step", tray);
        const PartFile joined = read_part(folder / "tray.step");
        EXPECT_TRUE(joined.doctor.find(Fault::closed_corner));
        ReadOptions options;
        options.seam.mode = SeamOptions::Mode::corners;
        const PartFile cut = read_part(folder / "tray.step", options);
        EXPECT_EQ(cut.seam.size(), 4u);
        EXPECT_NEAR(sheet_area(cut), tray.area(), 2e-4 * tray.area()); // chords of the mitres
        EXPECT_LT(angle_defects(cut.mesh).cwiseAbs().sum(), 0.02);
    }
}

// Their other side is sheet again, no farther than a border may be off without being told.
TEST(Slits, AreNoBordersOffTheirPlaces)
{
    const ScratchFolder folder;
    for (const double width : {0.01, 0.02, 0.05, 0.1}) {
        SCOPED_TRACE(fmt::format("{} mm wide", width));
        shapes::BentSolid solid;
        solid.leg = {60, 40};
        solid.bend = {{2, std::numbers::pi / 3}};
        solid.cutout = {{.leg = 0, .centre = {30, 15}, .length = 20, .width = width, .radius = 0}};
        shapes::write_bent_solid(folder / "part.step", solid);
        const PartFile part = read_part(folder / "part.step");
        EXPECT_TRUE(part.doubts.empty()) << part.doubts.front();
    }
}

INSTANTIATE_TEST_SUITE_P(Distances, FarParts,
                         testing::Combine(testing::Values(2e3, 2e4, 1e5),
                                          testing::Values(shapes::CadForm::step, shapes::CadForm::iges)));

} // namespace spia
