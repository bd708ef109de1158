// Holes whose walls cross the sheet askew, in its flats: the blank has them where and as they are
// in the middle of the sheet.
#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <string>

#include "engine/mesh/topology.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/cad/exact_volume.h"
#include "tests/support/family.h"
#include "tests/support/flat_area.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solid_size.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {
namespace {

using shapes::BentSolid;
using shapes::CadForm;
using shapes::Cutout;

/// A plate or a bracket with one to six of them, round ones drilled, long and square ones extruded,
/// that lean by up to 60 degrees: farther beside than they are wide at times.
BentSolid random_oblique_holes(std::uint64_t seed)
{
    shapes::SeededRandom random(seed + 7000);
    BentSolid solid;
    solid.kind = fmt::format("oblique holes {}", seed);
    const double t = solid.thickness = random.between(1, 4), cell = 12 * t;
    solid.pose = seed;
    solid.leg = {3 * cell};
    solid.width = 2 * cell;
    if (random.coin()) {
        solid.leg.push_back(cell);
        solid.bend.push_back({t * random.between(0.6, 3), random.between(0.5, 1.5) * (random.coin() ? 1 : -1)});
    }
    const int count = random.whole(1, 6);
    for (int k = 0; k < count; ++k) {
        Cutout hole;
        const int row = k / 3;
        hole.centre = {(k % 3 + 0.5) * cell, (row + 0.5) * cell};
        const int kind = random.whole(0, 3);
        hole.width = t * random.between(0.8, 2.5);
        hole.length = kind < 2 ? hole.width : hole.width * random.between(1.2, 2);
        hole.radius = kind == 3 ? 0.1 * hole.width : hole.width / 2;
        hole.turn = random.between(-1.5, 1.5);
        const double lean = random.between(0.1, 1.7), to = random.between(0, 6.3);
        hole.lean = {lean * std::cos(to), lean * std::sin(to)};
        solid.cutout.push_back(hole);
    }
    return solid;
}

} // namespace

TEST(ObliqueHoles, AreInTheBlankAsInTheMiddleOfTheSheet)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= shapes::family_size(24); ++seed)
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            const BentSolid solid = random_oblique_holes(seed);
            const auto step = folder / "part.step", file = folder / (std::string("part") + extension(form));
            SCOPED_TRACE(solid.kind + extension(form));
            shapes::write_bent_solid(step, solid);
            shapes::write_bent_solid(file, solid, form);
            const Session session = solved_part(file);
            const PartFile& part = *session.part;
            ASSERT_TRUE(part.solid);
            EXPECT_TRUE(part.doubts.empty()) << fmt::format("{}", fmt::join(part.doubts, "\n"));
            EXPECT_EQ(boundary_loops(part.mesh).size(), 1 + solid.cutout.size());
            const Eigen::Matrix2Xd& X = session.blank->blank.position;
            expect_developed_size(session, solid, size_within(form));
            EXPECT_LT(session.blank->face.strain_equivalent.maxCoeff(), form == CadForm::stl ? 5e-3 : 1e-3);
            // The volume of the sheet over its thickness is its area in the middle; chords of up to
            // 0.2 radians take 0.7 % of a hole.
            const double area = shapes::exact_volume(step) / solid.thickness, holes = developed_area(solid) - area;
            EXPECT_NEAR(shapes::flat_area(X, part.mesh.triangle), area, 0.01 * holes);
        }
}

TEST(ObliqueHoles, WithChamfersAreThoseInTheMiddleOfTheSheetAsWell)
{
    const ScratchFolder folder;
    constexpr int family = 60;
    int unsaid = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        shapes::SeededRandom random(seed + 41000);
        BentSolid solid;
        const double t = solid.thickness = random.between(2, 8);
        solid.leg = {10 * t};
        solid.width = 8 * t;
        solid.pose = seed;
        Cutout hole;
        hole.centre = {5 * t, 4 * t};
        hole.radius = t * random.between(0.5, 1.2);
        hole.length = hole.width = 2 * hole.radius;
        const double lean = random.between(0.15, 0.8), to = random.between(0, 6.3); // 9 to 39 degrees
        hole.lean = {lean * std::cos(to), lean * std::sin(to)};
        solid.cutout = {hole};
        solid.broken = {t * random.between(0.05, 0.3), false, random.coin()};
        solid.broken.cut = true;
        SCOPED_TRACE(fmt::format("{}: t {:.3g}, hole {:.3g}, lean {:.3g}, chamfer {:.3g}", seed, t, hole.radius, lean,
                                 solid.broken.size));
        shapes::write_bent_solid(folder / "part.step", solid);
        const Session session = solved_part(folder / "part.step");
        ASSERT_TRUE(session.part->solid);
        if (!session.part->doubts.empty()) // chords of the file, where both sides of the hole meet
            continue;
        ++unsaid;
        expect_developed_size(session, solid, size_within(CadForm::step));
        const double drilled = round_area(hole.radius) * std::sqrt(1 + lean * lean);
        // chords of 0.35 radians take 2 % of a hole
        EXPECT_NEAR(shapes::flat_area(session.blank->blank.position, session.part->mesh.triangle),
                    developed_area(solid) - drilled, 0.025 * drilled);
    }
    EXPECT_GE(unsaid, 50); // the others are told
}

} // namespace spia
