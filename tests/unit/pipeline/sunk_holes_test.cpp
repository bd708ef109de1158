// Countersinks and counterbores of sheet solids: what is cut is the least diameter, what is sunk is told and drawn.
#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/forming/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/drawn_blank.h"
#include "engine/pipeline/session.h"
#include "engine/unfold/bends.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/lots.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

using shapes::BentSolid;
using shapes::CadForm;
using shapes::Sink;

Session blank_of(const std::filesystem::path& file)
{
    Session session;
    session.file = file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session = run_stage(Stage::read, session);
    session.options.flatten.thickness = session.part->thickness_mm.value();
    return run_stage(Stage::solve, session);
}

/// One of a hole on each leg of a plate or a bracket: sunk from either side, to any depth, through all of it at times.
BentSolid drawn_by_lot(std::uint64_t seed)
{
    shapes::Lots lots(seed);
    BentSolid solid;
    solid.kind = "sunk";
    solid.thickness = lots.between(1, 4);
    solid.width = 100; // so large that the floors of counterbores are specks
    solid.pose = seed;
    solid.leg = {160};
    if (lots.coin()) {
        solid.leg.push_back(160);
        solid.bend.push_back({lots.between(1, 3) * solid.thickness, lots.coin() ? 1.2 : -1.2});
    }
    for (int leg = 0; leg < int(solid.leg.size()); ++leg) {
        Sink sink;
        sink.leg = leg;
        sink.centre = {lots.between(50, 110), lots.between(30, 70)};
        sink.hole = lots.between(2, 5);
        sink.counterbore = lots.coin();
        sink.left = lots.coin();
        const bool through = !sink.counterbore && lots.whole(0, 2) == 0;
        sink.depth = solid.thickness * (through ? 1 : lots.between(0.25, 0.9)); // shallower counterbores are marks
        sink.wide = sink.hole + lots.between(0.5, 1.2) * (sink.counterbore ? solid.thickness : sink.depth);
        solid.sink.push_back(sink);
    }
    return solid;
}

struct Round {
    double radius, off; ///< mm; of the points at most
};

Round round_of(const Eigen::Matrix3Xd& points)
{
    const Eigen::Vector3d middle = points.rowwise().mean();
    const Eigen::RowVectorXd far = (points.colwise() - middle).colwise().norm();
    return {far.mean(), (far.array() - far.mean()).abs().maxCoeff()};
}

} // namespace

TEST(SunkHoles, HaveTheirLeastDiameterAndAreTold)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 24; ++seed)
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            const BentSolid solid = drawn_by_lot(seed);
            const auto file = folder / (form == CadForm::step ? "part.step" : "part.stl");
            shapes::write_bent_solid(file, solid, form);
            SCOPED_TRACE(fmt::format("seed {}, {}", seed, file.extension().string()));
            const Session session = blank_of(file);
            const PartFile& part = *session.part;
            ASSERT_TRUE(part.solid);
            EXPECT_EQ(part.solid->skin, Skin::middle);
            // STL files hold single precision; vertices of chords lie on the circles.
            const double same = form == CadForm::step ? 1e-6 : 1e-4;
            std::vector<double> holes, marks, expected_holes, expected_marks;
            const auto loops = boundary_loops(part.mesh);
            ASSERT_EQ(loops.size(), 1 + solid.sink.size());
            for (const std::vector<int>& loop : loops)
                if (const Round round = round_of(part.mesh.position(Eigen::all, loop)); round.radius < 12)
                    holes.push_back(round.radius);
            for (const Eigen::Matrix3Xd& mark : part.solid->marks) {
                const Round round = round_of(mark.leftCols(mark.cols() - 1));
                EXPECT_LT(round.off, same);
                marks.push_back(round.radius);
            }
            for (const Sink& sink : solid.sink) {
                expected_holes.push_back(sink.hole);
                expected_marks.push_back(sink.wide);
            }
            for (std::vector<double>* values : {&holes, &marks, &expected_holes, &expected_marks})
                std::sort(values->begin(), values->end());
            ASSERT_EQ(holes.size(), expected_holes.size());
            ASSERT_EQ(marks.size(), expected_marks.size());
            for (size_t i = 0; i < holes.size(); ++i) {
                EXPECT_NEAR(holes[i], expected_holes[i], same * expected_holes[i]);
                EXPECT_NEAR(marks[i], expected_marks[i], same * expected_marks[i]);
            }
            const Finding* told = part.doctor.find(Fault::mark);
            ASSERT_TRUE(told);
            EXPECT_EQ(told->count, int(solid.sink.size()));
            for (const Sink& sink : solid.sink)
                EXPECT_TRUE(std::ranges::any_of(told->what, [&](const std::string& what) {
                    return what.starts_with(fmt::format("{} {:.4g} mm wide, {:.4g} mm deep, of a hole of {:.4g} mm",
                                                        sink.counterbore ? "counterbore" : "countersink", 2 * sink.wide,
                                                        sink.depth, 2 * sink.hole));
                })) << told->what.front();
            EXPECT_TRUE(part.doubts.empty());
            const BlankDrawing drawing = drawn_blank(part, find_bends(part.mesh), session.blank->blank,
                                                     session.blank->face, true, session.bends.get());
            EXPECT_EQ(drawing.marks.size(), solid.sink.size());
        }
}

TEST(SunkHoles, AreNoneWherePlainHolesAre)
{
    const ScratchFolder folder;
    BentSolid solid;
    solid.leg = {60, 40};
    solid.bend = {{3, 1}};
    solid.width = 50;
    shapes::Cutout round;
    round.centre = {20, 20};
    round.length = round.width = 8;
    round.radius = 4;
    solid.cutout = {round};
    for (const CadForm form : {CadForm::step, CadForm::stl}) {
        const auto file = folder / (form == CadForm::step ? "part.step" : "part.stl");
        shapes::write_bent_solid(file, solid, form);
        const PartFile part = read_part(file);
        ASSERT_TRUE(part.solid);
        EXPECT_TRUE(part.solid->marks.empty());
        EXPECT_FALSE(part.doctor.find(Fault::mark));
    }
}

} // namespace spia
