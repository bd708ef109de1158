#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/support/cad/exact_volume.h"
#include "tests/support/cad/random_bent_solid.h"
#include "tests/support/flat_area.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {
namespace {
using shapes::BentSolid;
}

/// Solids with a hole drilled askew through their first bend. Volume / thickness is the area of the
/// middle surface, whatever the triangles.
TEST(SheetArea, HolesThroughBendsLieOnTheMiddleSurface)
{
    const ScratchFolder folder;
    int holes = 0;
    for (std::uint64_t seed = 1; seed <= 120; ++seed) {
        const BentSolid solid = shapes::random_bent_solid(seed);
        if (!solid.hole)
            continue;
        SCOPED_TRACE(seed);
        const Session session = solved_bent_solid(folder / "part.step", solid);
        ASSERT_TRUE(session.part->solid);
        ++holes;
        const double area = shapes::flat_area(session.blank->blank.position, session.part->mesh.triangle);
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

/// Through a right angle holes are askew by up to 45 degrees to the legs and more to the bend: not
/// all their vertices can lie on the middle surface, but none may fold it.
TEST(SheetArea, HolesOfEverySizeThroughARightAngleStrainNothing)
{
    const ScratchFolder folder;
    for (double radius = 0.7; radius < 13; radius *= 1.3)
        for (const double inner : {1., 3.}) {
            SCOPED_TRACE(fmt::format("a hole of {:.3g} mm through a radius of {} mm", radius, inner));
            BentSolid solid;
            solid.kind = "bracket";
            solid.thickness = 2;
            solid.width = 60;
            solid.leg = {50, 40};
            solid.bend = {{inner, std::numbers::pi / 2}};
            solid.hole = true;
            solid.hole_radius = radius;
            const Session session = solved_bent_solid(folder / "part.step", solid);
            ASSERT_TRUE(session.part->solid);
            const Eigen::Matrix2Xd& X = session.blank->blank.position;
            const Eigen::Vector2d size = X.rowwise().maxCoeff() - X.rowwise().minCoeff();
            EXPECT_NEAR(size.x(), solid.developed(0.5), 1e-4);
            EXPECT_NEAR(size.y(), solid.width, 1e-4);
            EXPECT_LT(session.blank->face.strain_equivalent.maxCoeff(), 1e-3);
        }
}

} // namespace spia
