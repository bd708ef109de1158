// Nuts that are joined with the sheet over a hole.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "tests/support/cad/plate_with_nut.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {

TEST(Nuts, ThatAreJoinedWithTheSheetAreToldOrRefused)
{
    const ScratchFolder folder;
    constexpr int family = 20;
    int told = 0;
    for (std::uint64_t seed = 1; seed <= family; ++seed) {
        shapes::SeededRandom random(seed + 67000);
        shapes::PlateWithNut plate;
        const double t = plate.thickness = random.between(1, 4);
        plate.size = t * random.between(25, 40);
        plate.hole = t * random.between(1, 2);
        plate.inner = plate.hole * random.between(0.7, 0.95);
        plate.outer = plate.hole + t * random.between(1.2, 2);
        plate.height = t * random.between(1.5, 4);
        SCOPED_TRACE(fmt::format("{}: t {:.3g}, hole {:.3g}, nut {:.3g} to {:.3g}, {:.3g} high", seed, t, plate.hole,
                                 plate.inner, plate.outer, plate.height));
        shapes::write_plate_with_nut(folder / "part.step", plate);
        try {
            const PartFile part = read_part(folder / "part.step");
            EXPECT_FALSE(part.doctor.healthy() && part.doubts.empty());
            for (const std::string& doubt : part.doubts)
                told += doubt.find("something stands up from the sheet") != std::string::npos;
        } catch (const InputError&) {
        }
    }
    EXPECT_GE(told, family / 2);
}

} // namespace spia
