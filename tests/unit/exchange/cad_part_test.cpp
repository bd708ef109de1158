#include <algorithm>
#include <atomic>
#include <chrono>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <random>
#include <set>

#include "engine/core/error.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/cad/write_iges.h"
#include "engine/exchange/cad/write_step.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/doctor/weld.h"
#include "engine/mesh/topology.h"
#include "engine/options/option.h"
#include "tests/support/known_surfaces.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::cad_part_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using surfaces::bilinear;

const fs::path cad_folder = fs::path(SPIA_SOURCE_DIR) / "../shared/data/cad";
using std::numbers::pi;

NurbsSurface rectangle(double x0, double x1, double y0, double y1)
{
    return bilinear({x0, y0, 0}, {x1, y0, 0}, {x0, y1, 0}, {x1, y1, 0});
}

constexpr double radius = 50, height = 80;

NurbsSurface cylinder(double from, double to) { return surfaces::cylinder(radius, height, from, to); }

/// A quarter cylinder in two faces.
std::vector<NurbsSurface> quarter_cylinder() { return {cylinder(0, pi / 4), cylinder(pi / 4, pi / 2)}; }

/// 5 x 4 squares of 20 mm, every second row moved by half a square, 0.05 mm apart; one of them 0.08
/// mm more to the left.
std::vector<NurbsSurface> gappy_bricks()
{
    std::vector<NurbsSurface> bricks;
    for (int row = 0; row < 4; ++row)
        for (int k = 0; k <= 5; ++k) {
            const double shift = row % 2 * 10.0;
            double x0 = std::max(0.0, 20 * (k - 1) + shift), x1 = std::min(100.0, 20 * k + shift);
            if (x1 <= x0)
                continue;
            x0 += x0 > 0 ? 0.025 : 0;
            x1 -= x1 < 100 ? 0.025 : 0;
            if (row == 2 && k == 3) // the one from 40 to 60
                x0 += 0.03;
            bricks.push_back(rectangle(x0, x1, 20 * row + (row > 0 ? 0.025 : 0), 20 * row + (row < 3 ? 19.975 : 20)));
        }
    return bricks;
}

void expect_quarter_cylinder(const CadContent& cad, double deflection)
{
    ASSERT_GT(cad.soup.polygons(), 0);
    double least = radius;
    for (int t = 0; t < cad.soup.polygons(); ++t) {
        const auto corner = cad.soup.polygon(t);
        Vector3d middle = Vector3d::Zero();
        for (size_t k = 0; k < 3; ++k) {
            const Vector3d& p = cad.soup.position[size_t(corner[k])];
            const Vector3d half = (p + cad.soup.position[size_t(corner[(k + 1) % 3])]) / 2;
            EXPECT_NEAR(p.head<2>().norm(), radius, 1e-9);
            least = std::min(least, half.head<2>().norm());
            middle += p / 3;
        }
        EXPECT_EQ(cad.face[size_t(t)], std::atan2(middle.y(), middle.x()) > pi / 4);
    }
    EXPECT_GE(least, radius - deflection * 1.01);
    EXPECT_LE(least, radius - deflection / 20) << "far finer than was asked for";
}

class OwnCadFile : public testing::TestWithParam<const char*> {
protected:
    void write(const fs::path& path, const std::vector<NurbsSurface>& surfaces, LengthUnit unit = LengthUnit::mm)
    {
        if (path.extension() == ".step")
            write_step(path, surfaces, "part", unit);
        else
            write_iges(path, surfaces, "part", unit);
    }
    ScratchFolder folder_;
    fs::path file_ = folder_ / (std::string("a part") + GetParam());
};

} // namespace

