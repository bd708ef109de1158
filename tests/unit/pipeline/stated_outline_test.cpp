// Circles, arcs and lines of CAD files in the DXF of the blank: exactly those of the file, however
// coarse the triangles are. Files are read here group by group, for our own reader makes chords.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

#include "engine/exchange/lines/read_dxf.h"
#include "engine/exchange/lines/write_dxf.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/blank/drawn_blank.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/session.h"
#include "engine/unfold/plan/bends.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/mesh_file.h"
#include "tests/support/seeded_random.h"
#include "tests/support/sheet_solid.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::stated_outline_test {
namespace {

namespace fs = std::filesystem;
using shapes::BentSolid;
using shapes::Cutout;
using std::numbers::pi;

/// A circle, or an arc of a polyline.
struct DrawnArc {
    std::string layer;
    Eigen::Vector2d centre;
    double radius, turn; ///< mm; radians, all around 2 pi
};

struct DrawnLoop {
    std::string layer;
    Eigen::Matrix2Xd point;
    int lines = 0; ///< straight pieces
};

struct Drawn {
    std::vector<DrawnArc> arcs;
    std::vector<DrawnLoop> loops; ///< polylines
};

/// Circles and polylines of a DXF file.
Drawn drawn_in(const fs::path& file)
{
    std::vector<std::pair<int, std::string>> group;
    std::ifstream in(file);
    for (std::string code, value; std::getline(in, code) && std::getline(in, value);)
        group.emplace_back(std::stoi(code), value);
    Drawn drawn;
    for (size_t i = 0; i < group.size(); ++i) {
        if (group[i].first != 0 || (group[i].second != "CIRCLE" && group[i].second != "LWPOLYLINE"))
            continue;
        DrawnLoop loop;
        std::vector<Eigen::Vector2d> at;
        std::vector<double> bulge;
        double radius = 0;
        for (size_t k = i + 1; k < group.size() && group[k].first != 0; ++k) {
            const auto& [code, text] = group[k];
            if (code == 8)
                loop.layer = text;
            if (code == 10) {
                at.emplace_back(std::stod(text), 0);
                bulge.push_back(0);
            }
            if (code == 20)
                at.back()[1] = std::stod(text);
            if (code == 40)
                radius = std::stod(text);
            if (code == 42)
                bulge.back() = std::stod(text);
        }
        if (group[i].second == "CIRCLE") {
            drawn.arcs.push_back({loop.layer, at[0], radius, 2 * pi});
            continue;
        }
        for (size_t k = 0; k < at.size(); ++k)
            if (const Eigen::Vector2d a = at[k], b = at[(k + 1) % at.size()]; bulge[k] != 0) {
                const double turn = 4 * std::atan(std::abs(bulge[k]));
                drawn.arcs.push_back(
                    {loop.layer, arc_centre(a, b, bulge[k]), (b - a).norm() / 2 / std::sin(turn / 2), turn});
            } else
                ++loop.lines;
        loop.point.resize(2, Eigen::Index(at.size()));
        for (size_t k = 0; k < at.size(); ++k)
            loop.point.col(Eigen::Index(k)) = at[k];
        drawn.loops.push_back(std::move(loop));
    }
    return drawn;
}

/// Cutouts of all kinds, each with a radius of its own, side by side on the legs.
BentSolid drilled(std::uint64_t seed)
{
    shapes::SeededRandom random(seed);
    BentSolid solid;
    solid.kind = "drilled";
    solid.thickness = random.between(0.8, 3);
    solid.width = random.between(60, 120);
    solid.pose = seed;
    const int bends = random.whole(0, 2);
    for (int b = 0; b < bends; ++b)
        solid.bend.push_back(
            {random.between(1, 4) * solid.thickness, random.between(0.4, 1.6) * (random.coin() ? 1 : -1)});
    for (int leg = 0; leg <= bends; ++leg) {
        const int along = random.whole(1, 3);
        solid.leg.push_back(along * 40);
        for (int k = 0; k < along; ++k) {
            Cutout cutout;
            cutout.leg = leg;
            cutout.centre = {40 * k + random.between(16, 24), solid.width * random.between(0.3, 0.7)};
            cutout.turn = random.between(0, pi);
            cutout.width = random.between(3, 14);
            const int kind = random.whole(0, 2);
            cutout.length = kind == 0 ? cutout.width : cutout.width + random.between(2, 8);
            cutout.radius = kind == 2 ? cutout.width * random.between(0.1, 0.4) : cutout.width / 2;
            cutout.halves = random.coin();
            solid.cutout.push_back(cutout);
        }
    }
    return solid;
}

int arcs_of(const Cutout& cutout)
{
    return cutout.length == 2 * cutout.radius ? 1 : cutout.width == 2 * cutout.radius ? 2 : 4;
}

class StatedOutline : public testing::Test {
protected:
    Session blank_of(const BentSolid& solid, const ReadOptions& read, shapes::CadForm form = shapes::CadForm::step)
    {
        const fs::path file = folder_ / (std::string("part") + extension(form));
        write_bent_solid(file, solid, form);
        return blank_of(file, read);
    }

