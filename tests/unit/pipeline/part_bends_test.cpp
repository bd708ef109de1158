#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "engine/core/error.h"
#include "engine/core/json_file.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/flat/outline.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/blank/bend_report.h"
#include "engine/pipeline/blank/part_bends.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/session.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/report/json/report_json.h"
#include "engine/report/text/shown_lengths.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/cad/joined_tray.h"
#include "tests/support/cad/prism.h"
#include "tests/support/cad/random_bent_solid.h"
#include "tests/support/mesh_file.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/plane_faces.h"
#include "tests/support/seeded_random.h"
#include "tests/support/sheet_solid.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::part_bends_test {
namespace {

namespace fs = std::filesystem;
using shapes::BentSolid;
using std::numbers::pi;

BentSolid l_bracket() // that of the cases: legs of 40 and 25 mm outside
{
    BentSolid solid;
    solid.kind = "bracket";
    solid.leg = {40, 25};
    solid.bend = {{3, pi / 2}};
    return solid;
}

Session solved(const fs::path& file, const std::optional<KFactor>& k = {}, const ReadOptions& read = {})
{
    Session session;
    session.file = file;
    session.options.read = read;
    session.options.k_factor = k;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return completed(run_chain(std::move(session), Stage::read, Stage::solve));
}

/// Length across `along` and width along it of the outer outline, and how far its vertices are off
/// that rectangle.
struct Rectangle {
    double length, width, off;
};

Rectangle rectangle(const Session& session, const Eigen::Vector2d& along)
{
    const Eigen::Matrix2Xd& X = session.blank->blank.position;
    const auto loops = boundary_loops(session.part->mesh);
    Eigen::Matrix2d axes;
    axes << along[1], -along[0], along[0], along[1];
    std::vector<int> outline = loops[size_t(outer_loop(loops, X))];
    const Eigen::Matrix2Xd turned = axes * X(Eigen::all, outline);
    const Eigen::Vector2d low = turned.rowwise().minCoeff(), high = turned.rowwise().maxCoeff();
    double off = 0;
    for (Eigen::Index i = 0; i < turned.cols(); ++i)
        off = std::max(
            off, std::min((turned.col(i) - low).cwiseAbs().minCoeff(), (turned.col(i) - high).cwiseAbs().minCoeff()));
    return {high[0] - low[0], high[1] - low[1], off};
}

Rectangle rectangle(const Session& session)
{
    const auto& bends = session.bends->bends;
    if (bends.empty() || bends[0].line.empty())
        return {0, 0, 0};
    return rectangle(session, (bends[0].line[0].to - bends[0].line[0].from).normalized());
}

class PartBends : public testing::Test {
protected:
    fs::path write(const BentSolid& solid, const std::string& name = "part.step")
    {
        shapes::write_bent_solid(folder_ / name, solid);
        return folder_ / name;
    }
    ScratchFolder folder_;
};

} // namespace

TEST_F(PartBends, LBracketHasTheLengthOfItsNeutralFibre)
{
    const fs::path file = write(l_bracket());
    for (const double k : {0.5, 0.44, 0.33}) {
        const Session session = solved(file, k == 0.5 ? std::nullopt : std::optional(constant_k(k)));
        const double length = 40 + 25 + pi / 2 * (3 + k * 2);
        EXPECT_NEAR(rectangle(session).length, length, 1e-6) << k;
        EXPECT_NEAR(rectangle(session).width, 30, 1e-6) << k;
        EXPECT_EQ(session.part->solid->thickness, 2) << "as CAD has it, to the last digit";
        ASSERT_EQ(session.bends->bends.size(), 1u);
        const SheetBend& bend = session.bends->bends[0];
        EXPECT_NEAR(bend.inner_radius, 3, 1e-9);
        EXPECT_NEAR(bend.angle, pi / 2, 1e-7);
        EXPECT_EQ(bend.k, k);
        EXPECT_NEAR(bend.allowance, pi / 2 * (3 + 2 * k), 1e-6);
        EXPECT_NEAR(bend.deduction, 10 - bend.allowance, 1e-6);
        EXPECT_TRUE(bend.stated);
        EXPECT_TRUE(bend.laid);
        ASSERT_EQ(bend.line.size(), 1u);
        EXPECT_NEAR(bend.length, 30, 1e-6);
        EXPECT_LT(session.blank->face.strain_equivalent.maxCoeff(), 1e-6) << "the neutral fibre is not strained";
        EXPECT_LT(session.blank->volume_error, 1e-6);
        const Json report = parse_json(report_json(session, {}, 0), "report");
        EXPECT_EQ(report["blank"]["lengths_of"],
                  k == 0.5 ? "middle surface, K 0.5" : fmt::format("neutral fibre, K {}", k));
        EXPECT_EQ(report["bend_table"]["bends"].size(), 1u);
        EXPECT_TRUE(shortcomings(session).empty());
    }
}

