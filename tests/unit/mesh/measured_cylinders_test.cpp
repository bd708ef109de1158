#include "engine/mesh/solid/fit/measured_cylinders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/mesh/topology.h"
#include "tests/support/bent_parts.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/seeded_random.h"
#include "tests/support/sheet_solid.h"

namespace spia::measured_cylinders_test {
namespace {

using shapes::BentSheet;
using shapes::Profile;
using std::numbers::pi;
using Kind = StatedSurface::Kind;

TriMesh solid_of(const BentSheet& sheet, double thickness)
{
    return shapes::thickened(sheet.mesh, -thickness * sheet.normal);
}

int cylinders(const std::vector<StatedSurface>& surface)
{
    return int(std::ranges::count_if(surface, [](const StatedSurface& s) { return s.kind == Kind::cylinder; }));
}

} // namespace

TEST(MeasuredCylinders, OfABentSheetAreThoseItWasBentOver)
{
    shapes::SeededRandom random(4);
    for (int trial = 0; trial < 20; ++trial) {
        const double r = random.between(3, 20), t = random.between(0.2, 0.6) * r, angle = random.between(0.7, 2);
        const BentSheet sheet =
            shapes::bent_sheet(Profile({0, 0}, 0).straight(40).bend(r, -angle).straight(30), 60, random.between(1, 4));
        TriMesh solid = solid_of(sheet, t);
        const Eigen::Matrix3d turn = shapes::random_rotation(std::uint64_t(trial));
        solid.position = (turn * solid.position).eval();
        solid.position = solid.position.cast<float>().cast<double>().eval(); // as in an STL file
        const std::vector<StatedSurface> surface = measured_cylinders(solid, thin_solid(solid));
        const int skin = sheet.mesh.triangles();
        for (int f = 0; f < 2 * skin; ++f) {
            const StatedSurface& s = surface[size_t(f)];
            ASSERT_EQ(s.kind == Kind::cylinder, sheet.piece[size_t(f % skin)] == 1) << f;
            if (s.kind != Kind::cylinder)
                continue;
            EXPECT_NEAR(s.radius, f < skin ? r : r - t, 1e-4 * r);
            EXPECT_LT(s.direction.cross(turn * Eigen::Vector3d::UnitY()).norm(), 1e-5);
            EXPECT_LT(s.off, 1e-4 * t) << "single precision";
        }
        EXPECT_EQ(cylinders(surface), 2 * int(std::ranges::count(sheet.piece, 1))) << "none at the rim";
    }
}

TEST(MeasuredCylinders, AreNotFoundInDrawnSheet)
{
    shapes::RoundCup shape;
    const TriMesh cup = shapes::round_cup(shape);
    Eigen::Matrix3Xd inwards = -vertex_normals(cup);
    int wall = 0;
    for (int v = 0; v < cup.vertices(); ++v)
        if (const double r = cup.position.col(v).head<2>().norm(); std::abs(r - shape.radius) < 1e-6) {
            // on a cylinder to the last digit, as in CAD
            inwards.col(v) << -cup.position.col(v).head<2>() / r, 0;
            ++wall;
        }
    ASSERT_GT(wall, 100);
    const TriMesh solid = shapes::thickened(cup, inwards);
    EXPECT_EQ(cylinders(measured_cylinders(solid, thin_solid(solid))), 0) << "its wall ends in radii all around";
}

TEST(MeasuredCylinders, AreNotFoundInSheetThatIsFoldedSharply)
{
    // Flats around a circle, between two legs that say how thick it is: mitred, the inner corners
    // lie on a circle as well.
    for (const double fold : {8., 15., 30.}) {
        const double a = fold * pi / 180, t = 1, flat = 15;
        std::vector<Eigen::Vector2d> line{{0, 0}, {200, 0}};
        for (int i = 1; i <= 5; ++i)
            line.push_back(line.back() + (i == 5 ? 200 : flat) * Eigen::Vector2d(std::cos(i * a), std::sin(i * a)));
        TriMesh sheet;
        const int n = int(line.size());
        sheet.position.resize(3, 2 * n);
        sheet.triangle.resize(3, 2 * (n - 1));
        Eigen::Matrix3Xd in(3, 2 * n);
        for (int i = 0; i < n; ++i) {
            const bool end = i == 0 || i == n - 1;
            const double mitre = end ? t : t / std::cos(a / 2);
            const double heading = i == 0 ? 0 : end ? 5 * a : (i - 0.5) * a;
            for (int side = 0; side < 2; ++side) {
                sheet.position.col(2 * i + side) << line[size_t(i)].x(), 60. * side, line[size_t(i)].y();
                in.col(2 * i + side) << -mitre * std::sin(heading), 0, mitre * std::cos(heading);
            }
        }
        for (int i = 0; i + 1 < n; ++i) {
            sheet.triangle.col(2 * i) << 2 * i, 2 * i + 1, 2 * i + 2;
            sheet.triangle.col(2 * i + 1) << 2 * i + 1, 2 * i + 3, 2 * i + 2;
        }
        const TriMesh solid = shapes::thickened(sheet, in);
        ThinSolid taken = thin_solid(solid);
        taken.thickness = t; // as rays between the flats say
        EXPECT_EQ(cylinders(measured_cylinders(solid, taken)), 0) << fold;
    }
}

} // namespace spia::measured_cylinders_test
