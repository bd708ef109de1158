// Shallow marks on the skins of solids of sheet: what is laid flat is the skin without them.
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/support/mesh_file.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/plane_faces.h"
#include "tests/support/seeded_random.h"
#include "tests/support/sheet_solid.h"
#include "tests/unit/exchange/examined_mesh.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::marks_test {
namespace {

using shapes::BentSheet;
using shapes::PlaneLoop;
using shapes::Profile;
using std::numbers::pi;
constexpr double thickness = 2;

/// Bends to both sides. Flats to x = 30 and from about x = 72 on.
BentSheet step_sheet()
{
    return shapes::bent_sheet(
        Profile({0, 0}, 0).straight(30).bend(6, -pi / 2).straight(20).bend(9, pi / 2).straight(40), 60, 2);
}

TriMesh solid_of(const BentSheet& sheet) { return shapes::thickened(sheet.mesh, -thickness * sheet.normal); }

/// Where a mark lies: cells of the sheet by the middle of their outer side.
using Where = std::function<bool(const Eigen::Vector3d&)>;

/// @param depth  mm, below zero: raised
TriMesh marked(const BentSheet& sheet, const TriMesh& solid, const Where& where, double depth, bool inner = false)
{
    const int faces = sheet.mesh.triangles(), vertices = sheet.mesh.vertices();
    std::vector<char> chosen(2 * size_t(faces), 0);
    for (int f = 0; f < faces; ++f) {
        const auto middle = [&](int g) {
            return Eigen::Vector3d(sheet.mesh.position(Eigen::all, sheet.mesh.triangle.col(g)).rowwise().mean());
        };
        chosen[size_t(f + (inner ? faces : 0))] = where((middle(f) + middle(f ^ 1)) / 2);
    }
    Eigen::Matrix3Xd way = Eigen::Matrix3Xd::Zero(3, solid.vertices());
    way.leftCols(vertices) = -depth * sheet.normal;
    way.middleCols(vertices, vertices) = depth * sheet.normal;
    for (int v = 2 * vertices; v < solid.vertices(); ++v) { // of a step before: as the vertex that
                                                            // it was
        Eigen::Index nearest;
        (sheet.mesh.position.colwise() - solid.position.col(v)).colwise().norm().minCoeff(&nearest);
        way.col(v) = -depth * sheet.normal.col(nearest);
    }
    return shapes::stepped(solid, faces, chosen, way);
}

Where box(double x0, double x1, double y0, double y1, double z0 = -1e9)
{
    return [=](const Eigen::Vector3d& p) { return p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1 && p.z() > z0; };
}

/// A solid without marks, examined for each skin.
struct Plain {
    std::map<Skin, PartFile> part;

