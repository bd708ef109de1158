// Holes of every kind in one part: plain, long and sunk ones from either side in the legs, drilled
// ones through the bends.
#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <numbers>

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

using shapes::BendCut;
using shapes::BentSolid;
using shapes::Cutout;
using shapes::Sink;

/// One in a cell of a leg. @param room  mm, of the cell
void add_hole(BentSolid& solid, shapes::SeededRandom& random, int leg, const Eigen::Vector2d& centre, double room)
{
    const double radius = random.between(0.06, 0.14) * room;
    const int kind = random.whole(0, 5);
    if (kind <= 1) { // round, long
        Cutout hole;
        hole.leg = leg;
        hole.centre = centre;
        hole.width = 2 * radius;
        hole.length = kind == 0 ? hole.width : hole.width * random.between(1.3, 2.5);
        hole.radius = radius;
        hole.turn = random.between(-1.5, 1.5);
        solid.cutout.push_back(hole);
    } else if (kind <= 4) {
        Sink sink;
        sink.leg = leg;
        sink.centre = centre;
        sink.hole = radius;
        sink.counterbore = random.coin();
        sink.left = random.coin();
        sink.depth = random.between(0.3, 0.8) * solid.thickness; // shallower wide ones are marks
        const double most = 0.4 * room - radius;
        sink.wide = radius + random.between(0.2, 1) * (sink.counterbore ? most : std::min(most, sink.depth));
        // a flat cone is so wide there that it meets the next leg
        sink.above = 0.1 * solid.thickness;
        solid.sink.push_back(sink);
    }
}

/// One or two bends, up to six holes in each leg, up to three in each bend.
BentSolid random_mixed_holes(std::uint64_t seed)
{
    shapes::SeededRandom random(seed + 9000);
    BentSolid solid;
    solid.kind = fmt::format("mixed holes {}", seed);
    const double t = solid.thickness = random.between(1.5, 4);
    solid.pose = seed;
    const int bends = random.whole(1, 2), across = random.whole(1, 3);
    solid.width = across * random.between(35, 50);
    for (int leg = 0; leg <= bends; ++leg)
        solid.leg.push_back(random.between(45, 90));
    for (int b = 0; b < bends; ++b)
        solid.bend.push_back({t * random.between(0.6, 3), random.between(0.5, 1.6) * (random.coin() ? 1 : -1)});
    for (int leg = 0; leg <= bends; ++leg) {
        const double length = solid.leg[size_t(leg)];
        const int along = length > 70 ? 2 : 1;
        for (int i = 0; i < along; ++i)
            for (int j = 0; j < across; ++j)
                add_hole(solid, random, leg, {(i + 0.5) * length / along, (j + 0.5) * solid.width / across},
                         std::min(length / along, solid.width / across));
    }
    for (int b = 0; b < bends; ++b)
        for (int j = 0; j < across; ++j)
            if (random.whole(0, 2) > 0) {
                const shapes::SolidBend& bend = solid.bend[size_t(b)];
                BendCut cut;
                cut.bend = b;
                cut.y = (j + 0.5) * solid.width / across;
                const double arc = (bend.inner_radius + t / 2) * std::abs(bend.angle);
                cut.outline.length = cut.outline.width = arc * random.between(0.2, 0.6);
                cut.outline.radius = cut.outline.width / 2;
                solid.bend_cut.push_back(cut);
            }
    return solid;
}

/// mm3, of what is sunk around the holes that go all through.
double sunk_volume(const BentSolid& solid)
{
    double volume = 0;
    for (const Sink& s : solid.sink)
        volume += std::numbers::pi * s.depth *
                  (s.counterbore ? s.wide * s.wide - s.hole * s.hole
                                 : (s.wide * s.wide + s.wide * s.hole + s.hole * s.hole) / 3 - s.hole * s.hole);
    return volume;
}

} // namespace

TEST(MixedHoles, AreAllInTheBlankAndStrainNothing)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= shapes::family_size(40); ++seed) {
        const BentSolid solid = random_mixed_holes(seed);
        SCOPED_TRACE(solid.kind);
        const Session session = solved_bent_solid(folder / "part.step", solid);
        const PartFile& part = *session.part;
        ASSERT_TRUE(part.solid);
        EXPECT_TRUE(part.doubts.empty()) << fmt::format("{}", fmt::join(part.doubts, "\n"));
        EXPECT_EQ(boundary_loops(part.mesh).size(),
                  1 + solid.cutout.size() + solid.sink.size() + solid.bend_cut.size());
        EXPECT_EQ(part.solid->marks.size(), solid.sink.size());
        const Eigen::Matrix2Xd& X = session.blank->blank.position;
        expect_developed_size(session, solid, size_within(shapes::CadForm::step));
        EXPECT_LT(session.blank->face.strain_equivalent.maxCoeff(), 1e-3);
        const double area = shapes::flat_area(X, part.mesh.triangle),
                     expected = (shapes::exact_volume(session.file) + sunk_volume(solid)) / solid.thickness;
        EXPECT_NEAR(area / expected, 1, 2e-4);
    }
}

} // namespace spia
