#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "engine/part/curved_faces.h"
#include "engine/remesh/triangle_quality.h"
#include "tests/support/mesh_file.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"
#include "tests/support/sheet_solid.h"
#include "tests/unit/exchange/sample_solids.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::solid_part_test {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;
constexpr double thickness = 0.8;

class SolidPart : public testing::Test {
protected:
    static shapes::BentSheet sheet()
    {
        const auto channel =
            shapes::Profile({0, 0}, 0).straight(40).bend(4, -pi / 2).straight(30).bend(6, pi / 2).straight(20);
        return shapes::without(shapes::bent_sheet(channel, 70, 3), [](const Eigen::Vector3d& p) {
            return std::abs(p.x() - 18) < 7 && std::abs(p.y() - 30) < 7;
        });
    }
    static TriMesh solid() { return shapes::thickened(sheet().mesh, -thickness * sheet().normal); }
    fs::path write(const std::string& name, const TriMesh& mesh)
    {
        shapes::write_mesh(folder_ / name, mesh);
        return folder_ / name;
    }
    static ReadOptions of(Skin skin)
    {
        ReadOptions options;
        options.skin = skin;
        return options;
    }
    static bool notes(const PartFile& part, const std::string& text)
    {
        return std::any_of(part.notes.begin(), part.notes.end(),
                           [&](const std::string& note) { return note.find(text) != std::string::npos; });
    }
    static std::string refusal(const fs::path& file, const ReadOptions& options = {})
    {
        try {
            read_part(file, options);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    ScratchFolder folder_;
};

/// A CAD file and what is known of it.
struct Known {
    const char* file;
    double thickness, outer, middle; ///< mm, mm2 of the outer skin, 0: not known, and of volume /
                                     ///< thickness
    double tolerance;                ///< of the areas, for the chords of the mesh; of the cone the
                                     ///< thickness is not the same everywhere
    int outer_faces, inner_faces, loops;
};

void PrintTo(const Known& known, std::ostream* out) { *out << known.file; }

class RealSolid : public testing::TestWithParam<Known> {
protected:
    const fs::path file_ = fs::path(SPIA_SOURCE_DIR) / "../shared/data/cad" / GetParam().file;
};

} // namespace

TEST_F(SolidPart, SliversAcrossTheThicknessAreNotThoseOfTheSkin)
{
    // its rim: 3 mm long, 0.02 mm wide
    const TriMesh foil = shapes::thickened(sheet().mesh, -0.02 * sheet().normal);
    const PartFile part = read_part(write("foil.obj", foil));
    ASSERT_TRUE(part.solid);
    EXPECT_EQ(part.doctor.find(Fault::sliver), nullptr);
}

TEST_F(SolidPart, IsGivenByOneSurfaceWithItsThickness)
{
    TriMesh lower = sheet().mesh, middle = lower;
    lower.position -= thickness * sheet().normal;
    middle.position -= thickness / 2 * sheet().normal;
    const double upper = area(sheet().mesh), under = area(lower);
    for (const char* name : {"solid.stl", "solid.obj"}) {
        const fs::path file = write(name, solid());
        const PartFile outer = read_part(file, of(Skin::outer)), inner = read_part(file, of(Skin::inner)),
                       between = read_part(file);
        for (const PartFile* part : {&outer, &inner, &between}) {
            ASSERT_TRUE(part->solid) << name;
            EXPECT_NEAR(part->thickness_mm.value_or(0), thickness, 1e-5) << "single precision, and 1e-6 mm";
            EXPECT_EQ(part->doctor.boundary_loops, 2);
            EXPECT_EQ(part->doctor.genus, 0);
            EXPECT_TRUE(part->seam.empty());
            EXPECT_EQ(part->file_faces, solid().triangles());
            EXPECT_EQ(int(part->source_face.size()), part->mesh.triangles());
            EXPECT_EQ(int(part->source_vertex.size()), part->mesh.vertices());
            EXPECT_TRUE(std::is_sorted(part->source_vertex.begin(), part->source_vertex.end()));
        }
        EXPECT_NEAR(area(outer.mesh), std::max(upper, under), 1e-3);
        EXPECT_NEAR(area(inner.mesh), std::min(upper, under), 1e-3);
        EXPECT_NEAR(area(between.mesh), area(middle), 1e-3);
        EXPECT_TRUE(notes(outer, "its outer skin of")) << "no silent choice";
        EXPECT_TRUE(notes(between, "its middle surface"));
        EXPECT_EQ(between.solid->skin, Skin::middle) << "not asked for: the surface that has the sheet's lengths";
        EXPECT_EQ(between.mesh.position, read_part(file, of(Skin::middle)).mesh.position);
        const bool first = upper > under;
        const int f = sheet().mesh.triangles();
        EXPECT_EQ(outer.source_face.front(), first ? 0 : f);
        EXPECT_EQ(inner.source_face.front(), first ? f : 0);
    }
}

TEST_F(SolidPart, LeavesSheetsAndHollowBodiesAsTheyAre)
{
    const fs::path open = write("sheet.stl", sheet().mesh), ball = write("ball.stl", shapes::closed_sphere(30, 2000));
    EXPECT_FALSE(read_part(open).solid);
    EXPECT_FALSE(notes(read_part(open), "skin"));
    const PartFile asked = read_part(open, of(Skin::inner));
    EXPECT_NEAR(area(asked.mesh), area(sheet().mesh), 1e-3);
    EXPECT_TRUE(notes(asked, "a surface already"));
    EXPECT_FALSE(read_part(ball).seam.empty());
    EXPECT_NE(refusal(ball, of(Skin::outer)).find("block"), std::string::npos);
}

TEST_F(SolidPart, TakesTheSkinOfASolidWithFacesMissing)
{
    TriMesh leaky = solid();
    leaky.triangle.conservativeResize(3, leaky.triangles() - 8);
    const PartFile part = read_part(write("leaky.stl", leaky));
    ASSERT_TRUE(part.solid);
    EXPECT_TRUE(part.solid->open);
    EXPECT_TRUE(notes(part, "missing"));
    EXPECT_NEAR(part.solid->outer_area + part.solid->inner_area,
                area(solid()) - part.solid->rim_area - (area(solid()) - area(leaky)), 1e-2);
}

TEST_F(SolidPart, RefusesWhatIsNoSheetWithFaceAndPlace)
{
    const TriMesh plate = shapes::rectangle(80, 60, 40, 30);
    Eigen::Matrix3Xd down = Eigen::Matrix3Xd::Zero(3, plate.vertices());
    for (int v = 0; v < plate.vertices(); ++v)
        down(2, v) = plate.position(0, v) > 69 ? -0.4 : -1;
    const fs::path coined = write("coined.stl", shapes::thickened(plate, down));
    const std::string why = refusal(coined);
    EXPECT_NE(why.find("varies"), std::string::npos) << why;
    EXPECT_NE(why.find("(face "), std::string::npos) << why;
    const PartFile part = examine_part(coined);
    ASSERT_FALSE(part.doctor.healthy());
    ASSERT_EQ(part.doctor.findings.front().place.size(), 1u);
    EXPECT_GT(part.doctor.findings.front().place[0].x(), 67);

    EXPECT_NE(refusal(write("two.stl", shapes::joined(solid(), shapes::transformed(solid(), Eigen::Matrix3d::Identity(),
                                                                                   {0, 200, 0})))),
              "");
}

// Few triangles or many: of a wedge one of both is taken for the thickness, or it is refused.
TEST_F(SolidPart, TellsThatTheThicknessOfAWedgeVaries)
{
    for (const int fine : {1, 2, 12, 40})
        for (const double thin : {1.3, 1.6, 2., 2.4}) {
            SCOPED_TRACE(fmt::format("{} by {}, from {} to 4 mm", fine, fine, thin));
            const TriMesh plate = shapes::rectangle(80, 50, fine, fine);
            Eigen::Matrix3Xd down = Eigen::Matrix3Xd::Zero(3, plate.vertices());
            for (int v = 0; v < plate.vertices(); ++v)
                down(2, v) = -4 + (4 - thin) * plate.position(0, v) / 80;
            try {
                const PartFile part = read_part(write("wedge.stl", shapes::thickened(plate, down)));
                EXPECT_FALSE(part.doubts.empty() && part.doctor.healthy());
            } catch (const InputError&) {
            }
        }
}

TEST_P(RealSolid, GivesBothSkinsAndTheMiddle)
{
    const Known& known = GetParam();
    if (!fs::exists(file_))
        GTEST_SKIP() << "no " << file_;
    ReadOptions options;
    options.seam.mode = SeamOptions::Mode::none;
    options.cad.keep_triangles = true; // skins are compared, not what remeshing makes of them
    options.skin = Skin::outer;
    const PartFile outer = read_part(file_, options);
    ASSERT_TRUE(outer.solid);
    EXPECT_NEAR(outer.solid->thickness, known.thickness, 1e-8 * known.thickness) << "as CAD faces state it";
    if (known.outer > 0) {
        EXPECT_NEAR(sheet_area(outer), known.outer, known.tolerance * known.outer);
    }
    EXPECT_EQ(outer.solid->outer_faces, known.outer_faces);
    EXPECT_EQ(outer.solid->inner_faces, known.inner_faces);
    EXPECT_EQ(outer.doctor.boundary_loops, known.loops);
    options.skin = Skin::middle;
    const PartFile middle = read_part(file_, options);
    EXPECT_NEAR(sheet_area(middle), known.middle, known.tolerance * known.middle);
    options.skin = Skin::inner;
    const PartFile inner = read_part(file_, options);
    EXPECT_EQ(inner.doctor.boundary_loops, known.loops);
    EXPECT_NEAR(sheet_area(middle), (sheet_area(inner) + sheet_area(outer)) / 2, 1e-3 * sheet_area(middle));
}

// Areas and volume as integrated over the CAD faces.
INSTANTIATE_TEST_SUITE_P(Cad, RealSolid,
                         testing::Values(Known{"fan_bracket.step", 0.5, 6507.58, 6433.4, 5e-4, 31, 31, 17},
                                         Known{"drawn_cone.step", 1, 36584.63, 36071, 3e-4, 26, 19, 3},
                                         Known{"battery_clip_3034.step", 0.4, 0, 338.744, 2e-4, 29, 29, 4}));

TEST(RealSolidFile, MiddleOfADrawnPartIsAsEvenAsItsSkin)
{
    const fs::path file = fs::path(SPIA_SOURCE_DIR) / "../shared/data/cad/drawn_cone.step";
    if (!fs::exists(file))
        GTEST_SKIP() << "no " << file;
    ReadOptions options;
    options.seam.mode = SeamOptions::Mode::none;
    options.cad.keep_triangles = true;
    options.skin = Skin::outer;
    const TriMesh outer = read_part(file, options).mesh;
    options.skin = Skin::middle;
    const TriMesh middle = read_part(file, options).mesh;
    // Moved along the normals of its needles it had twice as much.
    EXPECT_LT(total_curvature(middle), 1.1 * total_curvature(outer));
}

TEST(RealSolidFile, MiddleOfFineChordsHasTheAreaOfVolumeOverThickness)
{
    const fs::path file = fs::path(SPIA_SOURCE_DIR) / "../shared/data/cad/battery_clip_3034.step";
    if (!fs::exists(file))
        GTEST_SKIP() << "no " << file;
    ReadOptions options;
    options.skin = Skin::middle;
    options.cad.angle = 0.05;
    options.cad.deflection = 0.002;
    options.cad.keep_triangles = true;
    const PartFile part = read_part(file, options);
    ASSERT_TRUE(part.solid);
    EXPECT_NEAR(area(part.mesh) * part.solid->thickness, part.solid->volume, 2e-4 * part.solid->volume);
}

TEST(RealSolidFile, HeatSinkOfSeveralThicknessesIsRefused)
{
    const fs::path file = fs::path(SPIA_SOURCE_DIR) / "../shared/data/cad/heatsink_573300.step";
    if (!fs::exists(file))
        GTEST_SKIP() << "no " << file;
    try {
        read_part(file);
        FAIL() << "it has no single thickness";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("CAD face"), std::string::npos) << error.what();
    }
}

TEST(SolidBlock, IsTakenWithADoubt)
{
    const ScratchFolder folder;
    for (const auto& [height, doubted] : {std::pair(10., true), {2., false}}) {
        write_box(folder / "block.step", 30, 20, height);
        const PartFile part = examine_part(folder / "block.step");
        ASSERT_TRUE(part.solid) << height;
        EXPECT_EQ(part.thickness_mm, height);
        EXPECT_EQ(part.doubts.size(), doubted ? 1u : 0u) << height;
        EXPECT_TRUE(examine_part(folder / "block.step", {.skin = Skin::middle}).doubts.empty()) << "asked for";
    }
}

} // namespace spia::solid_part_test