    static Session blank_of(const fs::path& file, const ReadOptions& read)
    {
        Session session;
        session.file = file;
        session.options.read = read;
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        session = run_stage(Stage::read, session);
        session.options.flatten.thickness = session.part->thickness_mm.value();
        return run_stage(Stage::solve, session);
    }

    Drawn drawn(const Session& session, const DxfOptions& dxf = {})
    {
        write_dxf(folder_ / "blank.dxf",
                  drawn_blank(*session.part, find_bends(session.part->mesh), session.blank->blank, session.blank->face,
                              true, session.bends.get()),
                  dxf);
        return drawn_in(folder_ / "blank.dxf");
    }

    ScratchFolder folder_;
};

/// Radii and places of all arcs against those that were drawn at random.
void expect_cutouts(const BentSolid& solid, const Drawn& drawn, const std::string& what)
{
    constexpr double same = 1e-9; // of a length
    std::vector<Eigen::Vector2d> middle;
    size_t expected = 0;
    for (const Cutout& cutout : solid.cutout) {
        std::vector<DrawnArc> own;
        for (const DrawnArc& arc : drawn.arcs)
            if (std::abs(arc.radius - cutout.radius) <= same * cutout.radius)
                own.push_back(arc);
        const int arcs = arcs_of(cutout);
        expected += size_t(arcs);
        ASSERT_EQ(int(own.size()), arcs) << what << ", radius " << cutout.radius;
        middle.emplace_back(0, 0);
        double apart = 0;
        for (const DrawnArc& a : own) {
            EXPECT_EQ(a.layer, "HOLES");
            EXPECT_NEAR(a.turn, 2 * pi / arcs, 1e-7) << what;
            middle.back() += a.centre / arcs;
            for (const DrawnArc& b : own)
                apart = std::max(apart, (a.centre - b.centre).norm());
        }
        const double diagonal = std::hypot(cutout.length - 2 * cutout.radius, cutout.width - 2 * cutout.radius);
        EXPECT_NEAR(apart, diagonal, same * cutout.length) << what;
    }
    EXPECT_EQ(drawn.arcs.size(), expected) << what << ": no others";
    for (size_t a = 0; a < middle.size(); ++a)
        for (size_t b = 0; b < a; ++b)
            if (const Cutout& one = solid.cutout[a], &other = solid.cutout[b]; one.leg == other.leg) {
                const double distance = (one.centre - other.centre).norm();
                EXPECT_NEAR((middle[a] - middle[b]).norm(), distance, same * distance) << what;
            }
}

} // namespace

TEST_F(StatedOutline, HolesOfPlatesAndBracketsAreThoseOfTheFileHoweverCoarseTheTriangles)
{
    for (std::uint64_t seed = 1; seed <= 18; ++seed) {
        const BentSolid solid = drilled(seed);
        ReadOptions read;
        if (seed % 3)
            read.cad = {.deflection = 2, .angle = 1.2};
        const Session session = blank_of(solid, read, seed % 4 == 0 ? shapes::CadForm::brep : shapes::CadForm::step);
        const std::string what = fmt::format("seed {}, {} bends", seed, solid.bend.size());
        const Drawn all = drawn(session);
        expect_cutouts(solid, all, what);
        // The outline is a rectangle, over its bends as well.
        const auto outline = std::find_if(all.loops.begin(), all.loops.end(),
                                          [](const DrawnLoop& loop) { return loop.layer == "OUTLINE"; });
        ASSERT_NE(outline, all.loops.end());
        EXPECT_EQ(outline->lines, 4) << what;
        const double length = solid.developed(0.5);
        EXPECT_NEAR(std::abs(signed_area(outline->point)), length * solid.width, 1e-6 * length * solid.width) << what;
        EXPECT_NEAR(std::abs(signed_area(read_dxf(folder_ / "blank.dxf").lines[0].point.topRows<2>())),
                    length * solid.width, 1e-6 * length * solid.width);
    }
}

