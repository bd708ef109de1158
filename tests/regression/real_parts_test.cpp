// Real parts: what the chain gave when it was last looked at. A change of these figures needs a reason in the commit.
#include <filesystem>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/forming/material_library.h"
#include "engine/pipeline/report.h"
#include "engine/pipeline/session.h"

namespace spia {
namespace {

const std::filesystem::path folder = SPIA_SOURCE_DIR "/../shared/data";

struct RealPart {
    const char* file;
    LengthUnit unit;
    int triangles;
    size_t loops;
    bool converged;            ///< false: scans and folded shapes that no press could form; the energy's blank is given
    double thinning_max;       ///< over the faces
    double thinning_tolerance; ///< 0.01 where the solve converged: the figure is a solution, not a path; else wide
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
    EXPECT_EQ(flat.report.converged, expected.converged) << flat.report.reason;
    EXPECT_NEAR(flat.face.thinning.maxCoeff(), expected.thinning_max, expected.thinning_tolerance);
    EXPECT_EQ(session.grid->result.quality.folded_cells, 0);
    EXPECT_GT(session.grid->result.quality.min_scaled_jacobian, 0);
    const Deviation& deviation = session.surface->deviation;
    EXPECT_LT(std::max(deviation.surface_to_mesh.rms, deviation.mesh_to_surface.rms), 1.1 * expected.deviation_rms_mm);
}

// TABLE

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

} // namespace spia
