// Surfaces by default options of brackets with patterns of holes, as a shop draws them.
#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/run_chain.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/family.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

/// One or two bends, and rows of holes of one size in each leg.
shapes::BentSolid random_hole_pattern(std::uint64_t seed)
{
    shapes::SeededRandom random(seed);
    shapes::BentSolid solid;
    solid.kind = fmt::format("pattern {}", seed);
    solid.thickness = random.between(0.8, 5);
    solid.width = random.between(60, 120);
    solid.pose = seed;
    const int bends = random.whole(1, 2);
    for (int leg = 0; leg <= bends; ++leg)
        solid.leg.push_back(random.between(60, 100));
    for (int b = 0; b < bends; ++b)
        solid.bend.push_back({random.between(1, 4) * solid.thickness, random.between(0.5, 1.6)});
    for (int leg = 0; leg <= bends; ++leg) {
        const double length = solid.leg[size_t(leg)];
        const int along = random.whole(1, 4), across = random.whole(1, 5);
        const double room = std::min(length / along, solid.width / across);
        const double radius = random.between(0.05, 0.35) * room;
        for (int i = 0; i < along; ++i)
            for (int j = 0; j < across; ++j) {
                shapes::Cutout hole;
                hole.leg = leg;
                hole.centre = {(i + 0.5) * length / along, (j + 0.5) * solid.width / across};
                hole.length = hole.width = 2 * radius;
                hole.radius = radius;
                solid.cutout.push_back(hole);
            }
    }
    return solid;
}

} // namespace

TEST(HolePatterns, LeaveTheSurfaceAsItIsWithoutThem)
{
    const ScratchFolder folder;
    for (int seed = 1; seed <= int(shapes::family_size(12)); ++seed) {
        const shapes::BentSolid solid = random_hole_pattern(std::uint64_t(seed));
        SCOPED_TRACE(solid.kind);
        Session session;
        session.file = folder / fmt::format("pattern{}.step", seed);
        shapes::write_bent_solid(session.file, solid);
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        session = completed(run_chain(std::move(session)));
        const Certificate& certificate = surface_certificate(session);
        EXPECT_FALSE(certificate.patch.at(0).refusal) << describe(*certificate.patch.at(0).refusal);
        EXPECT_GT(certificate.patch.at(0).least_scaled, 0.95);
        EXPECT_EQ(session.surface->trim.loop.size(), solid.cutout.size());
        EXPECT_TRUE(session.surface->trim.left_filled.empty());
        if (seed > 3)
            continue;
        const double cut = area(session.part->mesh);
        for (const auto& file : write_outputs(session, folder / "out", {"iges", "step"}))
            EXPECT_NEAR(area(read_part(file).mesh), cut, 0.003 * cut) << file;
    }
}

} // namespace spia