TEST_F(StatedOutline, TheyAreTheSameOnceThePartIsRemeshed)
{
    // Of plates: bends of other triangles than those along them are chords every which way, which
    // strains the legs by micrometres.
    for (std::uint64_t seed = 31; seed <= 36; ++seed) {
        BentSolid solid = drilled(seed);
        solid.bend.clear();
        solid.leg.resize(1);
        std::erase_if(solid.cutout, [](const Cutout& cutout) { return cutout.leg > 0; });
        ReadOptions read;
        read.cad = {.deflection = 1, .angle = 0.8};
        read.remesh = RemeshOptions{.size = 8, .tolerance = 0.05};
        const Session session = blank_of(solid, read);
        ASSERT_TRUE(session.part->remeshed);
        const Drawn all = drawn(session);
        expect_cutouts(solid, all, fmt::format("seed {}", seed));
        EXPECT_EQ(std::count_if(all.loops.begin(), all.loops.end(),
                                [](const DrawnLoop& loop) { return loop.layer == "OUTLINE" && loop.lines == 4; }),
                  1);
    }
}

TEST_F(StatedOutline, EveryUnitAndSkinHasThem)
{
    const BentSolid solid = drilled(7);
    for (const Skin skin : {Skin::outer, Skin::inner}) {
        ReadOptions read;
        read.skin = skin;
        expect_cutouts(solid, drawn(blank_of(solid, read)), name(skin));
    }
    DxfOptions inches;
    inches.unit = LengthUnit::inch;
    Drawn all = drawn(blank_of(solid, {}), inches);
    for (DrawnArc& arc : all.arcs) {
        arc.radius *= 25.4;
        arc.centre *= 25.4;
    }
    expect_cutouts(solid, all, "inches");
}

TEST_F(StatedOutline, WhereAHoleGoesIntoABendOnlyItsFlatArcIsStated)
{
    BentSolid solid;
    solid.leg = {60, 60};
    solid.bend = {{3, pi / 2}};
    solid.width = 60;
    Cutout cutout; // its edge 2 mm beyond where the bend begins
    cutout.centre = {54, 30};
    cutout.length = cutout.width = 16;
    cutout.radius = 8;
    solid.cutout = {cutout};
    const Drawn all = drawn(blank_of(solid, {}));
    ASSERT_FALSE(all.arcs.empty());
    const auto longest = std::max_element(all.arcs.begin(), all.arcs.end(),
                                          [](const auto& a, const auto& b) { return a.turn < b.turn; });
    EXPECT_NEAR(longest->radius, 8, 8e-9);
    EXPECT_NEAR(longest->turn, 2 * pi - 2 * std::acos(6. / 8), 1e-6);
}

TEST_F(StatedOutline, MarksAreOutlinesInTheBlank)
{
    for (const double side : {1., -1.}) { // a bend to either side: engraved into the outer skin,
                                          // and into the inner one
        BentSolid solid;
        solid.leg = {80, 50};
        solid.bend = {{3, side * pi / 2}};
        solid.width = 60;
        solid.pose = 5;
        Cutout hole;
        hole.centre = {15, 30};
        hole.length = hole.width = 12;
        hole.radius = 6;
        Cutout mark;
        mark.centre = {50, 26};
        mark.length = 22;
        mark.width = 9;
        mark.radius = 0;
        mark.turn = 0.4;
        mark.depth = 0.2;
        solid.cutout = {hole, mark};
        const Session session = blank_of(solid, {});
        ASSERT_EQ(session.part->solid->marks.size(), 1u);
        const Drawn all = drawn(session);
        std::vector<DrawnLoop> marks;
        for (const DrawnLoop& loop : all.loops)
            if (loop.layer == "MARKS")
                marks.push_back(loop);
        ASSERT_EQ(marks.size(), 1u);
        EXPECT_NEAR(std::abs(signed_area(marks[0].point)), 22 * 9, 1e-5 * 22 * 9);
        EXPECT_EQ(marks[0].point.cols(), 4);
        ASSERT_EQ(all.arcs.size(), 1u);
        EXPECT_NEAR((marks[0].point.rowwise().mean() - all.arcs[0].centre).norm(), std::hypot(35., 4.), 1e-5 * 35);
    }
}

