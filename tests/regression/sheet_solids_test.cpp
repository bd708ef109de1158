// Solids of sheet as CAD systems gave them. The truth is their volume, integrated over the CAD
// faces, over the thickness: exactly the area of the middle surface of plane and bent sheet.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/curvature.h"
#include "engine/mesh/flat/outline.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"
#include "engine/remesh/triangle_quality.h"
#include "tests/support/cad/exact_volume.h"
#include "tests/support/flat_area.h"

namespace spia::sheet_solids_test {
namespace {

namespace fs = std::filesystem;
const fs::path folder = SPIA_SOURCE_DIR "/../shared/data/cad";

Session solved(const fs::path& file)
{
    Session session;
    session.file = file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return completed(run_chain(std::move(session), Stage::read, Stage::solve));
}

/// Every STEP file there that is a solid of sheet by default options.
std::vector<fs::path> sheet_solids()
{
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".step")
            continue;
        ReadOptions options;
        options.cad.keep_triangles = true;
        const PartFile part = examine_part(entry.path(), options);
        if (part.solid && part.doctor.healthy())
            found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

} // namespace

TEST(SheetSolids, BlanksOfBentSheetHaveTheAreaOfVolumeOverThickness)
{
    if (!fs::exists(folder))
        GTEST_SKIP() << "no " << folder;
    int bent = 0;
    for (const fs::path& file : sheet_solids()) {
        SCOPED_TRACE(file.filename());
        const Session session = solved(file);
        constexpr double unrolls = 0.02; // rad, as read_part() has it
        if (total_curvature(session.part->mesh) > unrolls)
            continue; // what is drawn gets thinner, and its blank has another area
        ++bent;
        const double expected = shapes::exact_volume(file) / session.part->thickness_mm.value();
        EXPECT_NEAR(shapes::flat_area(session.blank->blank.position, session.part->mesh.triangle) / expected, 1, 2e-4);
        EXPECT_NEAR(area(session.part->mesh) / expected, 1, 2e-4) << "chords of bends lack some";
    }
    EXPECT_GE(bent, 2) << "the fan bracket and the battery clip";
}

TEST(SheetSolids, TheDrawnConeHasAMiddleSurfaceAsGoodAsItsSkin)
{
    const fs::path file = folder / "drawn_cone.step";
    if (!fs::exists(file))
        GTEST_SKIP() << "no " << file;
    ReadOptions options;
    options.cad.keep_triangles = true;
    options.cad.deflection = 0.03;
    const PartFile fine = examine_part(file, options);
    // Its thickness is 0.944 to 1.057 mm and not quite 1 mm in the mean: 6.2e-4 here, and by finer
    // triangles still 4.5e-4.
    EXPECT_NEAR(area(fine.mesh) / (shapes::exact_volume(file) / fine.thickness_mm.value()), 1, 8e-4);

    const std::clock_t start = std::clock();
    const PartFile part = read_part(file);
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    RecordProperty("seconds", std::to_string(seconds));
#ifdef NDEBUG
    // 5 s of one free core, up to 15 s beside other programs; 25 to 37 s were taken for six
    // attempts in vain.
    EXPECT_LT(seconds, 20);
#endif
    ASSERT_TRUE(part.remeshed) << "its own folds kept it from being remeshed";
    EXPECT_LE(part.remeshed->distance, part.remeshed->tolerance);
    constexpr double degrees = 180 / 3.14159265358979;
    EXPECT_GT(part.remeshed->after.least_angle_of_99 * degrees, 30) << "34.5 of the outer skin";
    EXPECT_GT(part.remeshed->after.least_angle * degrees, 1) << "1.5 of the outer skin";

    const Session session = solved(file);
    EXPECT_EQ(session.blank->report.system, SolvedSystem::strict) << session.blank->report.reason;
    EXPECT_EQ(session.blank->report.relaxed_vertices, 0);
    EXPECT_EQ(session.blank->flipped_triangles, 0);
}

} // namespace spia::sheet_solids_test
