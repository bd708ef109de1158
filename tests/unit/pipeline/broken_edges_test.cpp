// Sheet whose border is chamfered or rounded at one side: what is laid flat ends at its walls.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tests/support/cad/bent_solid.h"
#include "tests/support/flat_area.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
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
    solid.kind =
        fmt::format("broken edges {}: {} bends, {} of {:.3g} mm, {}", seed, bends,
                    solid.broken.round ? "round" : "chamfer", solid.broken.size, solid.broken.left ? "left" : "right");
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
                continue; // facets of a rounding go on from the skin: its outer skin is laid, which is a doubt
            SCOPED_TRACE(fmt::format("{}, {}", solid.kind, form == CadForm::stl ? "STL" : "STEP"));
            const auto file = folder / (form == CadForm::stl ? "part.stl" : "part.step");
            shapes::write_bent_solid(file, solid, form);
            const Session session = solved_part(file);
            ASSERT_TRUE(session.part->solid);
            const Eigen::Matrix2Xd& X = session.blank->blank.position;
            const Eigen::Vector2d size = X.rowwise().maxCoeff() - X.rowwise().minCoeff(),
                                  made(solid.developed(0.5), solid.width);
            const double within = form == CadForm::stl ? 2e-3 : 1e-4; // single precision, bends of chords
            EXPECT_NEAR(size.minCoeff(), made.minCoeff(), within);
            EXPECT_NEAR(size.maxCoeff(), made.maxCoeff(), within);
            EXPECT_NEAR(shapes::flat_area(X, session.part->mesh.triangle) / made.prod(), 1, within / 10);
        }
    }
}

} // namespace spia
