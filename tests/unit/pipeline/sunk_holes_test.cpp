// Countersinks and counterbores of sheet solids: what is cut is the least diameter, what is sunk is
// drawn, and what is none is told apart.
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>

#include "engine/exchange/read_part.h"
#include "engine/mesh/solid/fit/round_edge.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/blank/drawn_blank.h"
#include "engine/pipeline/session.h"
#include "engine/unfold/plan/bends.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/family.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {
namespace {

using shapes::BentSolid;
using shapes::CadForm;
using shapes::Cutout;
using shapes::Sink;

/// One of a hole on each leg of a plate or a bracket: sunk from either side, to any depth, through
/// all of it at times.
BentSolid random_sunk_solid(std::uint64_t seed)
{
    shapes::SeededRandom random(seed);
    BentSolid solid;
    solid.kind = "sunk";
    solid.thickness = random.between(1, 4);
    solid.width = 100; // so large that the floors of counterbores are specks
    solid.pose = seed;
    solid.leg = {160};
    if (random.coin()) {
        solid.leg.push_back(160);
        solid.bend.push_back({random.between(1, 3) * solid.thickness, random.coin() ? 1.2 : -1.2});
    }
    for (int leg = 0; leg < int(solid.leg.size()); ++leg) {
        Sink sink;
        sink.leg = leg;
        sink.centre = {random.between(50, 110), random.between(30, 70)};
        sink.hole = random.between(2, 5);
        sink.counterbore = random.coin();
        sink.left = random.coin();
        const bool through = !sink.counterbore && random.whole(0, 2) == 0;
        sink.depth =
            // shallower wide counterbores are marks
            solid.thickness * (through ? 1 : random.between(0.25, 0.9));
        sink.wide = sink.hole + random.between(0.5, 1.2) * (sink.counterbore ? solid.thickness : sink.depth);
        solid.sink.push_back(sink);
    }
    return solid;
}

/// Plates and brackets with one to four counterbores of catalogue's sizes, tenths of a millimetre,
/// from both sides.
BentSolid random_counterbored_solid(std::uint64_t seed)
{
    shapes::SeededRandom random(seed + 1000);
    const auto tenths = [&](double low, double high) { return std::round(10 * random.between(low, high)) / 10; };
    BentSolid solid;
    solid.kind = fmt::format("counterbored, seed {}", seed);
    solid.thickness = tenths(2, 12);
    solid.width = tenths(50, 80);
    solid.pose = seed;
    solid.leg = {tenths(100, 140)};
    if (solid.thickness < 5 && random.coin()) {
        solid.leg.push_back(40);
        solid.bend.push_back({random.between(1, 3) * solid.thickness, random.coin() ? 1.2 : -1.2});
    }
    const int count = random.whole(1, 4);
    for (int i = 0; i < count; ++i) {
        Sink sink;
        sink.centre = {solid.leg[0] * (i + 0.5) / count, solid.width * random.between(0.4, 0.6)};
        sink.hole = tenths(1.5, 5);
        sink.wide = sink.hole + tenths(2, 4.5);
        sink.counterbore = true;
        sink.left = random.coin();
        // shallower ones are marks
        sink.depth = tenths(0.25 * solid.thickness, 0.9 * solid.thickness);
        solid.sink.push_back(sink);
    }
    return solid;
}

/// One of given diameters in the middle of a plate.
BentSolid counterbored(double length, double width, double thickness, double wide, double hole, double depth)
{
    BentSolid solid;
    solid.kind = fmt::format("M, {} x {}", length, width);
    solid.thickness = thickness;
    solid.width = width;
    solid.leg = {length};
    Sink sink;
    sink.centre = {length / 2, width / 2};
    sink.hole = hole / 2;
    sink.wide = wide / 2;
    sink.depth = depth;
    sink.counterbore = true;
    solid.sink = {sink};
    return solid;
}

/// One to six countersinks and a counterbore or two on one flat of a plate or an L bracket, from
/// both sides, of any angle from 60 to 140 degrees, a tenth of the thickness deep to all of it,
/// holes of half the thickness to six times it. Hundredths of a millimetre.
BentSolid random_mixed_sinks(std::uint64_t seed)
{
    shapes::SeededRandom random(seed + 5000);
    const auto hundredths = [](double value) { return std::round(100 * value) / 100; };
    BentSolid solid;
    solid.kind = fmt::format("any sinks, seed {}", seed);
    const double t = solid.thickness = hundredths(random.between(0.8, 4));
    solid.pose = seed;
    const double cell = 13 * t; // the widest is 11.5 t wide
    solid.width = 2 * cell;
    solid.leg = {3 * cell};
    if (random.coin()) {
        solid.leg.push_back(random.between(8, 30) * t);
        solid.bend.push_back({random.between(0.5, 3) * t, random.coin() ? 1.3 : -1.3});
    }
    const int count = random.whole(1, 6);
    for (int i = 0; i < count; ++i) {
        Sink sink;
        const int row = i / 3;
        sink.centre = {(i % 3 + random.between(0.48, 0.52)) * cell, (row + random.between(0.48, 0.52)) * cell};
        sink.left = random.coin();
        sink.hole = hundredths(random.between(0.25, 3) * t);
        sink.counterbore = random.whole(0, 6) == 0;
        sink.depth = random.whole(0, 3) == 0 && !sink.counterbore ? t : hundredths(random.between(0.1, 0.97) * t);
        const double half_angle = random.between(30, 70) * std::numbers::pi / 180;
        sink.wide = sink.hole + hundredths(sink.counterbore ? random.between(0.2, 2.5) * t
                                                            : std::max(sink.depth * std::tan(half_angle), 0.03 * t));
        solid.sink.push_back(sink);
    }
    return solid;
}

/// Of a counterbore's floor in the surface of the solid, roughly.
double floor_share(const BentSolid& solid, const Sink& sink)
{
    return std::numbers::pi * (sink.wide * sink.wide - sink.hole * sink.hole) /
           (2 * solid.developed(0.5) * (solid.width + solid.thickness));
}

struct Round {
    double radius, off; ///< mm; of the points at most
};

/// Of a closed row of points, which need not lie evenly around it.
Round round_of(const Eigen::Matrix3Xd& points)
{
    const Eigen::Vector3d middle = points.rowwise().mean();
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < points.cols(); ++i)
        axis += (points.col(i) - middle).cross(points.col((i + 1) % points.cols()) - middle);
    const auto circle = round_edge(points, axis, bounding_diagonal({points, {}}));
    if (!circle)
        return {std::numeric_limits<double>::infinity(), 0};
    double off = 0;
    for (const auto& p : points.colwise())
        off = std::max(off, std::abs((p - circle->centre).norm() - circle->radius));
    return {circle->radius, off};
}

