#include <gtest/gtest.h>

#include "engine/forming/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/session.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/cad/exact_volume.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

using shapes::BentSolid;

double area_of(const Eigen::Matrix2Xd& position, const Eigen::Matrix3Xi& triangle)
{
    double sum = 0;
    for (Eigen::Index f = 0; f < triangle.cols(); ++f) {
        const Eigen::Vector2d p = position.col(triangle(1, f)) - position.col(triangle(0, f)),
                              q = position.col(triangle(2, f)) - position.col(triangle(0, f));
        sum += (p[0] * q[1] - p[1] * q[0]) / 2;
    }
    return sum;
}

} // namespace

/// Solids with a hole drilled askew through their first bend. Volume / thickness is the area of the middle surface, whatever the triangles.
TEST(SheetArea, HolesThroughBendsLieOnTheMiddleSurface)
{
    const ScratchFolder folder;
    int holes = 0;
    for (std::uint64_t seed = 1; seed <= 120; ++seed) {
        const BentSolid solid = shapes::random_bent_solid(seed);
        if (!solid.hole)
            continue;
        SCOPED_TRACE(seed);
        Session session;
        session.file = folder / "part.step";
        shapes::write_bent_solid(session.file, solid);
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        session = run_stage(Stage::read, std::move(session));
        ASSERT_TRUE(session.part->solid);
        session.options.flatten.thickness = solid.thickness;
        session = run_stage(Stage::solve, std::move(session));
        ++holes;
        const double area = area_of(session.blank->blank.position, session.part->mesh.triangle);
        EXPECT_NEAR(area * solid.thickness / shapes::exact_volume(session.file), 1, 2e-4);
    }
    EXPECT_GE(holes, 15);
}

/// By default triangles: what the border lacks is small even where chords of bends are coarse.
TEST(SheetArea, RoundHolesAreRoundByDefault)
{
    const ScratchFolder folder;
    BentSolid solid; // a bend so flat that its chords count for nothing
    solid.kind = "bracket";
    solid.thickness = 2;
    solid.width = 100;
    solid.leg = {60, 60};
    solid.bend = {{5, 1e-2}};
    solid.hole = true;
    const auto file = folder / "plate.step";
    shapes::write_bent_solid(file, solid);
    const PartFile part = examine_part(file);
    ASSERT_TRUE(part.solid);
    EXPECT_NEAR(area(part.mesh) * solid.thickness / shapes::exact_volume(file), 1, 1e-4);
}

} // namespace spia