TEST_F(PartBends, OfAMeshedTrayWithJoinedWallsEndInItsMitres)
{
    const shapes::JoinedTray tray;
    shapes::write_joined_tray(folder_ / "tray.stl", tray, shapes::CadForm::stl);
    ReadOptions read;
    read.seam.mode = SeamOptions::Mode::corners;
    const Session session = solved(folder_ / "tray.stl", {}, read);
    ASSERT_EQ(session.bends->bends.size(), 4u);
    for (const SheetBend& bend : session.bends->bends) {
        EXPECT_NEAR(bend.inner_radius, tray.radius, 1e-4);
        EXPECT_NEAR(bend.angle, pi / 2, 1e-4);
        EXPECT_TRUE(bend.laid) << bend.why_not;
    }
    const double by_bends =
        2 * (tray.height + pi / 2 * (tray.radius + tray.thickness / 2) - 2 * (tray.radius + tray.thickness));
    const Eigen::Vector2d size =
        session.blank->blank.position.rowwise().maxCoeff() - session.blank->blank.position.rowwise().minCoeff();
    EXPECT_NEAR(size.maxCoeff(), tray.length + by_bends, 1e-3);
    EXPECT_NEAR(size.minCoeff(), tray.width + by_bends, 1e-3);
}

TEST_F(PartBends, ASkinThatIsAskedForIsLaidWithItsOwnRadius)
{
    const fs::path file = write(l_bracket());
    for (const auto& [skin, k, words] : {std::tuple(Skin::outer, 1., "outer skin"),
                                         {Skin::inner, 0., "inner skin"},
                                         {Skin::middle, 0.5, "middle surface, K 0.5"}}) {
        ReadOptions read;
        read.skin = skin;
        const Session session = solved(file, {}, read);
        EXPECT_NEAR(rectangle(session).length, 65 + pi / 2 * (3 + k * 2), 1e-6) << words;
        EXPECT_EQ(session.bends->surface, words);
        EXPECT_NEAR(session.bends->bends.at(0).inner_radius, 3, 1e-9) << words;
        EXPECT_NEAR(session.bends->bends[0].k, k, 1e-12);
        if (skin != Skin::middle) {
            EXPECT_THROW(solved(file, constant_k(0.4), read), InputError);
        }
    }
}

TEST_F(PartBends, ArcsOfBothSkinsThatAreUnlikeAreDoubted)
{
    const fs::path file = folder_ / "l.step";
    for (const double outer : {4.4, 5., 6.2}) {
        shapes::write_prism(file, {{0, 0}, {60, 0}, {60, 2}, {2, 2}, {2, 50}, {0, 50}}, 30, {outer, 0, 0, 3});
        const PartFile part = read_part(file);
        ASSERT_TRUE(part.solid);
        const auto arcs = fmt::format("1 bend has arcs of radius {} and 3 mm on both skins of a sheet of 2 mm", outer);
        const auto says = [&](const std::string& doubt) { return doubt.starts_with(arcs); };
        EXPECT_EQ(std::ranges::count_if(part.doubts, says), outer == 5 ? 0 : 1) << outer;
    }
}

