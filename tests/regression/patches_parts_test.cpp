// Real perforated parts as patches around their holes.
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

#include "engine/exchange/cad/read_surfaces.h"
#include "engine/exchange/cad/write_step.h"
#include "engine/forming/material/material_library.h"
#include "engine/nurbs/certificate.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"

namespace spia::patches_parts_test {
namespace {

const std::filesystem::path folder = SPIA_SOURCE_DIR "/../shared/data/fe";

class PerforatedParts : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Decks, PerforatedParts, testing::Values("support_panel.bdf", "recliner_bracket.k"));

} // namespace

TEST_P(PerforatedParts, BecomePatchesWithoutAFoldWithinTheTolerance)
{
    if (!std::filesystem::exists(folder / GetParam()))
        GTEST_SKIP() << "the real part is not here: " << folder / GetParam();
    Session session;
    session.file = folder / GetParam();
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.patches.emplace();
    session = completed(run_chain(std::move(session), Stage::read, Stage::fit, {.thickness = 1}));
    ASSERT_TRUE(session.surface && session.surface->patches);
    const PatchesFit& fit = *session.surface->patches;
    EXPECT_TRUE(fit.reached) << fit.deviation_max();
    EXPECT_TRUE(certify(fit.patches).suited());
    EXPECT_LE(fit.patches.patch.size(), 100u); // an engineer draws 80 to 150
    // One sheet: V - E + F = 2 - loops.
    const int patches = int(fit.patches.patch.size()), joints = int(fit.patches.interfaces.size());
    std::vector<char> used(size_t(fit.layout.vertex.cols()), 0);
    for (const LayoutCurve& curve : fit.layout.curve)
        for (const int v : curve.vertex)
            used[size_t(v)] = 1;
    const int vertices = int(std::count(used.begin(), used.end(), 1));
    EXPECT_EQ(vertices - (4 * patches - joints) + patches, 2 - int(*session.part->doctor.boundary_loops));
    const auto file =
        std::filesystem::temp_directory_path() / ("spia-perforated-" + std::to_string(getpid()) + ".step");
    write_step(file, fit.patches.patch);
    EXPECT_EQ(read_step_surfaces(file).size(), fit.patches.patch.size());
    std::filesystem::remove(file);
}

} // namespace spia::patches_parts_test
