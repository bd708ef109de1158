// Parts as they stand in a vehicle or a plant: far from the origin, in files of few digits.
#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <tuple>

#include "engine/core/error.h"
#include "engine/part/curved_faces.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/cad/random_bent_solid.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {

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
        SCOPED_TRACE(fmt::format("{}: {}, t {:.3g}, {} bends", seed, solid.kind, solid.thickness, solid.bend.size()));
        const auto file = folder / fmt::format("part{}", shapes::extension(form));
        shapes::write_bent_solid(file, solid, form);
        try {
            const Session session = solved_part(file, solid.thickness);
            ++read;
            if (!session.part->doubts.empty() || !session.part->doctor.healthy())
                continue;
            EXPECT_NEAR(sheet_area(*session.part), solid.developed(0.5) * solid.width,
                        1e-4 * solid.developed(0.5) * solid.width);
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
        } catch (const InputError& error) { // coarser than the thinnest of them
            EXPECT_GT(std::string(error.what()).size(), 20u);
        }
    }
    EXPECT_GE(read, int(family * 3 / 4));
}

INSTANTIATE_TEST_SUITE_P(Distances, FarParts,
                         testing::Combine(testing::Values(2e3, 2e4, 1e5),
                                          testing::Values(shapes::CadForm::step, shapes::CadForm::iges)));

} // namespace spia