TEST_F(PartBends, TheLineOfABendLiesInItsMiddleAndTellsUpFromDown)
{
    BentSolid z = l_bracket();
    z.leg = {20, 30, 25};
    z.bend = {{3, pi / 2}, {1, -pi / 3}};
    const Session session = solved(write(z), constant_k(0.4));
    ASSERT_EQ(session.bends->bends.size(), 2u);
    EXPECT_NE(session.bends->bends[0].up, session.bends->bends[1].up);
    const Rectangle all = rectangle(session);
    EXPECT_NEAR(all.length, z.developed(0.4), 1e-6);
    // Lines are as far apart as the leg and both halves of the strips.
    const BlankSegment &a = session.bends->bends[0].line.at(0), &b = session.bends->bends[1].line.at(0);
    const Eigen::Vector2d along = (a.to - a.from).normalized(), across(along[1], -along[0]);
    const auto& bends = session.bends->bends;
    EXPECT_NEAR(std::abs(across.dot(b.from - a.from)), 30 + (bends[0].allowance + bends[1].allowance) / 2, 1e-6);
    EXPECT_NEAR(std::abs(across.dot(b.to - a.to)), 30 + (bends[0].allowance + bends[1].allowance) / 2, 1e-6);
    // Seen on the blank, the sheet beyond a bend that goes up comes towards the eye: its faces turn
    // to each other there.
    const TriMesh& part = session.part->mesh;
    const Eigen::Matrix3Xd normal = area_vectors(part);
    for (const SheetBend& bend : bends) {
        const Eigen::Vector3d to_eye = normal(Eigen::all, bend.faces).rowwise().sum().normalized();
        double out = 0;
        for (const int f : bend.faces)
            for (const int v : part.triangle.col(f))
                out += to_eye.dot(part.position.col(v) - bend.place);
        EXPECT_EQ(bend.up, out > 0) << "places beside the middle of a hollow bend rise above its tangent plane";
    }
}

TEST_F(PartBends, AFamilyOfBracketsChannelsHatsHemsAndKnucklesUnrollsToItsClosedForm)
{
    const fs::path file = folder_ / "part.step";
    std::map<std::string, int> kinds;
    int refused = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const BentSolid solid = shapes::random_bent_solid(seed);
        shapes::SeededRandom random(seed + 1000);
        const double k = random.between(0.3, 0.5);
        SCOPED_TRACE(fmt::format("{}: {} with {} bends, t {}, K {}{}", seed, solid.kind, solid.bend.size(),
                                 solid.thickness, k, solid.hole ? ", a hole" : ""));
        ++kinds[solid.kind];
        shapes::write_bent_solid(file, solid);
        Session session;
        try {
            session = solved(file, constant_k(k));
        } catch (const Error& error) {
            ADD_FAILURE() << error.what();
            ++refused;
            continue;
        }
        EXPECT_NEAR(session.part->thickness_mm.value_or(0), solid.thickness, 1e-9 * solid.thickness);
        const double length = solid.developed(k);
        const Rectangle outline = rectangle(session);
        EXPECT_NEAR(outline.length, length, 1e-4 * length);
        EXPECT_NEAR(outline.width, solid.width, 1e-4 * solid.width);
        EXPECT_LT(outline.off, 1e-4 * length);
        const auto& bends = session.bends->bends;
        EXPECT_EQ(bends.size(), solid.bend.size());
        for (const shapes::SolidBend& made : solid.bend)
            EXPECT_TRUE(std::any_of(bends.begin(), bends.end(),
                                    [&](const SheetBend& bend) {
                                        return std::abs(bend.inner_radius - made.inner_radius) <
                                                   1e-3 * made.inner_radius &&
                                               std::abs(bend.angle - std::abs(made.angle)) < 1e-3 && bend.laid;
                                    }))
                << "R " << made.inner_radius << ", " << made.angle * 180 / pi << " degrees";
        for (const std::string& note : session.bends->notes)
            ADD_FAILURE() << note;
    }
    EXPECT_EQ(kinds.size(), 6u) << "all kinds were drawn";
}