    Plain(const TriMesh& solid)
    {
        for (const Skin skin : {Skin::outer, Skin::middle, Skin::inner})
            part.emplace(skin, examined(solid, skin));
    }
};

/// The part with marks is the one without.
void expect_same(const Plain& plain, const TriMesh& with_marks, int marks, double depth, double tolerance)
{
    for (const auto& [skin, expected] : plain.part) {
        const PartFile found = examined(with_marks, skin);
        ASSERT_TRUE(expected.solid) << texts_of(expected);
        ASSERT_TRUE(found.solid) << texts_of(found);
        EXPECT_TRUE(found.doctor.healthy());
        EXPECT_NEAR(found.solid->thickness, expected.solid->thickness, tolerance * thickness);
        EXPECT_NEAR(area(found.mesh), area(expected.mesh), tolerance * area(expected.mesh)) << name(skin);
        EXPECT_EQ(found.doctor.boundary_loops, expected.doctor.boundary_loops);
        const Finding* finding = found.doctor.find(Fault::mark);
        ASSERT_TRUE(finding) << texts_of(found);
        EXPECT_EQ(finding->severity, Severity::note);
        EXPECT_EQ(finding->count, marks) << finding->text;
        EXPECT_EQ(int(finding->place.size()), marks);
        EXPECT_NE(finding->text.find(fmt::format("{:.4g} mm", depth)), std::string::npos) << finding->text;
        EXPECT_TRUE(found.doubts.empty());
    }
}

/// A plate with words cut into its upper side: L, an O with its island, T.
TriMesh plate_with_text(double depth)
{
    const double z = 3;
    const auto lifted = [](const PlaneLoop& loop, double at, bool reversed) {
        shapes::Loop result;
        for (const Eigen::Vector2d& p : loop)
            result.emplace_back(p.x(), p.y(), at);
        if (reversed)
            std::reverse(result.begin(), result.end());
        return result;
    };
    const PlaneLoop l = {{10, 10}, {18, 10}, {18, 12}, {12, 12}, {12, 24}, {10, 24}};
    const PlaneLoop t = {{50, 10}, {52, 10}, {52, 22}, {56, 22}, {56, 24}, {46, 24}, {46, 22}, {50, 22}};
    const PlaneLoop o = shapes::circle({32, 17}, 7, 32, false), island = shapes::circle({32, 17}, 5, 28, false);
    const PlaneLoop outline = {{0, 0}, {70, 0}, {70, 36}, {0, 36}};
    shapes::PlaneFaces faces;
    faces.add(lifted(outline, z, false), {lifted(l, z, true), lifted(t, z, true), lifted(o, z, true)});
    faces.add(lifted(outline, 0, true));
    for (size_t i = 0; i < outline.size(); ++i) {
        const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
        faces.add({{a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {b.x(), b.y(), z}, {a.x(), a.y(), z}});
    }
    faces.add(lifted(l, z - depth, false));
    faces.add(lifted(t, z - depth, false));
    faces.add(lifted(o, z - depth, false), {lifted(island, z - depth, true)});
    faces.add(lifted(island, z, false));
    for (const auto& [loop, outside] : {std::pair(l, false), {t, false}, {o, false}, {island, true}})
        for (size_t i = 0; i < loop.size(); ++i) {
            const Eigen::Vector2d &a = loop[i], &b = loop[(i + 1) % loop.size()];
            shapes::Loop wall = {
                {a.x(), a.y(), z - depth}, {b.x(), b.y(), z - depth}, {b.x(), b.y(), z}, {a.x(), a.y(), z}};
            if (!outside)
                std::reverse(wall.begin(), wall.end());
            faces.add(wall);
        }
    return faces.mesh();
}

} // namespace

TEST(Marks, OnFlatsAndAcrossBendsAreTakenOutOfTheSkin)
{
    const BentSheet sheet = step_sheet();
    const TriMesh solid = solid_of(sheet);
    const Plain plain(solid);
    const std::vector<std::pair<const char*, Where>> places = {
        {"on a flat", box(8, 20, 20, 40)},
        {"across a bend", box(22, 60, 16, 30, -12)},
        {"near the rim", box(2, 12, 2, 8)},
        {"an L of cells", [](const Eigen::Vector3d& p) {
             return p.x() < 26 &&
                    ((p.x() > 6 && p.x() < 10 && p.y() > 8 && p.y() < 50) || (p.x() > 6 && p.y() > 8 && p.y() < 12));
         }}};
    for (const auto& [where, cells] : places)
        for (const double depth : {0.005, 0.39, -0.1})
            for (const bool inner : {false, true}) {
                SCOPED_TRACE(fmt::format("{}, {} mm, {} side", where, depth, inner ? "lower" : "upper"));
                const TriMesh with = marked(sheet, solid, cells, depth, inner);
                ASSERT_TRUE(boundary_loops(with).empty());
                // floors over bends follow their chords
                expect_same(plain, with, 1, std::abs(depth), 5e-6);
            }
}

TEST(Marks, ThatReachTheRimAndTinyStepsAreTakenOut)
{
    const BentSheet sheet = step_sheet();
    const TriMesh solid = solid_of(sheet);
    const Plain plain(solid);
    for (const double depth : {0.02, 0.3, -0.3})
        for (const auto& [where, cells] : {std::pair<const char*, Where>{"a groove to the rim", box(10, 16, -1, 30)},
                                           {"a groove across the sheet", box(10, 16, -1, 61)},
                                           {"a corner", box(-1, 9, -1, 9)},
                                           {"a step of the whole side", box(-1, 20, -1, 61)}}) {
            SCOPED_TRACE(fmt::format("{}, {} mm", where, depth));
            expect_same(plain, marked(sheet, solid, cells, depth), 1, std::abs(depth), 1e-9);
        }
}

TEST(Marks, ThatAreALevelBorderOfFewTrianglesAreTakenOut)
{
    // As CAD systems give a rebate: no vertex of its floor is off the rim.
    shapes::SeededRandom random(29);
    for (int sample = 0; sample < 24; ++sample) {
        const double t = random.between(1, 5), wide = random.between(60, 120), along = random.between(30, 90),
                     floor = random.between(0.8, 6) * t, depth = random.between(0.01, 0.19) * t;
        SCOPED_TRACE(fmt::format("sheet of {:.4g} mm, {:.4g} wide, {:.4g} deep", t, floor, depth));
        const TriMesh plain = shapes::extruded({{0, 0}, {wide, 0}, {wide, t}, {0, t}}, {}, along),
                      rebated = shapes::extruded(
                          {{0, 0}, {wide, 0}, {wide, t}, {floor, t}, {floor, t - depth}, {0, t - depth}}, {}, along);
        expect_same(plain, shapes::transformed(rebated, shapes::random_rotation(std::uint64_t(sample)), {3, -2, 9}), 1,
                    depth, 1e-9);
    }
}

TEST(Marks, SeveralAndThoseWithTwoDepthsAreTakenOut)
{
    const BentSheet sheet = step_sheet();
    const TriMesh solid = solid_of(sheet);
    const Plain plain(solid);
    const TriMesh three =
        marked(sheet, marked(sheet, marked(sheet, solid, box(4, 10, 10, 20), 0.1), box(14, 24, 30, 50), -0.2),
               box(80, 90, 10, 40), 0.3, true);
    expect_same(plain, three, 3, 0.3, 1e-9);
    // A pocket in a pocket.
    const TriMesh twice = marked(sheet, marked(sheet, solid, box(4, 26, 10, 50), 0.1), box(8, 20, 20, 40), 0.2);
    expect_same(plain, twice, 1, 0.3, 1e-9);
}

TEST(Marks, AreTheSameTurnedAndRenumbered)
{
    const BentSheet sheet = step_sheet();
    const TriMesh solid = solid_of(sheet), with = marked(sheet, solid, box(22, 60, 16, 30, -12), 0.1);
    const Plain plain(solid);
    for (const std::uint64_t seed : {1, 2, 3}) {
        const TriMesh other =
            shapes::permuted(shapes::transformed(with, shapes::random_rotation(seed), {100, -20, 7}), seed).mesh;
        expect_same(plain, other, 1, 0.1, 5e-6);
    }
}

TEST(Marks, TextOfFewLongTrianglesIsPassedOver)
{
    const TriMesh plain = shapes::extruded({{0, 0}, {70, 0}, {70, 36}, {0, 36}}, {}, 3);
    for (const double depth : {0.01, 0.2, 0.5, -0.2})
        for (const int divisions : {0, 2})
            expect_same(plain, shapes::divided(plate_with_text(depth), divisions), 3, std::abs(depth), 1e-9);
    ScratchFolder folder;
    shapes::write_mesh(folder / "text.stl", plate_with_text(0.2));
    const PartFile part = read_part(folder / "text.stl");
    ASSERT_TRUE(part.solid);
    EXPECT_NEAR(area(part.mesh), 70 * 36, 1e-3);
    EXPECT_TRUE(part.doctor.find(Fault::mark));
}

TEST(Marks, OutlinesLieOnTheSurfaceThatIsTaken)
{
    // of the plate's skins; the text is on the upper one, which is the outer or the inner one
    const double height[] = {3, 1.5, 0};
    for (const int divisions : {0, 2})
        for (const Skin skin : {Skin::outer, Skin::middle, Skin::inner}) {
            const PartFile part = examined(shapes::divided(plate_with_text(0.3), divisions), skin);
            ASSERT_TRUE(part.solid) << texts_of(part);
            std::vector<double> areas;
            for (const auto& [mark, label] : part.solid->marks) {
                EXPECT_EQ(label.kind, MarkLabel::Kind::mark);
                EXPECT_NE(label.outer, label.inner);
                if (skin != Skin::middle) {
                    EXPECT_EQ(skin == Skin::outer ? label.outer : label.inner, part.mesh.position(2, 0) == height[0]);
                }
                ASSERT_EQ(mark.col(0), mark.rightCols<1>()) << "closed";
                const double z = skin == Skin::middle ? height[1] : part.mesh.position(2, 0);
                EXPECT_LT((mark.row(2).array() - z).abs().maxCoeff(), 1e-12);
                double area = 0;
                for (Eigen::Index k = 0; k + 1 < mark.cols(); ++k)
                    area += (mark(0, k) * mark(1, k + 1) - mark(1, k) * mark(0, k + 1)) / 2;
                areas.push_back(std::abs(area));
            }
            std::sort(areas.begin(), areas.end());
            ASSERT_EQ(areas.size(), 4u) << "L, T, O and its island";
            const double expected[] = {40, 44, 14 * 25 * std::sin(2 * pi / 28), 16 * 49 * std::sin(2 * pi / 32)};
            for (size_t k = 0; k < 4; ++k)
                EXPECT_NEAR(areas[k], expected[k], 1e-9) << name(skin);
        }
    // A groove from the rim ends there, and runs around a bend.
    const BentSheet sheet = step_sheet();
    const PartFile part = examined(marked(sheet, solid_of(sheet), box(10, 16, -1, 30), 0.2), Skin::outer);
    ASSERT_TRUE(part.solid);
    ASSERT_EQ(part.solid->marks.size(), 1u);
    const Eigen::Matrix3Xd& mark = part.solid->marks[0].point;
    EXPECT_EQ(mark(1, 0), 0);
    EXPECT_EQ(mark(1, mark.cols() - 1), 0);
    double length = 0;
    for (Eigen::Index k = 0; k + 1 < mark.cols(); ++k)
        length += (mark.col(k + 1) - mark.col(k)).norm();
    EXPECT_NEAR(length, 6 + 2 * 30, 2 * 2) << "to the nearest cells";
}

TEST(Marks, OfAnyOutlineInPlaneSkinAreTakenOut)
{
    // Floors and tops with vertices of their own, as meshers make them along curved walls: foot and
    // top of a wall do not match.
    shapes::SeededRandom random(7);
    for (int sample = 0; sample < 40; ++sample) {
        const double depth = random.between(0.2, 0.59) * (sample % 2 ? 1 : -1), z = 3;
        const int tops = 60 + sample, feet = 50 + (7 * sample) % 41;
        const auto petal = [&](double angle) { return 8 + 3 * std::sin(3 * angle) + 2 * std::cos(5 * angle); };
        const auto loop = [&](int count, double at, double turned) {
            shapes::Loop result;
            for (int i = 0; i < count; ++i) {
                const double angle = 2 * pi * (i + turned) / count;
                result.emplace_back(35 + petal(angle) * std::cos(angle), 18 + petal(angle) * std::sin(angle), at);
            }
            return result;
        };
        const shapes::Loop top = loop(tops, z, 0), foot = loop(feet, z - depth, 0.3);
        const auto reversed = [](shapes::Loop l) {
            std::reverse(l.begin(), l.end());
            return l;
        };
        const shapes::Loop upper = {{0, 0, z}, {70, 0, z}, {70, 36, z}, {0, 36, z}},
                           lower = {{0, 0, 0}, {0, 36, 0}, {70, 36, 0}, {70, 0, 0}};
        shapes::PlaneFaces faces;
        faces.add(upper, {reversed(top)});
        faces.add(lower);
        for (size_t i = 0; i < 4; ++i) {
            const Eigen::Vector3d &a = upper[i], &b = upper[(i + 1) % 4];
            faces.add({{a.x(), a.y(), 0}, {b.x(), b.y(), 0}, b, a});
        }
        faces.add(foot);
        // The wall: from one loop to the other, whichever comes next around.
        for (int i = 0, j = 0; i < tops || j < feet;)
            if (j == feet || (i < tops && (i + 1.) / tops <= (j + 1.3) / feet)) {
                faces.add({top[size_t(i)], top[size_t((i + 1) % tops)], foot[size_t(j % feet)]});
                ++i;
            } else {
                faces.add({foot[size_t((j + 1) % feet)], foot[size_t(j)], top[size_t(i % tops)]});
                ++j;
            }
        SCOPED_TRACE(fmt::format("{} corners above, {} below, {} mm", tops, feet, depth));
        const PartFile part = examined(faces.mesh());
        ASSERT_TRUE(part.solid) << texts_of(part);
        EXPECT_TRUE(part.doctor.healthy()) << texts_of(part);
        EXPECT_EQ(part.doctor.boundary_loops, 1);
        EXPECT_NEAR(part.solid->thickness, z, 1e-9);
        EXPECT_NEAR(area(part.mesh), 70 * 36, 1e-9);
        const Finding* finding = part.doctor.find(Fault::mark);
        ASSERT_TRUE(finding) << texts_of(part);
        EXPECT_NE(finding->text.find(fmt::format("{:.4g} mm {}", std::abs(depth), depth > 0 ? "deep" : "high")),
                  std::string::npos)
            << finding->text;
    }
}

TEST(Marks, JustTooDeepOnesInAMeshAreRefusedAsInASolid)
{
    const BentSheet sheet = step_sheet();
    const TriMesh solid = solid_of(sheet);
    EXPECT_TRUE(examined(marked(sheet, solid, box(8, 20, 20, 40), 0.399)).doctor.healthy());
    for (const double depth : {0.405, 1., 1.8}) {
        const PartFile part = examined(marked(sheet, solid, box(8, 20, 20, 40), depth));
        EXPECT_FALSE(part.solid);
        EXPECT_FALSE(part.doctor.healthy()) << "not cut open as a hollow body: " << texts_of(part);
        EXPECT_TRUE(part.seam.empty());
    }
}

/// A plate with a pocket in its upper side.
TriMesh pocketed_plate(double length, double width, double z, double depth)
{
    const auto box = [](double x0, double x1, double y0, double y1, double at) {
        return shapes::Loop{{x0, y0, at}, {x1, y0, at}, {x1, y1, at}, {x0, y1, at}};
    };
    const auto reversed = [](shapes::Loop l) {
        std::reverse(l.begin(), l.end());
        return l;
    };
    const shapes::Loop upper = box(0, length, 0, width, z), lower = box(0, length, 0, width, 0);
    const shapes::Loop top = box(0.3 * length, 0.5 * length, 0.3 * width, 0.6 * width, z);
    shapes::Loop floor = top;
    for (auto& corner : floor)
        corner[2] -= depth;
    shapes::PlaneFaces faces;
    faces.add(upper, {reversed(top)});
    faces.add(reversed(lower));
    faces.add(floor);
    for (size_t i = 0; i < 4; ++i) {
        const size_t j = (i + 1) % 4;
        faces.add({lower[i], lower[j], upper[j], upper[i]});
        faces.add({floor[j], floor[i], top[i], top[j]});
    }
    return faces.mesh();
}

TEST(Marks, APocketInAThickPlateIsNoHollowBody)
{
    // So thick that without the pocket it would be asked whether it is a closed box; with it only a
    // plate can be meant.
    const ScratchFolder folder;
    shapes::write_mesh(folder / "plate.stl", pocketed_plate(100, 60, 3, 0.5));
    EXPECT_TRUE(read_part(folder / "plate.stl").solid);
    for (const double depth : {0.7, 1., 2.}) {
        shapes::write_mesh(folder / "plate.stl", pocketed_plate(100, 60, 3, depth));
        const PartFile part = examine_part(folder / "plate.stl");
        EXPECT_FALSE(part.doctor.healthy()) << "not cut open as a hollow body: " << texts_of(part);
        EXPECT_TRUE(part.seam.empty());
        EXPECT_NE(texts_of(part).find(fmt::format("{:.4g} mm off", depth)), std::string::npos) << texts_of(part);
    }
}

TEST(Marks, DeeperOnesAreRefusedWithTheirDepth)
{
    const BentSheet sheet = step_sheet();
    const TriMesh solid = solid_of(sheet);
    for (const double depth : {0.45, 0.6, -0.5}) {
        const PartFile part = examined(marked(sheet, solid, box(8, 20, 20, 40), depth), Skin::outer);
        EXPECT_FALSE(part.doctor.healthy());
        const std::string why = texts_of(part);
        EXPECT_NE(why.find(fmt::format("{:.4g} mm off", std::abs(depth))), std::string::npos) << why;
        EXPECT_NE(why.find("0.4 mm"), std::string::npos) << why;
    }
}

TEST(Marks, ChamfersAndHolesAreNone)
{
    const BentSheet sheet = shapes::without(
        step_sheet(), [](const Eigen::Vector3d& p) { return p.x() > 10 && p.x() < 16 && p.y() > 20 && p.y() < 30; });
    const PartFile part = examined(solid_of(sheet), Skin::outer);
    ASSERT_TRUE(part.solid);
    EXPECT_FALSE(part.doctor.find(Fault::mark));
    EXPECT_EQ(part.doctor.boundary_loops, 2);
}

// ../shared/cases, K3.
TEST(SharedCases, ShallowMarksArePassedOver)
{
    const std::filesystem::path cases = std::filesystem::path(SPIA_SOURCE_DIR) / "../shared/cases";
    if (!std::filesystem::exists(cases / "01-mark-none.step"))
        GTEST_SKIP() << "no " << cases;
    for (const Skin skin : {Skin::outer, Skin::middle}) {
        ReadOptions options;
        options.skin = skin;
        const PartFile plain = read_part(cases / "01-mark-none.step", options);
        EXPECT_NEAR(area(plain.mesh), (skin == Skin::outer ? 91.0 : 87.85) * 40, 1e-3 * 91 * 40);
        for (const char* file : {"01-mark-0.01.step", "01-mark-0.2.step"}) {
            const PartFile part = read_part(cases / file, options);
            ASSERT_TRUE(part.solid) << texts_of(part);
            EXPECT_NEAR(part.solid->thickness, 4, 4e-6);
            EXPECT_NEAR(area(part.mesh), area(plain.mesh), 1e-6 * area(plain.mesh));
            ASSERT_TRUE(part.doctor.find(Fault::mark));
            EXPECT_EQ(part.doctor.find(Fault::mark)->count, 1);
        }
    }
}

} // namespace spia::marks_test
