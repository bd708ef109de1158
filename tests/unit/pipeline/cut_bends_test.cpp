#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>

#include "engine/core/error.h"
#include "engine/mesh/flat/outline.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/blank/bends_for_shop.h"
#include "engine/pipeline/blank/drawn_blank.h"
#include "engine/pipeline/session.h"
#include "engine/unfold/plan/bends.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/cad/random_bent_solid.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia::cut_bends_test {
namespace {

namespace fs = std::filesystem;
using shapes::BentSolid;
constexpr double degree = std::numbers::pi / 180;

/// Across the bends and along them, mm.
Eigen::Vector2d size_of(const Session& session)
{
    const auto& bends = session.bends->bends;
    if (bends.empty() || bends[0].line.empty())
        return {0, 0};
    const Eigen::Vector2d along = (bends[0].line[0].to - bends[0].line[0].from).normalized();
    Eigen::Matrix2d axes;
    axes << along[1], -along[0], along[0], along[1];
    const Eigen::Matrix2Xd turned = axes * session.blank->blank.position;
    return turned.rowwise().maxCoeff() - turned.rowwise().minCoeff();
}

/// How far what is found may be off. Of STL: vertices are single precision, and the border has the
/// chords of the mesher.
struct Bounds {
    double length, radius, angle; ///< of the length and of the radius; radians
};

void expect_as_made(const Session& session, const BentSolid& solid, const Bounds& within)
{
    const Eigen::Vector2d size = size_of(session);
    const double length = solid.developed(0.5);
    EXPECT_NEAR(size[0], length, within.length * length);
    EXPECT_NEAR(size[1], solid.width, within.length * solid.width);
    const auto& bends = session.bends->bends;
    EXPECT_EQ(bends.size(), solid.bend.size());
    for (const shapes::SolidBend& made : solid.bend)
        EXPECT_TRUE(std::any_of(bends.begin(), bends.end(),
                                [&](const SheetBend& bend) {
                                    return std::abs(bend.inner_radius - made.inner_radius) <
                                               within.radius * made.inner_radius &&
                                           std::abs(bend.angle - std::abs(made.angle)) < within.angle && bend.laid;
                                }))
            << "R " << made.inner_radius << ", " << made.angle / degree << " degrees";
    for (const SheetBend& bend : bends)
        if (!bend.laid)
            ADD_FAILURE() << "R " << bend.inner_radius << ", " << bend.angle / degree << ": " << bend.why_not;
    const BlankDrawing drawing = drawn_blank(*session.part, bends_for_shop(*session.part), session.blank->blank,
                                             session.blank->face, true, &*session.bends);
    EXPECT_EQ(drawing.bends.size(), solid.bend.size()) << "a bend line with a text for each";
    for (const DrawnBend& drawn : drawing.bends) { // by the numbers of the table
        size_t row = 0;
        while (row < bends.size() && drawn.name != fmt::format("bend {}", row + 1))
            ++row;
        ASSERT_LT(row, bends.size()) << drawn.name;
        EXPECT_EQ(drawn.angle, bends[row].angle) << drawn.name;
        EXPECT_EQ(drawn.inner_radius, bends[row].inner_radius) << drawn.name;
    }
}

std::string describe(const BentSolid& solid)
{
    std::string text = fmt::format("t {:.4g}, width {:.4g}", solid.thickness, solid.width);
    for (size_t b = 0; b < solid.bend.size(); ++b) {
        const shapes::BendCut& cut = solid.bend_cut[b];
        text += fmt::format(
            "; R/t {:.3g}, {:.4g} degrees, cut {:.3g} x {:.3g}, r {:.3g}, lean {:.3g}, turn {:.3g} at {:.3g} of "
            "it, y {:.3g}",
            solid.bend[b].inner_radius / solid.thickness, solid.bend[b].angle / degree, cut.outline.length,
            cut.outline.width, cut.outline.radius, cut.lean / degree, cut.outline.turn / degree, cut.share, cut.y);
    }
    return text;
}

class CutBends : public testing::TestWithParam<std::uint64_t> {
protected:
    void expect_of_step(const BentSolid& solid)
    {
        SCOPED_TRACE(describe(solid));
        shapes::write_bent_solid(folder_ / "part.step", solid);
        expect(folder_ / "part.step", solid, {1e-4, 1e-3, 1e-3});
    }
    /// With chords of 3 to 20 degrees.
    void expect_of_stl(const BentSolid& solid)
    {
        shapes::SeededRandom random(GetParam() + 1000);
        const double chord = degree * random.between(3, 20);
        SCOPED_TRACE(fmt::format("{}; chords of {:.3g} degrees", describe(solid), chord / degree));
        shapes::write_bent_stl(folder_ / "part.stl", solid, chord);
        expect(folder_ / "part.stl", solid, {5e-4, 2e-3, 2e-3});
    }

private:
    void expect(const fs::path& file, const BentSolid& solid, const Bounds& within)
    {
        try {
            expect_as_made(solved_part(file), solid, within);
        } catch (const Error& error) {
            ADD_FAILURE() << error.what();
        }
    }
    ScratchFolder folder_;
};

/// Milled straight through the first leg, the bend and the flange beside it, whose wall lies the
/// flatter in the sheet the more it is bent.
TEST(Windows, ThatAreCutAlongALegEndWhereTheirWallCrossesTheMiddleOfTheFlange)
{
    const ScratchFolder folder;
    constexpr std::uint64_t family = 24;
    int quiet = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        shapes::SeededRandom random(seed + 83000);
        BentSolid solid;
        const double t = solid.thickness = random.between(0.8, 3), angle = degree * random.between(20, 79),
                     radius = t * random.between(0.5, 3), arc = radius + t / 2;
        solid.width = 40;
        solid.bend = {{radius, angle}};
        const double up = t / 2 * std::tan(angle) * random.between(0.8, 2) + t, // along the flange
            reach = arc * std::sin(angle) + up * std::cos(angle);
        solid.leg = {reach + 10, up + t * std::tan(angle) + 10};
        shapes::BendCut cut;
        cut.share = 0;
        cut.y = 20;
        cut.reach = 10 * solid.width;
        cut.outline = {.length = 2 * reach, .width = 15, .radius = 0};
        solid.bend_cut = {cut};
        SCOPED_TRACE(fmt::format("{}: t {:.3g}, R {:.3g}, {:.3g} degrees, window {:.4g} beyond the leg", seed, t,
                                 radius, angle / degree, reach));
        const Session session = solved_bent_solid(folder / "part.step", solid);
        EXPECT_FALSE(session.part->doctor.find(Fault::closed_corner));
        if (!session.part->doubts.empty())
            continue;
        ++quiet;
        const double hole = 15 * (reach + arc * angle + up), all = solid.developed(0.5) * solid.width;
        EXPECT_NEAR(area(session.part->mesh), all - hole, 2e-4 * all);
    }
    EXPECT_GE(quiet, int(family * 3 / 4));
}