/// Of a plate: that of its outline less its holes, whose chords of up to 0.2 radians take 0.7 % of
/// a hole.
void expect_area(const BentSolid& solid, const TriMesh& blank)
{
    if (!solid.bend.empty())
        return;
    double holes = 0;
    for (const Sink& sink : solid.sink)
        holes += std::numbers::pi * sink.hole * sink.hole;
    EXPECT_NEAR(area(blank), solid.leg[0] * solid.width - holes, 0.01 * holes);
}

void expect_right(const ScratchFolder& folder, const BentSolid& solid, CadForm form)
{
    const auto file = folder / (std::string("part") + extension(form));
    shapes::write_bent_solid(file, solid, form);
    SCOPED_TRACE(file.extension().string());
    const Session session = solved_part(file);
    const PartFile& part = *session.part;
    ASSERT_TRUE(part.solid);
    EXPECT_EQ(part.solid->skin, Skin::middle);
    // Circles of IGES files are splines within 1e-5 mm, STL files hold single precision; vertices
    // of chords lie on the circles.
    const double same = form == CadForm::stl ? 1e-4 : form == CadForm::iges ? 1e-5 : 1e-6;
    expect_area(solid, part.mesh);
    std::vector<double> holes, marks, expected_holes, expected_marks;
    const auto loops = boundary_loops(part.mesh);
    ASSERT_EQ(loops.size(), 1 + solid.sink.size());
    const double largest = std::ranges::max(solid.sink, {}, &Sink::hole).hole;
    for (const std::vector<int>& loop : loops)
        if (const Round round = round_of(part.mesh.position(Eigen::all, loop)); round.radius < 1.2 * largest) {
            EXPECT_LT(round.off, same);
            holes.push_back(round.radius);
        }
    for (const auto& [mark, label] : part.solid->marks) {
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
    EXPECT_NE(told->text.find("has the least diameter of each"), std::string::npos) << told->text;
    for (const Sink& sink : solid.sink)
        EXPECT_TRUE(std::ranges::any_of(told->what, [&](const std::string& what) {
            return what.starts_with(fmt::format("{} {:.4g} mm wide, {:.4g} mm deep, of a hole of {:.4g} mm",
                                                sink.counterbore ? "counterbore" : "countersink", 2 * sink.wide,
                                                sink.depth, 2 * sink.hole));
        })) << told->what.front();
    EXPECT_EQ(part.doubts, std::vector<std::string>());
    const BlankDrawing drawing =
        drawn_blank(part, find_bends(part.mesh), session.blank->blank, session.blank->face, true, session.bends.get());
    EXPECT_EQ(drawing.marks.size(), solid.sink.size());
}

} // namespace

