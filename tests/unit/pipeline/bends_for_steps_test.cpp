// Bends of CAD files are those of the steps, also where they are wide for the part.
#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "engine/exchange/read_part.h"
#include "engine/pipeline/blank/bends_for_shop.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {

TEST(BendsForSteps, AreTheCylindersOfTheFileUpToAThirdOfItsSide)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        shapes::SeededRandom random(seed);
        shapes::BentSolid solid;
        solid.thickness = random.between(0.5, 10);
        solid.width = random.between(20, 120);
        const int bends = 1 + int(seed % 3);
        for (int k = 0; k < bends; ++k)
            solid.bend.push_back({random.between(0.5, 50), (k % 2 ? -1 : 1) * random.between(0.3, 1.6)});
        for (int k = 0; k <= bends; ++k)
            solid.leg.push_back(random.between(15, 80));
        SCOPED_TRACE(fmt::format("seed {}, t {:.3g}", seed, solid.thickness));
        shapes::write_bent_solid(folder / "part.step", solid);
        const BendMap map = bends_for_steps(read_part(folder / "part.step"));
        // A wider one may be the largest region still, with its flats beside it.
        if (std::ranges::any_of(solid.bend, [&](const auto& bend) { return bend.inner_radius > map.side / 3; }))
            continue;
        EXPECT_EQ(int(map.regions.size()), bends + 1);
        EXPECT_EQ(int(map.bends.size()), bends);
        for (const Bend& bend : map.bends)
            EXPECT_GT(bend.faces, 0);
    }
}

} // namespace spia
