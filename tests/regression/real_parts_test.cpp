// Real parts: what the chain gave when it was last looked at. A change of these figures needs a
// reason in the commit.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/session.h"
#include "engine/report/json/report_json.h"

namespace spia::real_parts_test {
namespace {

const std::filesystem::path folder = SPIA_SOURCE_DIR "/../shared/data";

struct RealPart {
    const char* file;
    LengthUnit unit;
    int triangles;
    size_t loops;              ///< after a cut: the tunnel is a tube
    bool as_given;             ///< solved with the hardening law up to 0.5 and every equation
                               ///< strict
    double most_relaxed;       ///< share of the vertices; scans and crumpled or coarse meshes need
                               ///< some
    double thinning_max;       ///< over the faces
    double thinning_tolerance; ///< 0.002 where no equation is relaxed; else wide: which ones are
                               ///< depends on the path
    double deviation_rms_mm;   ///< at the automatic grid; may get smaller freely
};

std::ostream& operator<<(std::ostream& out, const RealPart& part) { return out << part.file; }

class RealParts : public testing::TestWithParam<RealPart> {};

} // namespace

TEST_P(RealParts, RunsEndToEndWithoutAFlipOrAFold)
{
    const RealPart& expected = GetParam();
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the real parts are not here: " << folder;
    Session session;
    session.file = folder / expected.file;
    session.options.read.unit = expected.unit;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    for (const Stage stage : chain)
        session = run_stage(stage, std::move(session));
    const FlattenResult& flat = *session.blank;
    EXPECT_EQ(session.part->mesh.triangles(), expected.triangles);
    EXPECT_EQ(size_t(session.part->doctor.boundary_loops.value_or(0)), expected.loops);
    EXPECT_EQ(flat.flipped_triangles, 0);
    EXPECT_LT(flat.volume_error, 1e-9);
    EXPECT_TRUE(flat.report.converged) << flat.report.reason;
    EXPECT_EQ(flat.report.reason == "converged", expected.as_given) << flat.report.reason;
    EXPECT_LE(flat.report.relaxed_vertices, expected.most_relaxed * session.part->mesh.vertices());
    EXPECT_NEAR(flat.face.thinning.maxCoeff(), expected.thinning_max, expected.thinning_tolerance);
    EXPECT_EQ(session.grid->result.quality.folded_cells, 0);
    EXPECT_GT(session.grid->result.quality.min_scaled_jacobian, 0);
    const Deviation& deviation = session.surface->deviation;
    EXPECT_LT(std::max(deviation.surface_to_mesh.rms, deviation.mesh_to_surface.rms), 1.1 * expected.deviation_rms_mm);
}

using enum LengthUnit;
INSTANTIATE_TEST_SUITE_P(SharedData, RealParts,
                         testing::Values(RealPart{"fe/mudguard_front.obj", m, 5802, 1, true, 0, 0.0577, 0.002, 0.179},
                                         RealPart{"fe/mudguard_front.ply", m, 5802, 1, true, 0, 0.0577, 0.002, 0.179},
                                         RealPart{"fe/mudguard_front.stl", m, 5802, 1, true, 0, 0.0577, 0.002, 0.179},
                                         RealPart{"fe/fairing_front.obj", m, 44647, 8, false, 0.15, 0.67, 0.1, 3.15},
                                         RealPart{"mesh/face.obj", mm, 51712, 1, false, 0, 0.4896, 0.002, 0.0387},
                                         RealPart{"mesh/camelhead.off", mm, 22704, 1, false, 0.15, 0.62, 0.1, 0.0026},
                                         RealPart{"mesh/lilium.obj", mm, 6590, 1, true, 0, 0.0929, 0.002, 0.0004},
                                         RealPart{"mesh/beetle.off", mm, 38656, 11, false, 0.1, 0.79, 0.1, 0.0034},
                                         RealPart{"mesh/halftunnel.off", mm, 1568, 1, true, 0, 0.5033, 0.002, 0.8},
                                         RealPart{"mesh/nefertiti.off", mm, 562, 1, true, 0, 0.4565, 0.002, 0.0046},
                                         RealPart{"mesh/three_peaks.off", mm, 3671, 1, true, 0, 0.7244, 0.002, 0.0258},
                                         RealPart{"mesh/cowhead.obj", mm, 29999, 1, true, 0, 0.6941, 0.002, 0.0021},
                                         RealPart{"mesh/inverted_triangles.obj", mm, 24685, 6, true, 0, 0.4547, 0.002,
                                                  1.25},
                                         RealPart{"mesh/terrain.stl", mm, 3498, 1, true, 0, 0.0152, 0.002, 0.321}),
                         [](const auto& param) {
                             std::string name = param.param.file;
                             std::replace_if(
                                 name.begin(), name.end(),
                                 [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
                             return name;
                         });

/// Parts that unfold, but whose blank no single four-sided patch can cover.
struct Gridless {
    const char* file;
    SolvedSystem system;
    const char* why; ///< words of the message
};
void PrintTo(const Gridless& part, std::ostream* stream) { *stream << part.file; } // ctest shows it
class RealPartsWithoutGrid : public testing::TestWithParam<Gridless> {};

TEST_P(RealPartsWithoutGrid, AreSolvedAndRefusedByTheGridWithTheReason)
{
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the real parts are not here: " << folder;
    Session session;
    session.file = folder / GetParam().file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    for (const Stage stage : {Stage::read, Stage::solve})
        session = run_stage(stage, std::move(session));
    EXPECT_EQ(session.blank->report.system, GetParam().system) << session.blank->report.reason;
    EXPECT_EQ(session.blank->flipped_triangles, 0);
    try {
        run_stage(Stage::grid, session);
        FAIL() << "a grid was found: move the part to the other table";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(GetParam().why), std::string::npos) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(SharedData, RealPartsWithoutGrid,
                         testing::Values(Gridless{"mesh/maze.obj", SolvedSystem::strict, "winds too much"},
                                         Gridless{"mesh/camel_b.obj", SolvedSystem::energy,
                                                  "overlaps itself around boundary vertex"}),
                         [](const auto& param) { return std::filesystem::path(param.param.file).stem().string(); });

TEST(RealPartsRefused, TwoPiecesInOneFileAreNamed)
{
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the real parts are not here: " << folder;
    Session session;
    session.file = folder / "mesh/mask_cone.off";
    try {
        run_stage(Stage::read, session);
        FAIL() << "two components were accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("2"), std::string::npos) << error.what();
    }
}

} // namespace spia::real_parts_test
