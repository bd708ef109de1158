// Holes that are sunk up to the border of the sheet, touching it or open to it, beside others that
// are sunk from the other side: what is cut is the least diameter, and the border stays straight.
#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <string>

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
using shapes::Sink;

Sink random_sink(shapes::SeededRandom& random, double thickness)
{
    Sink sink;
    sink.hole = random.between(0.8, 2) * thickness;
    sink.counterbore = random.coin();
    sink.depth = random.between(0.25, 0.45) * thickness;
    sink.wide = sink.hole + random.between(0.7, 1) * (sink.counterbore ? thickness : sink.depth);
    sink.left = random.coin();
    return sink;
}

/// One in the middle of a plate or of a leg of a bracket, one whose circle touches the border.
BentSolid random_touching_sink(std::uint64_t seed)
{
    shapes::SeededRandom random(seed + 11000);
    BentSolid solid;
    solid.kind = fmt::format("touching sink {}", seed);
    const double t = solid.thickness = random.between(1, 4);
    solid.pose = seed;
    solid.leg = {30 * t};
    solid.width = 14 * t;
    if (random.coin()) {
        solid.leg.push_back(10 * t);
        solid.bend.push_back({t * random.between(0.6, 3), random.between(0.5, 1.5) * (random.coin() ? 1 : -1)});
    }
    Sink inside = random_sink(random, t), touching = random_sink(random, t);
    inside.centre = {9 * t, 7 * t};
    inside.left = !touching.left;
    touching.centre = {21 * t, random.coin() ? touching.wide : solid.width - touching.wide};
    solid.sink = {inside, touching};
    return solid;
}

/// One that is sunk from both sides: open to the border at one of them.
BentSolid random_open_sink(std::uint64_t seed)
{
    BentSolid solid = random_touching_sink(seed + 100);
    solid.kind = fmt::format("open sink {}", seed);
    Sink open = solid.sink[1], closed = open;
    const double t = solid.thickness, room = 0.5 * (open.hole + open.wide);
    open.centre.y() = room;
    closed.centre = open.centre;
    closed.left = !open.left;
    closed.wide = open.hole + 0.6 * (room - open.hole);
    closed.counterbore = true;
    closed.depth = 0.3 * t;
    solid.sink = {open, closed};
    return solid;
}

void expect_least_diameters(const ScratchFolder& folder, const BentSolid& solid, CadForm form, size_t holes, double cut)
{
    SCOPED_TRACE(solid.kind + extension(form));
    const auto file = folder / (std::string("part") + extension(form));
    shapes::write_bent_solid(file, solid, form);
    const Session session = solved_part(file);
    const PartFile& part = *session.part;
    ASSERT_TRUE(part.solid);
    EXPECT_TRUE(part.doubts.empty()) << fmt::format("{}", fmt::join(part.doubts, "\n"));
    EXPECT_EQ(boundary_loops(part.mesh).size(), 1 + holes);
    const Eigen::Matrix2Xd& X = session.blank->blank.position;
    expect_developed_size(session, solid, size_within(form));
    // chords of up to 0.2 radians take 0.7 % of a hole
    EXPECT_NEAR(shapes::flat_area(X, part.mesh.triangle), developed_area(solid) - cut, 0.01 * cut);
}

} // namespace

TEST(BorderingSinks, ThatTouchTheBorderLeaveItStraight)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 24; ++seed)
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            const BentSolid solid = random_touching_sink(seed);
            expect_least_diameters(folder, solid, form, 2,
                                   round_area(solid.sink[0].hole) + round_area(solid.sink[1].hole));
        }
}

TEST(BorderingSinks, OpenAtOneSkinAreCutAtTheirLeastDiameter)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 24; ++seed)
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            const BentSolid solid = random_open_sink(seed);
            expect_least_diameters(folder, solid, form, 1, round_area(solid.sink[0].hole));
        }
}

} // namespace spia