TEST_P(OwnCadFile, ComesBackWithinTheDeflectionAsOneSheet)
{
    write(file_, quarter_cylinder());
    for (const double deflection : {0.3, 0.05, 0.005}) {
        ReadOptions options;
        options.cad.deflection = deflection;
        testing::internal::CaptureStdout();
        const CadContent cad = read_cad(file_, options.cad);
        const PartFile part = read_part(file_, options);
        EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
        expect_quarter_cylinder(cad, deflection);
        EXPECT_EQ(part.doctor.boundary_loops, 1);
        EXPECT_EQ(part.doctor.components, 1);
        // An arc's polygon is shorter than it by a part 2/3 sag/radius at most, so is the area.
        const double exact = radius * pi / 2 * height;
        EXPECT_LT(area(part.mesh), exact);
        EXPECT_GT(area(part.mesh), exact * (1 - deflection / radius));
        ASSERT_TRUE(part.cad);
        EXPECT_EQ(part.cad->faces, 2);
        EXPECT_EQ(int(part.cad->face.size()), part.file_faces);
    }
}

TEST_P(OwnCadFile, HasThePointsOfACommonEdgeOnce)
{
    std::vector<NurbsSurface> storeys(2, cylinder(0, pi / 2)); // with an arc between them
    storeys[1].control.row(2).array() += height;
    write(file_, storeys);
    const CadContent cad = read_cad(file_);
    const Weld twice = weld(cad.soup, 1e-6);
    EXPECT_EQ(twice.exact + twice.near, 0);
}

TEST_P(OwnCadFile, IsInMillimetresWhateverItsUnit)
{
    for (const LengthUnit unit : {LengthUnit::mm, LengthUnit::inch, LengthUnit::m}) {
        write(file_, quarter_cylinder(), unit);
        const PartFile part = read_part(file_);
        EXPECT_NEAR(part.mesh.position.row(2).maxCoeff(), height, 1e-6) << name(unit);
        EXPECT_NEAR(part.mesh.position.row(0).maxCoeff(), radius, 1e-6) << name(unit);
        ReadOptions twice;
        twice.unit = LengthUnit::inch;
        EXPECT_THROW(read_part(file_, twice), InputError);
    }
}

TEST_P(OwnCadFile, GivesTheFacesThatAreWanted)
{
    write(file_,
          {rectangle(0, 10, 0, 10), rectangle(10, 30, 0, 10), rectangle(30, 60, 0, 10), rectangle(60, 100, 0, 10)});
    const auto taken = [&](const std::vector<std::string>& wanted) {
        ReadOptions options;
        options.parts = wanted;
        return area(read_part(file_, options).mesh);
    };
    EXPECT_NEAR(taken({}), 1000, 1e-6);
    EXPECT_NEAR(taken({"2"}), 300, 1e-6);
    EXPECT_NEAR(taken({"1-2"}), 500, 1e-6);
    EXPECT_NEAR(taken({"3", "1-2", "2"}), 900, 1e-6);
    for (const char* wrong : {"4", "-1", "2-1", "1-", "x", "", "1 2", "0-4", "99999999999"})
        EXPECT_THROW(taken({wrong}), InputError) << wrong;
}

TEST_P(OwnCadFile, StopsWhenAskedAtEveryStageAndLeavesTheNextOneFree)
{
    write(file_, gappy_bricks());
    std::vector<std::string> stages;
    read_cad(file_, {}, {}, {}, Progress([&](double, std::string_view step) {
                 if (stages.empty() || stages.back() != step)
                     stages.emplace_back(step);
             }));
    EXPECT_GE(std::set<std::string>(stages.begin(), stages.end()).size(), 5u);
    for (const std::string& stage : std::set<std::string>(stages.begin(), stages.end())) {
        const auto stop = std::make_shared<std::atomic<bool>>(false);
        const Progress progress([&](double, std::string_view step) { *stop = *stop || step == stage; }, stop);
        EXPECT_THROW(read_cad(file_, {}, {}, {}, progress), Cancelled) << stage;
    }
    EXPECT_NO_THROW(read_cad(file_));
}

INSTANTIATE_TEST_SUITE_P(Formats, OwnCadFile, testing::Values(".step", ".IGS"),
                         [](const auto& ending) { return std::string(ending.param).substr(1); });

