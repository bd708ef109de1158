// Holes that do not go through the sheet: they are told, and the blank has none.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solid_size.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {

using shapes::BentSolid;
using shapes::CadForm;

TEST(BlindHoles, AreToldOrRefusedAndNeverCut)
{
    const ScratchFolder folder;
    constexpr int family = 20;
    int refused = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        shapes::SeededRandom random(seed + 61000);
        BentSolid solid;
        const double t = solid.thickness = random.between(3, 10);
        solid.leg = {t * random.between(15, 25)};
        if (random.coin()) {
            solid.bend = {{t * random.between(0.7, 2), random.between(0.5, 1.6)}};
            solid.leg.push_back(t * random.between(15, 25));
        }
        solid.width = t * random.between(15, 25);
        solid.pose = seed;
        shapes::Sink drilled;
        drilled.centre = {solid.leg[0] / 2, solid.width / 2};
        drilled.hole = 0;
        drilled.wide = t * random.between(0.2, 0.5);
        drilled.depth = t * random.between(0.3, 0.8);
        drilled.counterbore = true;
        drilled.left = random.coin();
        solid.sink = {drilled};
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            SCOPED_TRACE(fmt::format("{}: t {:.3g}, {:.3g} mm wide, {:.3g} deep{}", seed, t, 2 * drilled.wide,
                                     drilled.depth, extension(form)));
            const auto file = folder / (std::string("part") + extension(form));
            shapes::write_bent_solid(file, solid, form);
            try {
                const Session session = solved_part(file);
                ASSERT_TRUE(session.part->solid);
                EXPECT_THAT(session.part->doubts,
                            testing::Contains(testing::HasSubstr(fmt::format(
                                "1 hole does not go through the sheet, up to {:.3g} mm deep", drilled.depth))));
                expect_developed_area(session, solid, 0, (form == CadForm::step ? 1e-5 : 1e-3) * developed_area(solid));
            } catch (const InputError& error) { // wide ones
                EXPECT_THAT(error.what(), testing::HasSubstr("across the"));
                ++refused;
            }
        }
    }
    EXPECT_LE(refused, family);
}

} // namespace spia