TEST(SunkHoles, HaveTheirLeastDiameterAndAreTold)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 24; ++seed)
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            SCOPED_TRACE(fmt::format("seed {}", seed));
            expect_right(folder, random_sunk_solid(seed), form);
        }
}

TEST(SunkHoles, OfAnyAngleDepthAndSizeAreRightHoweverManyAreOnAFlat)
{
    // Their walls are no skins, though of the flattest ones most lies opposite to the other skin at
    // about the thickness.
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= shapes::family_size(40); ++seed)
        for (const auto& [form, parameters] :
             {std::pair(CadForm::step, true), {CadForm::iges, true}, {CadForm::iges, false}, {CadForm::stl, true}}) {
            const BentSolid solid = random_mixed_sinks(seed);
            SCOPED_TRACE(solid.kind);
            shapes::write_iges_parameters(parameters);
            expect_right(folder, solid, form);
        }
}

TEST(SunkHoles, OfOneHoleAtBothSkinsAreCountedOnce)
{
    const ScratchFolder folder;
    for (const bool alike : {true, false})
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            BentSolid solid = counterbored(60, 40, 2.5, 6.8, 6, 0.4);
            solid.sink.front().counterbore = false;
            solid.sink.push_back(solid.sink.front());
            solid.sink.back().left = false;
            solid.sink.back().wide += alike ? 0 : 0.3;
            solid.sink.back().depth += alike ? 0 : 0.3;
            const auto file = folder / (std::string("part") + extension(form));
            shapes::write_bent_solid(file, solid, form);
            const PartFile part = read_part(file);
            ASSERT_TRUE(part.solid);
            EXPECT_EQ(part.solid->marks.size(), alike ? 1u : 2u);
            for (const auto& [circle, label] : part.solid->marks)
                EXPECT_EQ(label.outer && label.inner, alike);
            const Finding* told = part.doctor.find(Fault::mark);
            ASSERT_TRUE(told);
            EXPECT_EQ(told->count, 1);
            ASSERT_EQ(told->what.size(), 1u);
            EXPECT_EQ(told->place.size(), 1u);
            if (alike)
                EXPECT_EQ(told->what[0], "countersink 6.8 mm wide, 0.4 mm deep, of a hole of 6 mm, on both skins");
            else
                for (const char* each : {"6.8 mm wide, 0.4 mm deep", "7.4 mm wide, 0.7 mm deep", "outer", "inner"})
                    EXPECT_NE(told->what[0].find(each), std::string::npos) << told->what[0];
        }
}