TEST(CadSewing, ClosesTheGapsOfABrickWallAndTellsTheWidest)
{
    const ScratchFolder folder;
    write_iges(folder / "wall.igs", gappy_bricks());
    const PartFile part = read_part(folder / "wall.igs");
    EXPECT_EQ(part.doctor.components, 1);
    EXPECT_EQ(part.doctor.boundary_loops, 1);
    EXPECT_NEAR(area(part.mesh), 8000, 8000 * 0.05 / 20);
    EXPECT_GT(part.cad->sewing_tolerance, 0.08); // the widest
    EXPECT_LT(part.cad->sewing_tolerance, 0.2);  // all are closed by then

    const CadContent cad = read_cad(folder / "wall.igs");
    ASSERT_FALSE(cad.gaps.empty());
    const CadGap& widest = cad.gaps.front();
    EXPECT_GE(widest.width, 0.08 - 1e-6);
    EXPECT_LE(widest.width, std::hypot(0.08, 0.05) + 1e-6); // ends of borders are also apart along
                                                            // them
    EXPECT_NEAR(widest.place.x(), 40, 0.1);
    EXPECT_GT(widest.place.y(), 40 - 0.1);
    EXPECT_LT(widest.place.y(), 60 + 0.1);
    const Finding* told = part.doctor.find(Fault::gap);
    ASSERT_TRUE(told);
    EXPECT_EQ(told->severity, Severity::repaired);
    EXPECT_LT((part.mesh.position.col(told->first) - widest.place).norm(), 21);
    ASSERT_EQ(told->place.size(), size_t(told->count));
    ASSERT_EQ(told->what.size(), told->place.size());
    EXPECT_EQ(told->what[0],
              fmt::format("{:.3g} mm, CAD faces {} and {}", widest.width, widest.face[0], widest.face[1]));

    ReadOptions loose;
    loose.cad.sewing_tolerance = 0.01;
    EXPECT_GT(examine_part(folder / "wall.igs", loose).doctor.components, 1);
    loose.cad.sewing_tolerance = -1;
    EXPECT_THROW(examine_part(folder / "wall.igs", loose), InputError);
}

TEST(CadSewing, NamesPiecesByTheirFaces)
{
    const ScratchFolder folder;
    write_iges(folder / "two.igs",
               std::vector{rectangle(0, 10, 0, 10), rectangle(50, 80, 0, 10), rectangle(80, 90, 0, 10)});
    const PartFile both = examine_part(folder / "two.igs");
    const Finding* pieces = both.doctor.find(Fault::several_components);
    ASSERT_TRUE(pieces);
    EXPECT_EQ(pieces->severity, Severity::fatal);
    const std::string advice = command_line_text(pieces->advice);
    EXPECT_NE(advice.find("keep the largest (--keep-largest), or choose the CAD faces of one piece (--part): 1-2 (4 "
                          "triangles, 40 x 10 x 0 mm) or 0 (2 "),
              std::string::npos)
        << advice;
    ReadOptions largest;
    largest.doctor.keep_largest = true;
    const PartFile kept = read_part(folder / "two.igs", largest);
    EXPECT_NEAR(area(kept.mesh), 400, 1e-9);
    EXPECT_NE(kept.doctor.find(Fault::several_components)->text.find("leaves out CAD faces 0"), std::string::npos);
    ReadOptions chosen;
    chosen.parts = {"1-2"};
    EXPECT_NEAR(area(read_part(folder / "two.igs", chosen).mesh), 400, 1e-9);
}

TEST(CadSewing, NeverClosesMoreThanHalfTheShortestEdge)
{
    const ScratchFolder folder;
    write_iges(folder / "gap.igs", std::vector{rectangle(0, 10, 0, 0.4), rectangle(10.3, 20, 0, 0.4)});
    const CadContent cad = read_cad(folder / "gap.igs"); // 0.5 would close it, and collapse both
    EXPECT_NEAR(cad.shortest_edge, 0.4, 1e-6);
    EXPECT_EQ(cad.free_after, 8);
    EXPECT_TRUE(cad.gaps.empty());
    write_iges(folder / "gap.igs", std::vector{rectangle(0, 10, 0, 4), rectangle(10.3, 20, 0, 4)});
    EXPECT_EQ(read_cad(folder / "gap.igs").free_after, 6);
}

