#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"
#include "tests/unit/exchange/sample_faces.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

bool has_note(const PartFile& part, const std::string& words)
{
    return std::any_of(part.notes.begin(), part.notes.end(),
                       [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

TEST(CadNeedles, OnADrawnPartAreRemeshedUnasked)
{
    const ScratchFolder folder;
    write_cup_quarter(folder / "cup.brep");
    ReadOptions options;
    options.cad.keep_triangles = true;
    const PartFile kept = read_part(folder / "cup.brep", options);
    EXPECT_FALSE(kept.remeshed);
    EXPECT_LT(triangle_quality(kept.mesh).least_angle_of_99 * degrees, 15) << "else this test says nothing";
    options.cad.keep_triangles = false;
    const PartFile part = read_part(folder / "cup.brep", options);
    ASSERT_TRUE(part.remeshed);
    EXPECT_EQ(part.remeshed->before.triangles, kept.mesh.triangles());
    EXPECT_GT(part.remeshed->after.least_angle_of_99 * degrees, 25);
    EXPECT_LE(part.remeshed->distance, part.remeshed->tolerance);
    EXPECT_TRUE(has_note(part, mention(option::no_remesh)));
    using std::numbers::pi;
    // Pappus: bottom, round (its line, its centroid 2/pi radii beyond 96) and wall, a quarter of a
    // turn
    const double exact = pi / 2 * ((96. * 96 - 20 * 20) / 2 + pi / 2 * 4 * (96 + 2 / pi * 4) + 60 * 100);
    EXPECT_NEAR(area(part.mesh) / exact, 1, 1e-3);
    const std::vector<int>& cad_face = part.cad->face;
    ASSERT_EQ(cad_face.size(), size_t(part.mesh.triangles()));
    int clear = 0, wrong = 0; // triangles may reach over the borders, which are smooth
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        const Eigen::Vector3d middle = part.mesh.position(Eigen::all, part.mesh.triangle.col(f)).rowwise().mean();
        const double radius = middle.head<2>().norm(), z = middle.z();
        const bool bottom = radius<90, round = z> 1 && z<3, wall = z> 8;
        clear += bottom || round || wall;
        wrong += (bottom || round || wall) && cad_face[size_t(f)] != (bottom ? 0 : round ? 1 : 2);
    }
    EXPECT_GT(clear, part.mesh.triangles() / 2);
    EXPECT_EQ(wrong, 0) << "each triangle lies on the CAD face that it is said to be of";
}

TEST(CadNeedles, AreReplacedWithinTheDeflectionThatWasGiven)
{
    const ScratchFolder folder;
    write_cup_quarter(folder / "cup.brep");
    ReadOptions options;
    options.cad.deflection = 0.05;
    const PartFile part = read_part(folder / "cup.brep", options);
    ASSERT_TRUE(part.remeshed);
    EXPECT_EQ(part.remeshed->tolerance, 0.05);
    options.cad.deflection = 5; // coarser than remeshing is by default
    const PartFile coarse = read_part(folder / "cup.brep", options);
    ASSERT_TRUE(coarse.remeshed);
    EXPECT_NEAR(coarse.remeshed->tolerance, 1e-3 * bounding_diagonal(*coarse.remeshed->original), 1e-9);
}

TEST(CadNeedles, OnABentPartStayAndAreNoFault)
{
    const ScratchFolder folder;
    write_swept_cylinder(folder / "bent.brep", Swept::line_up);
    ReadOptions options;
    options.cad.angle = 0.01; // strips of 0.1 mm along 30 mm
    const PartFile part = read_part(folder / "bent.brep", options);
    EXPECT_LT(triangle_quality(part.mesh).least_angle * degrees, 1);
    EXPECT_FALSE(part.remeshed);
    EXPECT_FALSE(part.doctor.find(Fault::sliver));
    EXPECT_TRUE(has_note(part, "rulings of a developable surface"));
}

} // namespace
} // namespace spia
