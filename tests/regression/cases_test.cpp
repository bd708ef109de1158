// ../shared/cases: small files of users, each with the right answer, by default options. Rows are
// those of the table there.
#include <algorithm>
#include <gmock/gmock.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/curvature.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"
#include "engine/pipeline/files/seam_file.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"
#include "engine/pipeline/shortcomings/shortcomings.h"

namespace spia::cases_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct Cases : testing::Test {
    const fs::path folder = SPIA_SOURCE_DIR "/../shared/cases";

    void SetUp() override
    {
        if (!fs::exists(folder))
            GTEST_SKIP() << "no " << folder;
    }
    PartFile examined(const char* file, const ReadOptions& options = {}) const
    {
        return examine_part(folder / file, options);
    }
    Session run(const char* file, const ReadOptions& options = {}, Stage last = Stage::solve) const
    {
        Session session;
        session.file = folder / file;
        session.options.read = options;
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        return completed(run_chain(std::move(session), Stage::read, last));
    }
    /// The box of the blank, mm, which has to lie straight.
    static void expect_size(const Session& session, double length, double breadth, double tolerance)
    {
        const Eigen::Matrix2Xd& x = session.blank->blank.position;
        const Eigen::Vector2d size = x.rowwise().maxCoeff() - x.rowwise().minCoeff();
        EXPECT_NEAR(size.x(), length, tolerance) << session.file;
        EXPECT_NEAR(size.y(), breadth, tolerance) << session.file;
    }
};

} // namespace

TEST_F(Cases, K1TheNeutralSurfaceIsLaidFlat)
{
    const Session session = run("05-lbracket.step");
    expect_size(session, 71.283, 30, 1e-3); // K11, too: straight
    EXPECT_EQ(session.part->thickness_mm, 2) << "as CAD states it";
    ASSERT_EQ(session.bends->bends.size(), 1u);
    EXPECT_EQ(session.bends->bends[0].inner_radius, 3) << "K15 to K17: of the CAD cylinder";
    EXPECT_NEAR(session.bends->bends[0].angle, std::numbers::pi / 2, 1e-9);
    EXPECT_TRUE(session.bends->bends[0].stated);
}

TEST_F(Cases, K2SheetIsFoundWhereNoSolidIsStated)
{
    const Session plate = run("08-plate.stl"), bracket = run("08-lbracket.igs");
    expect_size(plate, 120, 70, 1e-3);
    EXPECT_NEAR(plate.part->thickness_mm.value(), 3, 1e-6);
    EXPECT_EQ(plate.part->doctor.boundary_loops, 4);
    expect_size(bracket, 71.283, 30, 1e-3);
    EXPECT_NEAR(bracket.part->thickness_mm.value(), 2, 1e-6);
}

TEST_F(Cases, K3ShallowMarksArePassedOver)
{
    for (const char* file : {"01-mark-none.step", "01-mark-0.01.step", "01-mark-0.2.step"}) {
        const Session middle = run(file);
        expect_size(middle, 87.85, 40, 0.01);
        EXPECT_NEAR(middle.part->thickness_mm.value(), 4, 1e-9) << file;
        EXPECT_EQ(middle.part->doctor.find(Fault::mark) != nullptr, file != std::string("01-mark-none.step"));
        expect_size(run(file, {.skin = Skin::outer}), 91.0, 40, 0.01);
    }
}

TEST_F(Cases, K4FilesOfCreoAreRead)
{
    const PartFile star = examined("02-degree-star.step"), right = examined("02-degree-right.step");
    EXPECT_EQ(star.mesh.position, right.mesh.position);
    EXPECT_NEAR(star.solid.value().volume / 4276.99, 1, 5e-4) << "by chords";
    EXPECT_EQ(star.thickness_mm, 2);
}

TEST_F(Cases, K5DecksAreWhole)
{
    for (const char* file : {"13-main.k", "13-transform.rad"}) {
        const Session session = run(file);
        expect_size(session, 77.84, 40, 0.01);
        EXPECT_TRUE(session.part->doubts.empty()) << file;
    }
}

TEST_F(Cases, K6SystemsByNodesAreRead) { expect_size(run("20-cord1r.bdf"), 77.84, 20, 0.01); }

TEST_F(Cases, K7VariantsThatPeersReadAreRead)
{
    EXPECT_NEAR(area(examined("25-strips.ply").mesh), 941.805, 1e-3);
    EXPECT_EQ(examined("25-strips.ply").mesh.triangles(), 96);
    EXPECT_EQ(examined("19-cps3.inp").mesh.triangles(), 800);
    // 15 vertices with three of them replaced, 48 indices; its accessor says from 0 to 0.03, 0.02
    // and 0.01 m.
    const PartFile sparse = examined("28-sparse.gltf");
    EXPECT_EQ(sparse.mesh.triangles(), 16);
    EXPECT_LT((sparse.mesh.position.rowwise().maxCoeff() - Eigen::Vector3d(30, 20, 10)).norm(), 1e-5);
}

TEST_F(Cases, K8TouchingIsNoCrossing)
{
    const Session session = run("23-pinched-flat.obj", {}, Stage::fit);
    EXPECT_TRUE(session.blank->overlap.none());
    EXPECT_TRUE(session.surface->trim.left_filled.empty());
    EXPECT_EQ(session.surface->trim.loop.size(), 2u) << "one on either side of the pinch";
}

TEST_F(Cases, K9CracksAreClosedByTheGapThatTheDoctorProposes)
{
    const PartFile torn = examined("26-rounded-halves.stl");
    EXPECT_FALSE(torn.doctor.healthy());
    ASSERT_TRUE(torn.doctor.find(Fault::crack));
    ReadOptions options{.weld = true};
    options.doctor.weld_gap = torn.doctor.find(Fault::crack)->weld_gap;
    EXPECT_LE(options.doctor.weld_gap.value(), 0.01);
    const PartFile whole = examined("26-rounded-halves.stl", options);
    EXPECT_TRUE(whole.doctor.healthy());
    EXPECT_EQ(whole.doctor.components, 1);
}

TEST_F(Cases, K13APoorSurfaceIsSaid)
{
    const Session session = run("24-u-face.obj", {}, Stage::fit);
    const auto said = shortcomings(session);
    EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const std::string& text) {
        return text.find("surface") != std::string::npos && text.find("mm") != std::string::npos;
    })) << testing::PrintToString(said);
}

TEST_F(Cases, K14SeamsActOnSolidsAndCornersAreSaid)
{
    const PartFile tray = examined("14-tray.obj");
    ASSERT_TRUE(tray.doctor.find(Fault::closed_corner));
    EXPECT_THAT(tray.doctor.find(Fault::closed_corner)->advice, HasSubstr(mention(option::seam, "corners")));
    const auto strain = [](const Session& session) {
        return session.blank->face.strain_equivalent.cwiseAbs().maxCoeff();
    };
    EXPECT_LT(strain(run("14-tray.obj", {.seam = seam_options("corners")})), 1e-6);
    EXPECT_LT(strain(run("14-tray.obj", {.seam = seam_options((folder / "14-seam.json").string())})), 1e-6);
    ReadOptions solid;
    solid.cad.keep_triangles = true;
    EXPECT_TRUE(examined("06-tray.step", solid).doctor.find(Fault::closed_corner));
    solid.seam = seam_options("corners");
    EXPECT_LT(strain(run("06-tray.step", solid)), 1e-3);
    solid.seam = seam_options((folder / "06-tray-seam.json").string());
    EXPECT_LT(strain(run("06-tray.step", solid)), 1e-3);
}

} // namespace spia::cases_test