TEST(CadSewing, LooksPastATinyEdge)
{
    const ScratchFolder folder;
    std::vector<NurbsSurface> wall = gappy_bricks(); // 88 edges, one of which gets a corner cut off
    NurbsSurface& corner = wall.front();
    corner = bilinear(corner.control.col(0), corner.control.col(0) + Vector3d(0.01, 0, 0), corner.control.col(2),
                      corner.control.col(3));
    wall.push_back(bilinear(wall.front().control.col(1), Vector3d(19.975, 0, 0), wall.front().control.col(3),
                            Vector3d(19.975, 19.975, 0)));
    write_iges(folder / "wall.igs", wall);
    const CadContent cad = read_cad(folder / "wall.igs");
    EXPECT_NEAR(cad.shortest_edge, 0.01, 1e-6);
    EXPECT_GT(cad.sewing_tolerance, 0.08);
    EXPECT_EQ(examine_part(folder / "wall.igs").doctor.components, 1);
}

TEST(CadSewing, KeepsAThinFace)
{
    const ScratchFolder folder;
    std::vector<NurbsSurface> wall = gappy_bricks();
    wall.push_back(rectangle(200, 240, 0, 0.2)); // its sides are as near as a gap, but they are its
                                                 // own
    write_iges(folder / "wall.igs", wall);
    const CadContent cad = read_cad(folder / "wall.igs");
    EXPECT_GT(cad.sewing_tolerance, 0.08);
    EXPECT_LT(cad.sewing_tolerance, 0.2);
    EXPECT_TRUE(cad.slivers.empty());
    EXPECT_EQ(cad.face.back(), int(wall.size()) - 1);
}

TEST(CadSewing, LeavesSlotsOpenBesideNarrowGaps)
{
    const ScratchFolder folder;
    std::vector<NurbsSurface> strips; // 0.002 mm apart, but for a slot of 0.3 mm
    double x = 0;
    for (int k = 0; k < 12; ++k) {
        strips.push_back(rectangle(x, x + 10, 0, 40));
        x += 10 + (k == 5 ? 0.3 : 0.002);
    }
    write_iges(folder / "strips.igs", strips);
    const CadContent cad = read_cad(folder / "strips.igs");
    EXPECT_GE(cad.sewing_tolerance, 0.002);
    EXPECT_LT(cad.sewing_tolerance, 0.1);
    EXPECT_EQ(examine_part(folder / "strips.igs").doctor.components, 2);
}

TEST(CadSewing, LeavesOutFacesThatLieOnOthers)
{
    const ScratchFolder folder;
    NurbsSurface arched = rectangle(0, 20, 0, 20); // the same border, but not the same face
    arched.degree_u = arched.degree_v = 2;
    arched.count_u = arched.count_v = 3;
    arched.knots_u = arched.knots_v = {0, 0, 0, 1, 1, 1};
    arched.control.resize(3, 9);
    arched.weight.setOnes(9);
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            arched.control.col(arched.index(i, j)) = Vector3d(10 * i, 10 * j, i == 1 && j == 1 ? 3 : 0);
    std::vector<NurbsSurface> faces = {rectangle(0, 20, 0, 20), rectangle(20, 40, 0, 20), rectangle(40, 60, 0, 20)};
    faces.push_back(rectangle(20, 40, 0, 20)); // the same as 1
    faces.push_back(rectangle(45, 50, 5, 10)); // within 2
    write_iges(folder / "doubled.igs", faces);
    const CadContent cad = read_cad(folder / "doubled.igs");
    EXPECT_EQ(cad.doubled, (std::vector<std::array<int, 2>>{{3, 1}, {4, 2}}));
    EXPECT_TRUE(cad.unmeshed.empty());
    const PartFile part = read_part(folder / "doubled.igs");
    EXPECT_NEAR(area(part.mesh), 1200, 1e-6);
    ASSERT_TRUE(part.doctor.find(Fault::overlap));
    EXPECT_EQ(part.doctor.find(Fault::overlap)->severity, Severity::repaired);
    faces = {rectangle(0, 20, 0, 20), arched};
    write_iges(folder / "pillow.igs", faces);
    EXPECT_TRUE(read_cad(folder / "pillow.igs").doubled.empty());
}