TEST_F(PartBends, ChordsDoNotShortenABend)
{
    const fs::path file = write(l_bracket());
    for (const double angle : {0.05, 0.35, 1.2}) {
        ReadOptions read;
        read.cad.angle = angle;
        read.cad.deflection = 2; // leaves the angle to decide
        EXPECT_NEAR(rectangle(solved(file, {}, read)).length, 65 + 2 * pi, 1e-6) << angle;
    }
}

TEST_F(PartBends, AMeshHasTheRadiusOfTheCircleThroughItsVertices)
{
    // The solid of the bracket as triangles, that no file says anything of.
    const auto section = shapes::Profile({0, 0}, 0).straight(40).bend(5, -pi / 2).straight(25);
    const shapes::BentSheet sheet = shapes::bent_sheet(section, 30, 2);
    const fs::path file = folder_ / "bracket.obj";
    shapes::write_mesh(file, shapes::thickened(sheet.mesh, -2 * sheet.normal));
    ReadOptions read;
    read.skin = Skin::middle;
    const Session session = solved(file, constant_k(0.44), read);
    ASSERT_EQ(session.bends->bends.size(), 1u);
    const SheetBend& bend = session.bends->bends[0];
    EXPECT_NEAR(bend.inner_radius, 3, 1e-4);
    EXPECT_NEAR(bend.angle, pi / 2, 1e-4);
    EXPECT_FALSE(bend.stated);
    EXPECT_TRUE(bend.laid) << bend.why_not;
    EXPECT_NEAR(rectangle(session).length, 65 + pi / 2 * (3 + 0.88), 1e-3);
}

TEST_F(PartBends, OfMeshesOfSolidsAreFoundHoweverLargeTheirRadius)
{
    // As CAD writes them: single precision, chords of every angle; R/t from 0.2 to 60, legs from a
    // tenth of the radius on.
    shapes::SeededRandom random(29);
    int bends = 0;
    for (int sample = 0; sample < 60; ++sample) {
        const double t = random.between(0.5, 4), k = random.between(0.3, 0.5);
        const int count = 1 + sample % 3, chords = 3 + sample % 9;
        std::vector<shapes::ProfilePiece> profile;
        std::vector<std::pair<double, double>> expected; // inner radius, angle
        double length = 0, sense = 1;
        for (int i = 0; i <= count; ++i) {
            const double r = t * std::exp(random.between(std::log(0.2), std::log(60.)));
            const double angle = random.between(2.2 / chords, 2.2), leg = random.between(0.1, 1) * (r + t) + t;
            profile.push_back({leg, 0, 0});
            length += leg;
            if (i == count)
                break;
            profile.push_back({0, r, sense * angle}); // an S in space, so that nothing meets
            sense = -sense;
            length += angle * (r + k * t);
            expected.emplace_back(r, angle);
        }
        SCOPED_TRACE(fmt::format("sample {}: t {:.4g}, {} bends, {} chords each", sample, t, count, chords));
        const double width = random.between(0.2, 1) * length;
        const fs::path file = folder_ / "part.stl";
        shapes::write_mesh(file,
                           shapes::transformed(shapes::extruded(shapes::sheet_section(profile, t, chords), {}, width),
                                               shapes::random_rotation(std::uint64_t(sample)), {3, -2, 5}));
        const Session session = solved(file, constant_k(k));
        std::vector<std::pair<double, double>> found;
        for (const SheetBend& bend : session.bends->bends) {
            EXPECT_TRUE(bend.laid) << bend.why_not;
            found.emplace_back(bend.inner_radius, bend.angle);
        }
        std::sort(found.begin(), found.end());
        std::sort(expected.begin(), expected.end());
        ASSERT_EQ(found.size(), expected.size());
        for (size_t i = 0; i < found.size(); ++i) {
            EXPECT_NEAR(found[i].first, expected[i].first, 2e-3 * (expected[i].first + t));
            EXPECT_NEAR(found[i].second, expected[i].second, 2e-3 * expected[i].second);
        }
        EXPECT_NEAR(rectangle(session).length, length, 2e-4 * length);
        EXPECT_NEAR(rectangle(session).width, width, 1e-4 * width);
        bends += int(found.size());
    }
    EXPECT_EQ(bends, 120);
}