/// Wide beside the bend: on the flats the walls of the notch lie so askew that they say next to
/// nothing of where in the sheet its rim is.
TEST(WideNotch, LeavesTheFlatsBesideABendInTheirPlanes)
{
    const ScratchFolder folder;
    for (const double pitch : {-70., -65., -60., -50., -30., 0., 30.})
        for (const double turn : {45., 60.}) {
            SCOPED_TRACE(fmt::format("pitched by {}, turned by {}", pitch, turn));
            BentSolid solid;
            solid.thickness = 1.5;
            solid.width = 47;
            solid.leg = {33, 41};
            solid.bend = {{2.5, 75 * degree}};
            shapes::BendCut cut;
            cut.pitch = pitch * degree;
            cut.outline = {.length = 16, .width = 16, .radius = 0, .turn = turn * degree};
            solid.bend_cut = {cut};
            const Eigen::Vector2d size = size_of(solved_bent_solid(folder / "part.step", solid));
            EXPECT_NEAR(size[0], solid.developed(0.5), 1e-4);
            EXPECT_NEAR(size[1], solid.width, 1e-4);
        }
}

class WideHoles : public CutBends {};

} // namespace

TEST_P(CutBends, OfAStepFileAreAsTheyWereMade) { expect_of_step(shapes::random_cut_bends(GetParam())); }

TEST_P(CutBends, OfAnStlFileAreAsTheyWereMade) { expect_of_stl(shapes::random_cut_bends(GetParam())); }

TEST_P(WideHoles, OfAStepFileAreAsTheyWereMade) { expect_of_step(shapes::random_wide_hole(GetParam())); }

TEST_P(WideHoles, OfAnStlFileAreAsTheyWereMade) { expect_of_stl(shapes::random_wide_hole(GetParam())); }

INSTANTIATE_TEST_SUITE_P(Family, WideHoles, testing::Range<std::uint64_t>(1, 41));
INSTANTIATE_TEST_SUITE_P(Family, CutBends, testing::Range<std::uint64_t>(1, 41));

} // namespace spia::cut_bends_test
