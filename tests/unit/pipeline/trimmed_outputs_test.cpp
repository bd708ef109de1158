#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/report/json/report_json.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

Session perforated(bool fill_holes)
{
    Session session;
    session.file = SPIA_SOURCE_DIR "/assets/parts/perforated-channel.obj";
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.fill_holes = fill_holes;
    return completed(run_chain(std::move(session)));
}

} // namespace

TEST(TrimmedOutputs, HaveTheHolesOfThePart)
{
    const ScratchFolder folder;
    const Session session = perforated(false);
    const TriMesh& part = session.part->mesh;
    const int holes = int(boundary_loops(part).size()) - 1;
    ASSERT_EQ(holes, 9);
    EXPECT_EQ(int(session.surface->trim.loop.size()), holes);
    EXPECT_LE(session.surface->trim.distance, session.surface->deviation.mesh_to_surface.max + 0.01);
    EXPECT_EQ(nlohmann::json::parse(report_json(session, {}, 0)).at("surface").at("holes").at("trimmed"), holes);
    for (const auto& file : write_outputs(session, folder / "out", {"iges", "step"})) {
        const PartFile back = read_part(file);
        EXPECT_EQ(back.doctor.boundary_loops, holes + 1) << file;
        EXPECT_NEAR(area(back.mesh), area(part), 0.005 * area(part)) << file << ": filled it is 2.7 % larger";
    }
}

TEST(TrimmedOutputs, AreWholeWhereHolesAreFilledAndSayWhichStay)
{
    const ScratchFolder folder;
    Session session = perforated(true);
    EXPECT_TRUE(session.surface->trim.loop.empty());
    for (const auto& file : write_outputs(session, folder / "out", {"iges", "step"}))
        EXPECT_EQ(read_part(file).doctor.boundary_loops, 1) << file;
    const size_t before = shortcomings(session).size();
    SurfaceStage stage = *session.surface;
    stage.trim.left_filled.push_back({7, "it touches another hole on the surface"});
    session.surface = std::make_shared<SurfaceStage>(std::move(stage));
    const auto list = shortcomings(session);
    ASSERT_EQ(list.size(), before + 1);
    EXPECT_NE(list.back().find(") stays filled in the surface: it touches another"), std::string::npos);
}

} // namespace spia