TEST_F(PartBends, FlatsAroundACircleAreNoCylinder)
{
    // Of sharp folds: three flats of a symmetric channel lie on a circle, and so do those of half a
    // polygon.
    for (const double angle : {0.2, 0.5, 0.9})
        for (const int folds : {2, 3}) {
            std::vector<shapes::ProfilePiece> profile{{30, 0, 0}};
            for (int i = 0; i < folds; ++i) {
                profile.push_back({0, 0.01, angle});
                profile.push_back({30, 0, 0});
            }
            const fs::path file = folder_ / "folded.obj";
            shapes::write_mesh(file, shapes::extruded(shapes::sheet_section(profile, 1, 1), {}, 40));
            const Session session = solved(file);
            for (const SheetBend& bend : session.bends->bends)
                EXPECT_LT(bend.inner_radius, 1) << angle << " " << folds;
        }
}

TEST_F(PartBends, EqualFoldsOfASolidAreNoCylinder)
{
    // Their corners lie on two circles as those of chords do, but farther apart than the flats are
    // thick.
    std::mt19937 draw(57);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(draw); };
    for (int i = 0; i < 20; ++i) {
        const int flats = 3 + int(draw() % 6);
        const double thickness = between(0.5, 2), width = between(8, 12) * thickness, length = between(30, 80),
                     angle = between(10, std::min(40., 300. / flats)) * pi / 180;
        SCOPED_TRACE(fmt::format("{} flats of {:.4g} mm, {:.4g} degrees, {:.3g} mm thick", flats, width,
                                 angle * 180 / pi, thickness));
        const fs::path file = folder_ / "folded.stl";
        shapes::write_mesh(file, shapes::extruded(shapes::folded_section(flats, width, angle, thickness), {}, length));
        const Session session = solved(file);
        EXPECT_NEAR(*session.part->thickness_mm, thickness, 1e-5);
        for (const SheetBend& bend : session.bends->bends)
            EXPECT_LT(bend.inner_radius, thickness) << "a flat with its folds";
        const Eigen::Matrix2Xd& X = session.blank->blank.position;
        const Eigen::Vector2d size = X.rowwise().maxCoeff() - X.rowwise().minCoeff();
        EXPECT_NEAR(size.maxCoeff(), std::max(flats * width, length), 1e-4);
        EXPECT_NEAR(size.minCoeff(), std::min(flats * width, length), 1e-4);
    }
}

TEST_F(PartBends, AlongTheRollingDirectionTheBlankLiesStraight)
{
    BentSolid solid = l_bracket();
    const double length = 65 + 2 * pi, width = rectangle(solved(write(solid))).width;
    for (const Eigen::Vector3d& along :
         {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1)}) {
        Session session;
        session.file = write(solid);
        session.options.flatten.process.rolling = along;
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        session = run_stage(Stage::solve, run_stage(Stage::read, session));
        const Eigen::Matrix2Xd& X = session.blank->blank.position;
        const Eigen::Vector2d size = X.rowwise().maxCoeff() - X.rowwise().minCoeff();
        const SheetBend& bend = session.bends->bends.at(0);
        const bool bend_along_x = std::abs(bend.axis.dot(along)) > 0.5;
        EXPECT_NEAR(size[bend_along_x ? 1 : 0], length, 1e-4) << along.transpose();
        EXPECT_NEAR(size[bend_along_x ? 0 : 1], width, 1e-4) << along.transpose();
    }
}

TEST_F(PartBends, WhatIsNoBendOverACylinderKeepsItsLengthsWithAWord)
{
    const fs::path cone = fs::path(SPIA_SOURCE_DIR) / "../shared/data/cad/drawn_cone_skin.step";
    if (!fs::exists(cone))
        GTEST_SKIP() << "no " << cone;
    ReadOptions read;
    read.cad.keep_triangles = true;
    const Session session = solved(cone, constant_k(0.4), read);
    for (const SheetBend& bend : session.bends->bends)
        EXPECT_FALSE(bend.laid);
    EXPECT_EQ(session.bends->surface, "middle surface, K 0.5");
    const auto said = shortcomings(session);
    EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const std::string& text) {
        return text.find("K factor has no effect") != std::string::npos;
    }));
}