TEST(CadSewing, NamesFacesThatBranchOff)
{
    const ScratchFolder folder;
    write_iges(folder / "branch.igs",
               std::vector{rectangle(-30, -10, 0, 10), rectangle(-10, 0, 0, 10), rectangle(0, 10, 0, 10),
                           bilinear({0, 0, 0}, {0, 0, 8}, {0, 10, 0}, {0, 10, 8})});
    EXPECT_EQ(read_cad(folder / "branch.igs").overlapping, (std::vector{1, 2, 3}));
    ReadOptions without;
    without.parts = {"0-2"};
    const PartFile part = read_part(folder / "branch.igs", without);
    EXPECT_FALSE(part.doctor.find(Fault::overlap));
    EXPECT_NEAR(area(part.mesh), 400, 1e-6);
}

TEST(CadSewing, FindsNoOverlapInTrianglesThatAreSmallerThanTheTolerance)
{
    const ScratchFolder folder;
    write_iges(folder / "sheet.igs", quarter_cylinder());
    const CadOptions fine{.sewing_tolerance = 1, .deflection = 0.0005}; // chords of 0.45 mm
    const CadContent cad = read_cad(folder / "sheet.igs", fine);
    EXPECT_EQ(cad.sewing_tolerance, 1);
    EXPECT_GT(cad.soup.polygons(), 300);
    EXPECT_EQ(cad.overlapping, std::vector<int>());
}

TEST(CadSewing, SaysThatEdgesBoundTheToleranceOnlyIfTheyDo)
{
    const ScratchFolder folder;
    const auto note = [&](std::optional<double> tolerance) {
        ReadOptions options;
        options.cad.sewing_tolerance = tolerance;
        std::string found;
        for (const std::string& each : examine_part(folder / "strips.igs", options).notes)
            if (each.find("half the length of edges") != std::string::npos)
                found = each;
        return found;
    };
    write_iges(folder / "strips.igs", std::vector{rectangle(0, 100, 0, 100), rectangle(100.1, 200, 0, 100)});
    EXPECT_EQ(note({}), "");
    EXPECT_EQ(note(5), "") << "more than is closed unasked, but far from 50 mm";
    write_iges(folder / "strips.igs", std::vector{rectangle(0, 10, 0, 0.4), rectangle(10.17, 20, 0, 0.4)});
    EXPECT_NE(note({}).find("shortest 0.4 mm: small faces may have closed up, and wider gaps"), std::string::npos);
    EXPECT_EQ(note(0.19), "");
    EXPECT_NE(note(0.21), "");
    EXPECT_EQ(note(0.21).find("wider gaps"), std::string::npos);
}

namespace {

/// As shared/data/README.md states; of files without an area it is that of the same surface in
/// another format.
struct KnownCad {
    const char* file;
    int faces, loops;
    double area;
};

void PrintTo(const KnownCad& cad, std::ostream* out) { *out << cad.file; }

class RealCad : public testing::TestWithParam<KnownCad> {};

} // namespace

TEST_P(RealCad, HasTheLoopsAndTheAreaItsOriginStates)
{
    const KnownCad known = GetParam();
    const fs::path file = cad_folder / known.file;
    if (!fs::exists(file))
        GTEST_SKIP() << "no " << file;
    ReadOptions options;
    options.seam.mode = SeamOptions::Mode::none;
    options.cad.deflection = 0.005; // so that the chords of borders and bends take less than 1e-3
                                    // of the area
    options.cad.keep_triangles = true;
    const PartFile part = examine_part(file, options);
    EXPECT_EQ(part.cad->faces, known.faces);
    EXPECT_EQ(part.doctor.components, 1);
    EXPECT_EQ(part.doctor.boundary_loops, known.loops);
    EXPECT_EQ(part.doctor.genus, 0);
    EXPECT_NEAR(area(part.mesh), known.area, known.area * 1e-3);
    EXPECT_EQ(std::set<int>(part.cad->face.begin(), part.cad->face.end()).size(), size_t(known.faces));
    RecordProperty("triangles", part.mesh.triangles());
}