TEST(SunkHoles, ThatABorderABendOrAnotherOneCutsOffAreTold)
{
    const ScratchFolder folder;
    const auto bracket = [](const std::vector<Eigen::Vector2d>& centres, double half_angle, bool left) {
        BentSolid solid;
        solid.thickness = 2;
        solid.width = 50;
        solid.leg = {50, 40};
        solid.bend = {{2, 1.2}};
        for (const Eigen::Vector2d& centre : centres) {
            Sink sink;
            sink.centre = centre;
            sink.left = left;
            sink.hole = 2.5;
            sink.depth = 1.5;
            sink.wide = sink.hole + 1.5 * std::tan(half_angle);
            solid.sink.push_back(sink);
        }
        return solid;
    };
    for (const double half_angle : {0.7, 1.05})
        for (const bool left : {true, false})
            for (const CadForm form : {CadForm::step, CadForm::stl})
                for (const std::string& at_one : {std::string("border"), std::string("bend"), std::string("another")}) {
                    if (at_one == "bend" && left && half_angle > 1)
                        continue; // so flat a cone runs through the hollow side of the bend into
                                  // the other leg
                    const double wide = 2.5 + 1.5 * std::tan(half_angle), reach = 0.6;
                    std::vector<Eigen::Vector2d> centres = {{20, 20}, {20, 20 + 2 * wide - reach}};
                    if (at_one != "another")
                        centres = {{at_one == "border" ? wide - reach : 50 + reach - wide, 25}};
                    SCOPED_TRACE(fmt::format("{:.3g} rad, {} side, {}, {}", half_angle, left ? "left" : "right", at_one,
                                             form == CadForm::step ? "STEP" : "STL"));
                    const BentSolid solid = bracket(centres, half_angle, left);
                    const auto file = folder / (std::string("part") + extension(form));
                    shapes::write_bent_solid(file, solid, form);
                    const Session session = solved_part(file);
                    const PartFile& part = *session.part;
                    ASSERT_TRUE(part.solid);
                    const Finding* told = part.doctor.find(Fault::mark);
                    ASSERT_TRUE(told);
                    EXPECT_EQ(told->count, int(centres.size()));
                    for (const std::string& what : told->what)
                        EXPECT_TRUE(what.starts_with(fmt::format("countersink {:.4g} mm wide, 1.5 mm deep, of a hole "
                                                                 "of 5 mm",
                                                                 2 * solid.sink[0].wide)) &&
                                    what.ends_with("cuts it off"))
                            << what;
                    EXPECT_GE(part.solid->marks.size(), centres.size());
                    int holes = 0;
                    for (const std::vector<int>& loop : boundary_loops(part.mesh))
                        holes += std::abs(round_of(part.mesh.position(Eigen::all, loop)).radius - 2.5) < 1e-3;
                    EXPECT_EQ(holes, int(centres.size()));
                    EXPECT_NEAR((session.blank->blank.position.rowwise().maxCoeff() -
                                 session.blank->blank.position.rowwise().minCoeff())
                                    .maxCoeff(),
                                solid.developed(0.5), 0.01);
                }
}

TEST(SunkHoles, AreAtTheSkinOutsideOfTheBendHoweverMuchTheyTakeOfIt)
{
    // The areas of the skins say the opposite.
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
        for (const CadForm form : {CadForm::step, CadForm::stl})
            for (const bool outside : {true, false}) {
                shapes::SeededRandom random(seed + 700);
                BentSolid solid;
                solid.thickness = random.between(2, 3);
                solid.width = random.between(30, 40);
                solid.leg = {50, 50};
                const double way = random.coin() ? 1 : -1;
                solid.bend = {{random.between(1, 2) * solid.thickness, way * random.between(0.1, 0.2)}};
                solid.pose = seed;
                for (const int leg : {0, 1}) {
                    Sink sink;
                    sink.leg = leg;
                    sink.centre = {25, solid.width / 2};
                    sink.hole = random.between(3, 4);
                    sink.counterbore = random.coin();
                    sink.depth = (sink.counterbore ? 0.45 : random.between(0.6, 0.8)) * solid.thickness;
                    sink.wide =
                        sink.hole + (sink.counterbore ? random.between(2, 3) : sink.depth * random.between(0.8, 1.2));
                    sink.left = (way > 0) != outside;
                    solid.sink.push_back(sink);
                }
                SCOPED_TRACE(fmt::format("seed {}, {}, sunk {}", seed, form == CadForm::step ? "STEP" : "STL",
                                         outside ? "outside" : "inside"));
                const auto file = folder / (std::string("part") + extension(form));
                shapes::write_bent_solid(file, solid, form);
                const PartFile part = read_part(file);
                const Finding* told = part.doctor.find(Fault::mark);
                ASSERT_TRUE(told);
                EXPECT_EQ(told->what.size(), 2u) << told->text;
                for (const std::string& each : told->what)
                    EXPECT_NE(each.find(outside ? "on the outer skin" : "on the inner skin"), std::string::npos)
                        << each;
            }
}