TEST_F(PartBends, WhereAllFoldsAreSharpAKFactorIsNotedWithoutADoubt)
{
    shapes::write_prism(folder_ / "part.step", shapes::folded_section(3, 20, pi / 3, 1), 30);
    const Session session = solved(folder_ / "part.step", constant_k(0.4));
    EXPECT_TRUE(shortcomings(session).empty()) << shortcomings(session).front();
    const auto noted = all_notes(*session.bends);
    ASSERT_EQ(noted.size(), 1u);
    EXPECT_NE(noted[0].find("K factor has no effect"), std::string::npos) << noted[0];
}

TEST_F(PartBends, ABendThatIsNotLaidIsAShortcomingWithItsPlaceAndAWayOut)
{
    BentSolid solid = l_bracket();
    solid.bend = {{0.01, pi / 2}}; // of 2 mm sheet: with this K next to nothing would be left of
                                   // the bend
    const Session session = solved(write(solid), constant_k(0.001));
    ASSERT_EQ(session.bends->bends.size(), 1u);
    const SheetBend& bend = session.bends->bends[0];
    EXPECT_FALSE(bend.laid);
    const auto said = shortcomings(session);
    ASSERT_EQ(
        std::count_if(said.begin(), said.end(), [](const std::string& text) { return text.starts_with("bend 1 "); }),
        1);
    const std::string text =
        *std::find_if(said.begin(), said.end(), [](const std::string& t) { return t.starts_with("bend 1 "); });
    for (const std::string& words :
         {std::string("R 0.01 mm"), std::string("90 degrees"),
          fmt::format("near {:.4g}, {:.4g}, ", bend.place[0], bend.place[1]),
          std::string("is not laid with its allowance"), std::string("give a larger K factor")})
        EXPECT_NE(text.find(words), std::string::npos) << text;
    const std::string inches = in_shown_lengths(text, LengthUnit::inch);
    EXPECT_NE(inches.find(fmt::format("near {:.4g}, ", bend.place[0] / 25.4)), std::string::npos) << inches;
    const Json report = parse_json(report_json(session, {}, 0), "report");
    EXPECT_EQ(report["bend_table"]["bends"][0]["way_out"], "give a larger K factor");
    EXPECT_EQ(report["shortcomings"].size(), said.size());
    EXPECT_TRUE(shortcomings(solved(write(solid))).empty()) << "K 0.5";
}

TEST_F(PartBends, OneWhoseArcsHaveNotOneAxisIsDoubtedOnce)
{
    // 2 sqrt(2) mm thick in its middle.
    shapes::write_prism(folder_ / "part.step", {{0, 0}, {40, 0}, {40, 2}, {2, 2}, {2, 40}, {0, 40}}, 30,
                        {3, 0, 0, 3, 0, 0});
    const auto said = shortcomings(solved(folder_ / "part.step"));
    ASSERT_EQ(said.size(), 1u) << said.back();
    EXPECT_TRUE(said[0].starts_with("1 bend has arcs of radius 3 and 3 mm")) << said[0];
}

TEST_F(PartBends, CasesOfOneBracket)
{
    const fs::path folder = fs::path(SPIA_SOURCE_DIR) / "../shared/cases";
    if (!fs::exists(folder / "05-lbracket.step"))
        GTEST_SKIP() << "no " << folder;
    for (const auto& [k, length] : {std::pair(0.5, 71.283), {0.44, 71.095}, {0.33, 70.749}})
        EXPECT_NEAR(rectangle(solved(folder / "05-lbracket.step", constant_k(k))).length, length, 5e-4) << k;
    const Session right = solved(folder / "02-degree-right.step");
    EXPECT_EQ(right.part->solid->thickness, 2);
}

} // namespace spia::part_bends_test