INSTANTIATE_TEST_SUITE_P(Files, RealCad,
                         testing::Values(KnownCad{"fan_bracket_skin.step", 31, 17, 6507.58},
                                         KnownCad{"fan_bracket_skin.igs", 31, 17, 6507.58},
                                         KnownCad{"drawn_cone_skin.step", 26, 3, 36584.63},
                                         KnownCad{"freeform99.brep", 99, 1, 950.7},
                                         KnownCad{"freeform99.stp", 99, 1, 950.7},
                                         KnownCad{"freeform99.igs", 99, 1, 950.7}),
                         [](const auto& cad) {
                             std::string name = cad.param.file;
                             std::replace(name.begin(), name.end(), '.', '_');
                             return name;
                         });

TEST(RealCadModel, CylindersOfIgesAreMeshedAsThoseOfStep)
{
    if (!fs::exists(cad_folder / "fan_bracket_skin.igs"))
        GTEST_SKIP() << "no " << cad_folder;
    const CadContent step = read_cad(cad_folder / "fan_bracket_skin.step"),
                     iges = read_cad(cad_folder / "fan_bracket_skin.igs");
    EXPECT_EQ(iges.soup.polygons(), step.soup.polygons());
    EXPECT_EQ(iges.soup.vertices(), step.soup.vertices());
}

TEST(RealCadModel, NoseIsSewnAndOneSheetWithoutTheFaceThatBranchesOff)
{
    for (const char* name : {"race_car_nose.stp", "race_car_nose.igs"}) {
        if (!fs::exists(cad_folder / name))
            GTEST_SKIP() << "no " << cad_folder / name;
        const CadContent cad = read_cad(cad_folder / name);
        EXPECT_EQ(cad.faces, 141);
        EXPECT_EQ(cad.free_before, 664);
        EXPECT_LE(cad.free_after, 26);
        EXPECT_TRUE(cad.unmeshed.empty());
        EXPECT_FALSE(cad.overlapping.empty());
        ReadOptions without; // the last face, one of three at an edge
        without.parts = {"0-139"};
        without.cad.keep_triangles = true;
        const PartFile part = read_part(cad_folder / name, without);
        EXPECT_EQ(part.doctor.components, 1);
        EXPECT_EQ(part.doctor.boundary_loops, 2);
    }
}

TEST(RealCadModel, CarBodyIsOnePieceWithoutItsDoubledFaces)
{
    if (!fs::exists(cad_folder / "asmo.igs"))
        GTEST_SKIP() << "no " << cad_folder / "asmo.igs";
    const CadContent cad = read_cad(cad_folder / "asmo.igs");
    EXPECT_EQ(cad.doubled, (std::vector<std::array<int, 2>>{{97, 27}, {166, 165}, {238, 237}}));
    EXPECT_EQ(examine_part(cad_folder / "asmo.igs").doctor.components, 2)
        << "the body, and the box of the wind tunnel around it";
}

TEST(RealCadModel, SternOfMetresIsOneSheetDespiteItsTinyEdge)
{
    if (!fs::exists(cad_folder / "ship_stern.igs"))
        GTEST_SKIP() << "no " << cad_folder / "ship_stern.igs";
    const PartFile part = read_part(cad_folder / "ship_stern.igs");
    EXPECT_EQ(part.doctor.components, 1);
    EXPECT_EQ(part.doctor.boundary_loops, 1);
    EXPECT_EQ(part.doctor.genus, 0);
}

TEST(RealCadModel, BrepTakesTheUnitThatIsGiven)
{
    const fs::path file = cad_folder / "freeform99.brep";
    if (!fs::exists(file))
        GTEST_SKIP() << "no " << file;
    ReadOptions inches;
    inches.unit = LengthUnit::inch;
    const PartFile part = read_part(file, inches), plain = read_part(file);
    EXPECT_NEAR(area(part.mesh) / area(plain.mesh), 25.4 * 25.4, 0.5);
    EXPECT_EQ(part.doctor.boundary_loops, 1);
}

