// A middle surface held against its solid: right borders are let pass, moved ones are found and
// measured.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "engine/mesh/solid/border/beside_solid.h"
#include "engine/mesh/solid/border/onto_projection.h"
#include "engine/mesh/topology.h"
#include "tests/support/plane_faces.h"
#include "tests/support/shapes.h"
#include "tests/support/sheet_solid.h"

namespace spia {
namespace {

using std::numbers::pi;

struct Solid {
    TriMesh solid, middle;
    double thickness;
};

/// A plate with two holes, somewhere in space. @param lean  of all its walls, tangent
Solid any_plate(std::mt19937& random, double lean)
{
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const double thickness = between(1, 6);
    const shapes::Circle hole{{between(30, 45), between(30, 50)}, between(4, 15)};
    const TriMesh outer = shapes::plate({120, 80, {hole, {{85, 40}, 12}}, 12000});
    Eigen::Matrix3Xd inwards(3, outer.vertices());
    inwards.colwise() = Eigen::Vector3d(lean, 0, -1) * thickness;
    Solid result{shapes::thickened(outer, inwards), outer, thickness};
    result.middle.position += inwards / 2;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(between(0, pi), Eigen::Vector3d(between(-1, 1), between(-1, 1), 1).normalized())
            .toRotationMatrix();
    for (TriMesh* mesh : {&result.solid, &result.middle})
        mesh->position = (turn * mesh->position).eval();
    return result;
}

/// Its second longest loop wider by so much, mm; less where it is negative.
TriMesh with_a_wider_hole(TriMesh mesh, double by)
{
    const std::vector<int> loop = boundary_loops(mesh)[1];
    const Eigen::Vector3d centre = mesh.position(Eigen::all, loop).rowwise().mean();
    for (const int v : loop)
        mesh.position.col(v) += by * (mesh.position.col(v) - centre).normalized();
    return mesh;
}

TEST(BesideSolid, LetsRightBordersPass)
{
    std::mt19937 random(11);
    for (int k = 0; k < 20; ++k) {
        Solid part = any_plate(random, k % 2 ? 0 : 0.6);
        if (k % 3 == 0) // its normals lead inwards
            part.solid.triangle.row(1).swap(part.solid.triangle.row(2));
        EXPECT_TRUE(beside_solid(part.middle, part.solid, part.thickness, 0.01 * part.thickness).empty()) << k;
    }
}

TEST(BesideSolid, LetsATonguePassThatTouchesTheSheetItWasBentOutOf)
{
    // Cut square to the edge of the tongue: it lies lower than the sheet by less than a thickness.
    constexpr double t = 2, edge = 20;
    for (const double lower : {0.2, 1., 1.8}) {
        const TriMesh solid = shapes::extruded(
            {{0, -lower}, {edge, -lower}, {edge, 0}, {40, 0}, {40, t}, {edge, t}, {edge, t - lower}, {0, t - lower}},
            {}, 30);
        TriMesh tongue = shapes::rectangle(edge, 30, 10, 15); // extruded along y
        tongue.position.row(2).setConstant(t / 2 - lower);
        EXPECT_TRUE(beside_solid(tongue, solid, t, 0.01 * t).empty()) << lower;
        tongue.position.row(0) *= 0.9; // and where it ends too early that is said
        EXPECT_FALSE(beside_solid(tongue, solid, t, 0.01 * t).empty()) << lower;
    }
}

TEST(BesideSolid, LetsBentSheetPass)
{
    const shapes::Profile profile =
        shapes::Profile({0, 0}, 0).straight(40).bend(6, -pi / 2).straight(30).bend(8, pi / 3).straight(20);
    for (const double edge : {2., 6.}) {
        const shapes::BentSheet sheet = shapes::bent_sheet(profile, 50, edge);
        for (const double thickness : {0.5, 3.}) {
            TriMesh middle = sheet.mesh;
            middle.position -= thickness / 2 * sheet.normal;
            const TriMesh solid = shapes::thickened(sheet.mesh, -thickness * sheet.normal);
            EXPECT_TRUE(beside_solid(middle, solid, thickness, 0.02 * thickness).empty()) << edge << ' ' << thickness;
        }
    }
}

TEST(BesideSolid, MeasuresHolesThatAreTooWideOrTooNarrow)
{
    std::mt19937 random(12);
    for (int k = 0; k < 20; ++k) {
        const Solid part = any_plate(random, 0);
        for (const double share : {-0.4, -0.15, 0.15, 0.4}) {
            const double by = std::clamp(share * part.thickness, -0.5, 0.5); // no triangle turns over
            const std::vector<BesideSolid> off =
                beside_solid(with_a_wider_hole(part.middle, by), part.solid, part.thickness, 0.02 * part.thickness);
            ASSERT_EQ(off.size(), 1u) << k << ": one row all around";
            EXPECT_NEAR(off[0].beside, by, 0.02 * std::abs(by)) << k;
        }
    }
}

TEST(BesideSolid, FindsAnAskewWallThatIsNotMetHalfway)
{
    std::mt19937 random(13);
    for (int k = 0; k < 10; ++k) {
        Solid part = any_plate(random, 0.6);
        // as if the border went straight in below the outer skin
        const Eigen::Vector3d across =
            (part.solid.position.col(part.middle.vertices()) - part.solid.position.col(0)) / 2;
        const Eigen::Vector3d normal = area_vectors(part.middle).col(0).normalized();
        part.middle.position.colwise() -= across - across.dot(normal) * normal;
        EXPECT_FALSE(beside_solid(part.middle, part.solid, part.thickness, 0.02 * part.thickness).empty()) << k;
    }
}

TEST(BesideSolid, FindsACornerThatIsBesideItsPlaceAlongAWall)
{
    // A line through the corner leaves the solid by the other wall: the edge is seen to be slanted.
    for (const double thickness : {0.8, 4.}) {
        const TriMesh outer = shapes::rectangle(100, 60, 1, 1);
        Eigen::Matrix3Xd inwards = Eigen::Matrix3Xd::Zero(3, outer.vertices());
        inwards.row(2).setConstant(-thickness);
        TriMesh middle = outer;
        middle.position += inwards / 2;
        Eigen::Index corner;
        middle.position.colwise().sum().maxCoeff(&corner);
        middle.position(0, corner) -= 0.25 * thickness;
        const auto off = beside_solid(middle, shapes::thickened(outer, inwards), thickness, 0.02 * thickness);
        ASSERT_EQ(off.size(), 1u);
        EXPECT_NEAR(off[0].beside, 0.125 * thickness, 0.01 * thickness);
    }
}

/// A plate whose middle surface has a corner so little beside its place that the middles of its
/// edges are not.
struct SlantedPlate {
    TriMesh solid, middle;
    static constexpr double off = 0.035; // of the thickness
};

SlantedPlate slanted_plate(double thickness)
{
    const TriMesh outer = shapes::rectangle(100, 60, 1, 1);
    Eigen::Matrix3Xd inwards = Eigen::Matrix3Xd::Zero(3, outer.vertices());
    inwards.row(2).setConstant(-thickness);
    SlantedPlate plate{shapes::thickened(outer, inwards), outer};
    plate.middle.position += inwards / 2;
    Eigen::Index corner;
    plate.middle.position.colwise().sum().maxCoeff(&corner);
    plate.middle.position(0, corner) -= SlantedPlate::off * thickness;
    return plate;
}

TEST(BesideSolid, FindsALongEdgeThatIsSlanted)
{
    for (const double thickness : {0.8, 4.}) {
        const SlantedPlate plate = slanted_plate(thickness);
        const auto off = beside_solid(plate.middle, plate.solid, thickness, 0.02 * thickness);
        ASSERT_EQ(off.size(), 1u);
        EXPECT_NEAR(off[0].beside, 0.95 * SlantedPlate::off * thickness, 1e-3 * thickness);
    }
}

TEST(OntoProjection, PutsACornerBackThatIsBesideItsPlace)
{
    for (const double thickness : {0.8, 4.}) {
        SlantedPlate plate = slanted_plate(thickness);
        SkinMesh skin{plate.middle, {0, 1, 2, 3}, SheetSide::outer, {0, 1}, {}, {}};
        onto_projection(skin, {}, {plate.solid, {}, thickness, 1, 0}, 0.02 * thickness);
        const Eigen::Vector3d size = skin.mesh.position.rowwise().maxCoeff() - skin.mesh.position.rowwise().minCoeff();
        EXPECT_NEAR(size.x(), 100, 1e-9);
        EXPECT_NEAR(area_vectors(skin.mesh).colwise().norm().sum(), 6000, 1e-6);
    }
}

} // namespace
} // namespace spia
