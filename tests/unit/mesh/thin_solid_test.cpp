#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

#include "engine/mesh/solid/skin.h"
#include "engine/mesh/solid/thin_solid.h"
#include "engine/mesh/topology.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"
#include "tests/support/sheet_solid.h"

namespace spia::thin_solid_test {
namespace {

using shapes::BentSheet;
using shapes::Profile;
using std::numbers::pi;

/// Bends to both sides, so that the outer skin has convex and concave ones.
Profile hat() // heading along x, outer side up
{
    const double r = 8;
    return Profile({-60, 0}, 0)
        .straight(30)
        .bend(r, pi / 2)
        .straight(25)
        .bend(r, -pi / 2)
        .straight(50)
        .bend(r, -pi / 2)
        .straight(30)
        .bend(r, pi / 3)
        .straight(20);
}

Profile flange() { return Profile({0, 0}, 0).straight(40).bend(5, -pi / 2).straight(30); }

BentSheet with_holes(BentSheet sheet)
{
    return shapes::without(std::move(sheet), [](const Eigen::Vector3d& p) {
        return (std::abs(p.y() - 20) < 6 && std::abs(p.x() + 45) < 6) || (std::abs(p.y() - 60) < 8 && p.x() > 20);
    });
}

TriMesh solid_of(const BentSheet& sheet, double thickness)
{
    return shapes::thickened(sheet.mesh, -thickness * sheet.normal);
}

TriMesh middle_of(const BentSheet& sheet, double thickness)
{
    TriMesh middle = sheet.mesh;
    middle.position -= thickness / 2 * sheet.normal;
    return middle;
}

/// The message, "" if none.
std::string refusal(const TriMesh& mesh)
{
    try {
        thin_solid(mesh);
    } catch (const NotASheet& reason) {
        EXPECT_GE(reason.face, 0);
        EXPECT_LT(reason.face, mesh.triangles());
        return reason.what();
    }
    return "";
}

/// @param size of its 12 triangles cut into n * n each
TriMesh box(const Eigen::Vector3d& size, int n)
{
    const TriMesh plate = shapes::rectangle(size.x(), size.y(), n, n);
    Eigen::Matrix3Xd down = Eigen::Matrix3Xd::Zero(3, plate.vertices());
    down.row(2).setConstant(-size.z());
    return shapes::thickened(plate, down);
}

} // namespace

TEST(ThinSolid, FindsThicknessAndSkinsOfBentSheets)
{
    for (const double thickness : {0.3, 1.0, 2.5})
        for (const bool holes : {false, true})
            for (const bool cad : {false, true}) {
                BentSheet sheet = shapes::bent_sheet(hat(), 90, 3);
                if (holes)
                    sheet = with_holes(sheet);
                const TriMesh solid = solid_of(sheet, thickness);
                ThinSolidOptions options;
                if (cad)
                    options.unit = shapes::cad_faces(sheet, solid);
                const ThinSolid found = thin_solid(solid, options);
                const int f = sheet.mesh.triangles();
                // Upper and lower skin of this hat: whichever is larger is the outer one.
                TriMesh lower = sheet.mesh;
                lower.position -= thickness * sheet.normal;
                const double top = area(sheet.mesh), bottom = area(lower);
                const SheetSide first = top > bottom ? SheetSide::outer : SheetSide::inner;
                for (int i = 0; i < solid.triangles(); ++i) {
                    const SheetSide expected = i >= 2 * f                               ? SheetSide::rim
                                               : (i < f) == (first == SheetSide::outer) ? SheetSide::outer
                                                                                        : SheetSide::inner;
                    ASSERT_EQ(found.side[size_t(i)], expected) << i << " of " << f << (cad ? ", CAD" : "");
                }
                EXPECT_NEAR(found.thickness, thickness, 1e-9);
                EXPECT_NEAR(found.outer, std::max(top, bottom), 1e-7);
                EXPECT_NEAR(found.inner, std::min(top, bottom), 1e-7);
                EXPECT_GE(found.least, 0.97 * thickness);
                EXPECT_LE(found.most, 1.001 * thickness);
            }
}

TEST(ThinSolid, MiddleSurfaceLiesHalfwayEverywhere)
{
    for (const double thickness : {0.3, 1.0, 2.5})
        for (const Profile& profile : {hat(), flange()}) {
            const BentSheet sheet = with_holes(shapes::bent_sheet(profile, 90, 3));
            const TriMesh solid = solid_of(sheet, thickness), expected = middle_of(sheet, thickness);
            const ThinSolid found = thin_solid(solid);
            const SkinMesh middle = skin_of(solid, found, Skin::middle);
            ASSERT_EQ(middle.mesh.triangles(), sheet.mesh.triangles());
            double worst = 0;
            for (int v = 0; v < middle.mesh.vertices(); ++v)
                worst = std::max(worst, (middle.mesh.position.col(v) -
                                         expected.position.col(middle.source_vertex[size_t(v)] % sheet.mesh.vertices()))
                                            .norm());
            EXPECT_LT(worst, 1e-6 * thickness);
            EXPECT_NEAR(area(middle.mesh), area(expected), 1e-6 * area(expected));
            // Exact where flat; the chords of a bend lie nearer to each other than its arcs, by 1 -
            // cos of half their angle.
            EXPECT_NEAR(found.volume / thickness, area(middle.mesh), 5e-3 * area(middle.mesh));
        }
}

TEST(ThinSolid, MiddleOfAFlatAnnulusOfHolesIsVolumeOverThickness)
{
    const BentSheet sheet = with_holes(shapes::bent_sheet(Profile({-60, 0}, 0).straight(120), 90, 3));
    const TriMesh solid = solid_of(sheet, 0.7);
    const ThinSolid found = thin_solid(solid);
    EXPECT_NEAR(area(skin_of(solid, found, Skin::middle).mesh), found.volume / 0.7, 1e-8 * found.volume);
    EXPECT_NEAR(found.outer, found.inner, 1e-9 * found.outer);
    EXPECT_EQ(found.side.front(), SheetSide::outer) << "of equal skins the one with the first face";
}

TEST(ThinSolid, MiddleSurfaceEndsHalfwayOnSlantedEdges)
{
    const TriMesh plate = shapes::rectangle(60, 40, 20, 14);
    Eigen::Matrix3Xd inwards(3, plate.vertices());
    for (int v = 0; v < plate.vertices(); ++v) // its outline widens by 0.3 of the thickness
                                               // downwards
        inwards.col(v) << 0.6 * (plate.position(0, v) / 60 - 0.5), 0.6 * (plate.position(1, v) / 40 - 0.5), -1;
    const TriMesh solid = shapes::thickened(plate, inwards);
    const ThinSolid found = thin_solid(solid);
    const SkinMesh middle = skin_of(solid, found, Skin::middle);
    const Eigen::Vector3d size = middle.mesh.position.rowwise().maxCoeff() - middle.mesh.position.rowwise().minCoeff();
    EXPECT_NEAR(size.x(), 60.3, 1e-9);
    EXPECT_NEAR(size.y(), 40.3, 1e-9);
    EXPECT_NEAR(size.z(), 0, 1e-9);
}

TEST(ThinSolid, MitresTheMiddleOfSharpEdges)
{
    // An angle section of planes, the inner ones ending where they meet.
    BentSheet sheet = shapes::bent_sheet(Profile({0, 0}, 0).straight(40), 50, 4);
    const double t = 1.5;
    Eigen::Matrix3Xd inwards(3, sheet.mesh.vertices());
    for (int v = 0; v < sheet.mesh.vertices(); ++v) {
        const double x = sheet.mesh.position(0, v) - 20;
        if (x > 1e-9) // bent down at x = 20
            sheet.mesh.position.col(v) = Eigen::Vector3d(20, sheet.mesh.position(1, v), -x);
        inwards.col(v) = std::abs(x) <= 1e-9 ? Eigen::Vector3d(-t, 0, -t)
                         : x < 0             ? Eigen::Vector3d(0, 0, -t)
                                             : Eigen::Vector3d(-t, 0, 0);
    }
    const TriMesh solid = shapes::thickened(sheet.mesh, inwards);
    const ThinSolid found = thin_solid(solid);
    EXPECT_NEAR(found.thickness, t, 1e-9);
    const SkinMesh middle = skin_of(solid, found, Skin::middle);
    EXPECT_NEAR((middle.mesh.position - sheet.mesh.position - inwards / 2).cwiseAbs().maxCoeff(), 0, 1e-9);
    EXPECT_NEAR(area(middle.mesh) * t, found.volume, 1e-9 * found.volume);
}

TEST(ThinSolid, TakesTheFacesOfNarrowBridgesAndChamfersForRim)
{
    const auto expect_sides = [](const TriMesh& outer, const TriMesh& solid) {
        const ThinSolid found = thin_solid(solid);
        const int f = outer.triangles();
        for (int i = 0; i < solid.triangles(); ++i)
            ASSERT_EQ(found.side[size_t(i)] == SheetSide::rim, i >= 2 * f) << i << " of " << f;
    };
    // Two holes as far apart as the sheet is thick: the faces between lie opposite at its
    // thickness.
    const BentSheet plate =
        shapes::without(shapes::bent_sheet(Profile({0, 0}, 0).straight(40), 30, 1), [](const Eigen::Vector3d& p) {
            return std::abs(p.y() - 15) < 5 && ((p.x() > 10 && p.x() < 20) || (p.x() > 21 && p.x() < 31));
        });
    expect_sides(plate.mesh, solid_of(plate, 1));

    // A plate whose upper edges are chamfered by 0.3 mm: the upper skin moves in, the chamfer comes
    // between.
    const TriMesh top = shapes::rectangle(40, 30, 20, 15);
    Eigen::Matrix3Xd to_chamfer = Eigen::Matrix3Xd::Zero(3, top.vertices());
    for (int v = 0; v < top.vertices(); ++v) {
        const double x = top.position(0, v), y = top.position(1, v);
        to_chamfer.col(v) << (x < 0.1 ? -0.3 : x > 39.9 ? 0.3 : 0), (y < 0.1 ? -0.3 : y > 29.9 ? 0.3 : 0), 0;
    }
    TriMesh wide = top;
    wide.position += to_chamfer;
    Eigen::Matrix3Xd down = Eigen::Matrix3Xd::Zero(3, top.vertices());
    down.row(2).setConstant(-1.2);
    TriMesh solid = shapes::thickened(wide, down); // 1.2 mm thick; its top is lifted to 1.5 mm, and
                                                   // narrowed
    const int v = top.vertices(), f = top.triangles(), rim = solid.triangles() - 2 * f;
    TriMesh chamfered = solid;
    chamfered.position.conservativeResize(3, 3 * v);
    chamfered.position.rightCols(v) = top.position;
    chamfered.position.rightCols(v).row(2).array() += 0.3;
    chamfered.triangle.conservativeResize(3, solid.triangles() + rim);
    chamfered.triangle.leftCols(f).array() += 2 * v;
    // the same edges, from the top to the wide outline
    const TriMesh collar = shapes::thickened(top, to_chamfer);
    for (int i = 0; i < rim; ++i)
        for (int k = 0; k < 3; ++k) {
            const int at = collar.triangle(k, 2 * f + i);
            chamfered.triangle(k, solid.triangles() + i) = at < v ? 2 * v + at : at - v;
        }
    EXPECT_TRUE(boundary_loops(chamfered).empty());
    expect_sides(top, chamfered);
    EXPECT_NEAR(thin_solid(chamfered).inner, 40 * 30, 1e-9) << "of the top";
}

TEST(ThinSolid, IsTheSameTurnedRenumberedAndInsideOut)
{
    const TriMesh solid = solid_of(with_holes(shapes::bent_sheet(hat(), 90, 4)), 0.8);
    const ThinSolid plain = thin_solid(solid);
    for (const std::uint64_t seed : {1, 2, 3}) {
        shapes::Permuted other =
            shapes::permuted(shapes::transformed(solid, shapes::random_rotation(seed), {100, -20, 7}), seed);
        if (seed == 3)
            other.mesh.triangle = other.mesh.triangle.colwise().reverse().eval();
        const ThinSolid turned = thin_solid(other.mesh);
        for (int f = 0; f < solid.triangles(); ++f)
            ASSERT_EQ(turned.side[size_t(other.face[size_t(f)])], plain.side[size_t(f)]) << f;
        EXPECT_NEAR(turned.thickness, plain.thickness, 1e-9);
        const SkinMesh inner = skin_of(other.mesh, turned, Skin::inner),
                       outer = skin_of(other.mesh, turned, Skin::outer);
        EXPECT_NEAR(area(inner.mesh), plain.inner, 1e-6);
        EXPECT_GT(area_vectors(inner.mesh).rowwise().sum().dot(area_vectors(outer.mesh).rowwise().sum()), 0)
            << "both are seen from the outer side";
    }
}

TEST(ThinSolid, RefusesWhatIsNoSheetAndSaysWhy)
{
    EXPECT_NE(refusal(box({20, 20, 20}, 8)).find("block"), std::string::npos);
    EXPECT_NE(refusal(shapes::closed_sphere(10, 2000)).find("block"), std::string::npos);
    EXPECT_NE(refusal(shapes::torus(50, 3, 6000)).find("no two separate sides"), std::string::npos);
    EXPECT_EQ(refusal(box({60, 40, 1}, 12)), "");

    // A wedge from 0.4 to 2 mm.
    const TriMesh plate = shapes::rectangle(60, 40, 30, 20);
    Eigen::Matrix3Xd down = Eigen::Matrix3Xd::Zero(3, plate.vertices());
    for (int v = 0; v < plate.vertices(); ++v)
        down(2, v) = -0.4 - 1.6 * plate.position(0, v) / 60;
    EXPECT_NE(refusal(shapes::thickened(plate, down)), "");

    // Coined to half its thickness on a twelfth of the plate, with a slope around it.
    for (int v = 0; v < plate.vertices(); ++v)
        down(2, v) = std::abs(plate.position(0, v) - 30) < 7 && std::abs(plate.position(1, v) - 20) < 7 ? -0.5 : -1;
    const std::string coined = refusal(shapes::thickened(plate, down));
    EXPECT_NE(coined.find("varies"), std::string::npos) << coined;
    EXPECT_NE(coined.find(" at "), std::string::npos) << coined;
}

TEST(ThinSolid, RefusesARibThatBranchesOff)
{
    // A T section: its outline extruded.
    const std::vector<Eigen::Vector2d> outline = {{0, 0},     {60, 0},    {60, 1},   {30.5, 1},
                                                  {30.5, 30}, {29.5, 30}, {29.5, 1}, {0, 1}};
    const auto n = int(outline.size());
    TriMesh solid;
    solid.position.resize(3, 2 * n);
    for (int i = 0; i < n; ++i) {
        solid.position.col(i) << outline[size_t(i)].x(), 0, outline[size_t(i)].y();
        solid.position.col(n + i) << outline[size_t(i)].x(), 80, outline[size_t(i)].y();
    }
    std::vector<std::array<int, 3>> faces;
    for (int i = 0; i < n; ++i) {
        const int j = (i + 1) % n;
        faces.push_back({i, j, n + i});
        faces.push_back({j, n + j, n + i});
    }
    for (const auto& [a, b, c] :
         std::vector<std::array<int, 3>>{{0, 7, 6}, {0, 6, 3}, {0, 3, 1}, {1, 3, 2}, {6, 5, 4}, {6, 4, 3}}) {
        faces.push_back({a, b, c});
        faces.push_back({n + a, n + c, n + b});
    }
    solid.triangle.resize(3, Eigen::Index(faces.size()));
    for (size_t f = 0; f < faces.size(); ++f)
        for (size_t k = 0; k < 3; ++k)
            solid.triangle(Eigen::Index(k), Eigen::Index(f)) = faces[f][k];
    EXPECT_TRUE(boundary_loops(solid).empty());
    EXPECT_NE(refusal(solid), "");
}

TEST(ThinSolid, TakesASolidWithAFaceMissing)
{
    const BentSheet sheet = shapes::bent_sheet(hat(), 90, 3);
    TriMesh solid = solid_of(sheet, 1);
    EXPECT_TRUE(seems_thin_solid(solid));
    EXPECT_FALSE(seems_thin_solid(sheet.mesh));
    solid.triangle.conservativeResize(3, solid.triangles() - 20); // of the rim
    EXPECT_FALSE(boundary_loops(solid).empty());
    EXPECT_TRUE(seems_thin_solid(solid));
    EXPECT_NEAR(thin_solid(solid).thickness, 1, 1e-9);
    // A deep narrow channel is no solid of its own width.
    const BentSheet channel =
        shapes::bent_sheet(Profile({0, 80}, -pi / 2).straight(80).bend(2, pi).straight(80), 100, 4);
    EXPECT_NE(refusal(channel.mesh), "");
}

TEST(ThinSolid, TakesAboutASecondForAHundredThousandTriangles)
{
    const TriMesh solid = solid_of(shapes::bent_sheet(hat(), 200, 1.3), 1);
    EXPECT_GT(solid.triangles(), 90'000);
    const auto start = std::chrono::steady_clock::now();
    skin_of(solid, thin_solid(solid), Skin::middle);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    RecordProperty("seconds", std::to_string(seconds));
    EXPECT_LT(seconds, 20) << "unoptimised and under a sanitizer, too";
}

} // namespace spia::thin_solid_test