TEST_F(StatedOutline, AMarkAcrossABendHasTheLengthOfTheSheetThere)
{
    constexpr double t = 2, depth = 0.2;
    const shapes::BentSheet sheet = shapes::bent_sheet(
        // the second leg goes down
        shapes::Profile({0, 0}, 0).straight(30).bend(6, -pi / 2).straight(20), 60, 2);
    const int faces = sheet.mesh.triangles(), vertices = sheet.mesh.vertices();
    for (const bool inner : {false, true}) {
        std::vector<char> chosen(2 * size_t(faces), 0);
        for (int f = 0; f < faces; ++f) {
            const auto middle = [&](int g) {
                return Eigen::Vector3d(sheet.mesh.position(Eigen::all, sheet.mesh.triangle.col(g)).rowwise().mean());
            };
            const Eigen::Vector3d p = (middle(f) + middle(f ^ 1)) / 2; // of the cell
            chosen[size_t(f + (inner ? faces : 0))] = p.x() > 22 && p.z() > -16 && p.y() > 16 && p.y() < 30;
        }
        Eigen::Matrix3Xd way(3, 2 * vertices);
        way << -depth * sheet.normal, depth * sheet.normal;
        shapes::write_mesh(folder_ / "part.obj",
                           shapes::stepped(shapes::thickened(sheet.mesh, -t * sheet.normal), faces, chosen, way));
        const Session session = blank_of(folder_ / "part.obj", {});
        ASSERT_TRUE(session.part->solid);
        const Drawn all = drawn(session);
        const auto mark = std::find_if(all.loops.begin(), all.loops.end(),
                                       [](const DrawnLoop& loop) { return loop.layer == "MARKS"; });
        ASSERT_NE(mark, all.loops.end());
        const Eigen::Vector2d size = mark->point.rowwise().maxCoeff() - mark->point.rowwise().minCoeff();
        const auto outline = std::find_if(all.loops.begin(), all.loops.end(),
                                          [](const DrawnLoop& loop) { return loop.layer == "OUTLINE"; });
        const Eigen::Vector2d blank = outline->point.rowwise().maxCoeff() - outline->point.rowwise().minCoeff();
        // All of the bend, and of the legs 8 and 10 mm. A mark on the hollow side keeps the bend of
        // a mesh from being laid as an arc.
        const double length = blank.minCoeff() - 22 - 10;
        EXPECT_NEAR(length, 8 + pi / 2 * 5 + 10, inner ? 0.05 : 1e-4);
        EXPECT_NEAR(size.maxCoeff(), length, 1e-3) << inner;
        EXPECT_NEAR(size.minCoeff(), 14, 1e-3);
        EXPECT_NEAR(std::abs(signed_area(mark->point)), length * 14, 1e-3 * length * 14);
    }
}

// ../shared/data/cad: the CIRCLE entities of the STEP file.
TEST_F(StatedOutline, TheHolesOfTheFanBracketHaveTheRadiiOfItsFile)
{
    const fs::path file = fs::path(SPIA_SOURCE_DIR) / "../shared/data/cad/fan_bracket.step";
    if (!fs::exists(file))
        GTEST_SKIP() << "no " << file;
    std::vector<double> radii;
    for (const DrawnArc& arc : drawn(blank_of(file, {})).arcs)
        if (arc.turn == 2 * pi)
            radii.push_back(arc.radius);
    std::sort(radii.begin(), radii.end());
    const std::vector<double> expected = {0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 1.55, 1.55, 1.55, 1.55, 4, 4};
    ASSERT_EQ(radii.size(), expected.size());
    for (size_t k = 0; k < radii.size(); ++k)
        EXPECT_NEAR(radii[k], expected[k], 1e-12);
}

} // namespace spia::stated_outline_test