TEST(SunkHoles, OfNinetyDegreesAreNoSkinWhereverTheyAre)
{
    // Their walls are askew by 45 degrees: no skin, but by some of their chords nearly one.
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        shapes::SeededRandom random(seed + 900);
        BentSolid solid;
        solid.kind = "plate";
        solid.thickness = random.between(1.5, 4);
        solid.width = 120;
        solid.leg = {150};
        Sink sink;
        sink.centre = {random.between(20, 130), random.between(20, 100)};
        sink.hole = random.between(1.5, 4);
        sink.depth = solid.thickness * random.between(0.5, 0.95);
        sink.wide = sink.hole + sink.depth;
        sink.left = random.coin();
        solid.sink = {sink};
        expect_right(folder, solid, CadForm::step);
    }
}

TEST(SunkHoles, AreNoStepsHoweverLargeTheFloorsOfCounterboresAre)
{
    const ScratchFolder folder;
    std::vector<BentSolid> solids = {counterbored(100, 60, 12, 15, 9, 8.6), counterbored(60, 40, 3, 11, 6.6, 1.5)};
    for (std::uint64_t seed = 1; seed <= 24; ++seed)
        solids.push_back(random_counterbored_solid(seed));
    int large = 0;
    for (const BentSolid& solid : solids) {
        large += std::ranges::any_of(solid.sink, [&](const Sink& sink) { return floor_share(solid, sink) > 0.005; });
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            SCOPED_TRACE(fmt::format("{}, {:.1f} mm thick", solid.kind, solid.thickness));
            expect_right(folder, solid, form);
        }
    }
    EXPECT_GE(2 * large, int(solids.size())) << "others were never refused";
}

TEST(SunkHoles, ArePocketsAndRefusedWhereNothingRoundGoesThroughTheirMiddle)
{
    const auto cut = [](double wide, double radius, double aside, double depth) {
        Cutout cutout;
        cutout.centre = {30 + aside, 20};
        cutout.length = cutout.width = wide;
        cutout.radius = radius;
        cutout.depth = depth;
        return cutout;
    };
    const ScratchFolder folder;
    const auto taken = [&](const std::vector<Cutout>& cutout, CadForm form) {
        BentSolid solid;
        solid.leg = {60};
        solid.width = 40;
        solid.thickness = 3;
        solid.cutout = cutout;
        const auto file = folder / (std::string("part") + extension(form));
        shapes::write_bent_solid(file, solid, form);
        const PartFile part = examine_part(file);
        return part.doctor.healthy() && part.solid;
    };
    for (const CadForm form : {CadForm::step, CadForm::stl}) {
        EXPECT_TRUE(taken({cut(15, 7.5, 0, 1.5), cut(8, 4, 0, 0)}, form)) << "a counterbore, to compare with";
        EXPECT_FALSE(taken({cut(15, 7.5, 0, 1)}, form)) << "no hole";
        EXPECT_FALSE(taken({cut(15, 7.5, 0, 1), cut(8, 4, 0, 2.5)}, form)) << "a blind hole";
        EXPECT_FALSE(taken({cut(15, 7.5, 0, 1), cut(8, 4, 2, 0)}, form)) << "a hole beside the middle";
        EXPECT_FALSE(taken({cut(15, 7.5, 0, 1), cut(8, 1, 0, 0)}, form)) << "a square hole";
        for (const double depth : {1., 1.5, 2., 2.7}) {
            EXPECT_FALSE(taken({cut(15, 2, 0, depth), cut(8, 4, 0, 0)}, form)) << "a square pocket " << depth;
            EXPECT_FALSE(taken({cut(15, 0, 0, depth), cut(8, 4, 0, 0)}, form)) << "a square pocket " << depth;
            EXPECT_FALSE(taken({cut(15, 7.5, 0, depth), cut(8, 4, 2, 0)}, form)) << "beside the middle, " << depth;
        }
    }
}

TEST(SunkHoles, AreNoneWherePlainHolesAre)
{
    const ScratchFolder folder;
    BentSolid solid;
    solid.leg = {60, 40};
    solid.bend = {{3, 1}};
    solid.width = 50;
    Cutout round;
    round.centre = {20, 20};
    round.length = round.width = 8;
    round.radius = 4;
    solid.cutout = {round};
    for (const CadForm form : {CadForm::step, CadForm::stl}) {
        const auto file = folder / (std::string("part") + extension(form));
        shapes::write_bent_solid(file, solid, form);
        const PartFile part = read_part(file);
        ASSERT_TRUE(part.solid);
        EXPECT_TRUE(part.solid->marks.empty());
        EXPECT_FALSE(part.doctor.find(Fault::mark));
    }
}

} // namespace spia