TEST(CadPart, SameFileGivesTheSameTriangles)
{
    const ScratchFolder folder;
    write_iges(folder / "wall.igs", gappy_bricks());
    const CadContent a = read_cad(folder / "wall.igs"), b = read_cad(folder / "wall.igs");
    EXPECT_EQ(a.soup.corner, b.soup.corner);
    EXPECT_EQ(a.soup.position, b.soup.position);
}

TEST(CadSewing, AClosedPieceIsNotAdvisedToBeKept)
{
    const ScratchFolder folder;
    const double a = 100;
    write_iges(folder / "boxed.igs", std::vector{bilinear({0, 0, 0}, {0, a, 0}, {a, 0, 0}, {a, a, 0}),
                                                 bilinear({0, 0, a}, {a, 0, a}, {0, a, a}, {a, a, a}),
                                                 bilinear({0, 0, 0}, {a, 0, 0}, {0, 0, a}, {a, 0, a}),
                                                 bilinear({0, a, 0}, {0, a, a}, {a, a, 0}, {a, a, a}),
                                                 bilinear({0, 0, 0}, {0, 0, a}, {0, a, 0}, {0, a, a}),
                                                 bilinear({a, 0, 0}, {a, a, 0}, {a, 0, a}, {a, a, a}),
                                                 bilinear({40, 40, 50}, {60, 40, 50}, {40, 60, 50}, {60, 60, 50})});
    const PartFile part = examine_part(folder / "boxed.igs");
    const Finding* pieces = part.doctor.find(Fault::several_components);
    ASSERT_TRUE(pieces);
    EXPECT_EQ(pieces->advice.find("keep-largest"), std::string::npos) << pieces->advice;
    EXPECT_NE(pieces->advice.find("0-5 (12 triangles, closed, 100 x 100 x 100 mm) or 6 (2 triangles, 20 x 20 x 0 mm)"),
              std::string::npos)
        << pieces->advice;
}

/// Files cut short and with bytes changed: refused or read, but never the end of this program.
TEST(CadPart, DamagedFilesAreRefusedOrReadButNeverCrash)
{
    const ScratchFolder folder;
    std::vector<fs::path> sources = {folder / "own.step", folder / "own.igs"};
    write_step(sources[0], quarter_cylinder());
    write_iges(sources[1], quarter_cylinder());
    if (fs::exists(cad_folder / "freeform99.brep"))
        sources.push_back(cad_folder / "freeform99.brep");
    std::mt19937 random(7);
    for (const fs::path& source : sources) {
        const std::string whole = content_of(source);
        int refused = 0;
        constexpr int files = 30;
        for (int k = 0; k < files; ++k) {
            std::string damaged = whole;
            if (k % 3 == 0)
                damaged.resize(random() % whole.size());
            else
                for (unsigned n = random() % 20 + 1; n > 0; --n)
                    damaged[random() % whole.size()] = "0123456789#(),.$*-E;'"[random() % 21];
            const fs::path file = folder / ("damaged" + source.extension().string());
            put(file, damaged);
            // What takes long is stopped: a damaged number can ask for millions of triangles.
            const auto stop = std::make_shared<std::atomic<bool>>(false);
            const auto start = std::chrono::steady_clock::now();
            const Progress time_limit(
                [&](double, std::string_view) {
                    *stop = std::chrono::steady_clock::now() - start > std::chrono::seconds(2);
                },
                stop);
            try {
                examine_part(file, {}, time_limit);
            } catch (const InputError& error) {
                EXPECT_EQ(std::string(error.what()).find(file.string() + ": "), 0) << error.what();
                if (k % 3 == 0 && source.extension() == ".brep") {
                    EXPECT_NE(std::string(error.what()).find("cut short"), std::string::npos) << error.what();
                }
                ++refused;
            } catch (const Cancelled&) {
            }
        }
        EXPECT_GE(refused, files / 3) << source; // those cut short at least
    }
}

} // namespace spia::cad_part_test
