#include "engine/unfold/target/fit_target.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "engine/core/error.h"
#include "tests/support/developable.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

std::vector<int> all_faces(const TriMesh& part)
{
    std::vector<int> faces(size_t(part.triangles()));
    for (size_t f = 0; f < faces.size(); ++f)
        faces[f] = int(f);
    return faces;
}

/// Somewhere in space, turned.
TriMesh moved(TriMesh part)
{
    const Eigen::Quaterniond turn = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized();
    part.position = (turn.toRotationMatrix() * part.position).colwise() + Eigen::Vector3d(400, -120, 33);
    return part;
}

TriMesh turned_over(TriMesh part)
{
    part.triangle.row(1).swap(part.triangle.row(2));
    return part;
}

/// Greatest difference of an edge's length, and least area of a face in the development against
/// that in space.
void expect_development(const TriMesh& part, const TargetSurface& face, double chord)
{
    Eigen::Matrix2Xd flat(2, part.vertices());
    for (int v = 0; v < part.vertices(); ++v) {
        flat.col(v) = developed(face, part.position.col(v));
        EXPECT_LT((placed(face, flat.col(v)) - part.position.col(v)).norm(), 1e-6);
    }
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Vector3i t = part.triangle.col(f);
        for (int a = 0; a < 3; ++a) {
            const int i = t[a], k = t[(a + 1) % 3];
            const double in_space = (part.position.col(i) - part.position.col(k)).norm();
            EXPECT_NEAR((flat.col(i) - flat.col(k)).norm(), in_space, chord * in_space);
        }
        const Eigen::Vector2d p = flat.col(t[1]) - flat.col(t[0]), q = flat.col(t[2]) - flat.col(t[0]);
        EXPECT_GT(p[0] * q[1] - p[1] * q[0], 0) << "seen counter-clockwise";
    }
}

} // namespace

TEST(FitTarget, APlateIsAPlaneWhereverItLies)
{
    for (const TriMesh& part :
         {moved(shapes::rectangle(80, 50, 8, 5)), turned_over(moved(shapes::rectangle(80, 50, 8, 5)))}) {
        const auto fit = fit_target(part, all_faces(part));
        ASSERT_TRUE(fit);
        EXPECT_EQ(name(fit->face), "plane");
        EXPECT_LT(fit->distance_mm, 1e-10);
        EXPECT_LT(fit->angle, 1e-7);
        expect_development(part, fit->face, 1e-10);
    }
}

TEST(FitTarget, ABentStripIsACylinderWithItsRadiusOnEitherSide)
{
    const TriMesh strip = moved(shapes::quarter_cylinder({.radius = 50, .length = 80, .triangles = 2000}).mesh);
    for (const TriMesh& part : {strip, turned_over(strip)}) {
        const auto fit = fit_target(part, all_faces(part));
        ASSERT_TRUE(fit);
        ASSERT_EQ(name(fit->face), "cylinder");
        const auto& cylinder = std::get<CylinderFace>(fit->face);
        EXPECT_NEAR(cylinder.radius, 50, 1e-6);
        EXPECT_LT(fit->distance_mm, 1e-7);
        expect_development(part, fit->face, 2e-4); // an edge is a chord of its arc
    }
    EXPECT_NE(std::get<CylinderFace>(fit_target(strip, all_faces(strip))->face).bulges,
              std::get<CylinderFace>(fit_target(turned_over(strip), all_faces(strip))->face).bulges);
}

TEST(FitTarget, AConeIsFoundWithItsApexAndAngle)
{
    const shapes::ConeSector shape{.near = 60, .far = 140, .half_angle_deg = 30, .sector_deg = 120, .triangles = 3000};
    const TriMesh at_origin = shapes::cone_sector(shape).mesh, sector = moved(at_origin);
    for (const TriMesh& part : {sector, turned_over(sector)}) {
        const auto fit = fit_target(part, all_faces(part));
        ASSERT_TRUE(fit);
        ASSERT_EQ(name(fit->face), "cone");
        const auto& cone = std::get<ConeFace>(fit->face);
        EXPECT_NEAR(cone.half_angle, std::numbers::pi / 6, 1e-7);
        const TriMesh apex = moved({Eigen::Matrix3Xd::Zero(3, 1), {}});
        EXPECT_LT((cone.apex - apex.position.col(0)).norm(), 1e-5);
        EXPECT_LT(fit->distance_mm, 1e-6);
        expect_development(part, fit->face, 5e-4);
    }
}

TEST(FitTarget, NoGeneratorNeedsToBeAnEdge)
{
    // A plate whose vertices are moved about at random, laid on the face: its triangles are chords
    // in all directions.
    TriMesh plate = shapes::rectangle(60, 50, 20, 16);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> little(-0.8, 0.8);
    for (int v = 0; v < plate.vertices(); ++v)
        plate.position.col(v).head<2>() += Eigen::Vector2d(little(random) - 30, little(random) + 80);
    const Eigen::Matrix3d turn = Eigen::Quaterniond(0.1, 0.9, -0.3, 0.4).normalized().toRotationMatrix();
    std::vector<TargetSurface> faces;
    for (int k = 0; k < 3; ++k)
        for (const double way : {1., -1.}) {
            const Eigen::Vector3d axis = way * turn.col(k), towards = turn.col((k + 1) % 3);
            faces.push_back(CylinderFace{{3, 4, 5}, axis, towards, 40, way > 0});
            faces.push_back(ConeFace{{3, 4, 5}, axis, towards, 0.4, way > 0});
        }
    for (const TargetSurface& face : faces) {
        TriMesh part = plate;
        for (int v = 0; v < part.vertices(); ++v)
            part.position.col(v) = placed(face, plate.position.col(v).head<2>());
        const auto fit = fit_target(part, all_faces(part));
        ASSERT_TRUE(fit) << name(face);
        EXPECT_EQ(name(fit->face), name(face));
        EXPECT_LT(fit->distance_mm, 1e-6);
        EXPECT_LT(fit->angle, 0.15);
        if (const auto* cone = std::get_if<ConeFace>(&fit->face)) {
            EXPECT_NEAR(cone->half_angle, 0.4, 1e-6);
        }
        expect_development(part, fit->face, 5e-3);
    }
}

TEST(FitTarget, ASharpBendIsNoCylinderThoughItsVerticesLieOnOne)
{
    TriMesh bend = shapes::rectangle(40, 50, 2, 5);
    for (int v = 0; v < bend.vertices(); ++v)
        if (const double beyond = bend.position(0, v) - 20; beyond > 0) {
            bend.position(0, v) = 20;
            bend.position(2, v) = beyond;
        }
    EXPECT_FALSE(fit_target(bend, all_faces(bend)));
}

TEST(FitTarget, ARegionOfAPartCountsAloneAndADomeIsNone)
{
    const TriMesh hat = moved(shapes::hat_channel({.triangles = 3000}).mesh);
    EXPECT_FALSE(fit_target(hat, all_faces(hat)));
    // the same faces before they were moved
    const TriMesh flat = shapes::hat_channel({.triangles = 3000}).mesh;
    const double top = flat.position.row(2).maxCoeff();
    std::vector<int> faces;
    for (int f = 0; f < flat.triangles(); ++f)
        if ((flat.position.row(2)(flat.triangle.col(f)).array() - top).abs().maxCoeff() < 1e-9)
            faces.push_back(f);
    ASSERT_GT(faces.size(), 100u);
    const auto fit = fit_target(hat, faces);
    ASSERT_TRUE(fit);
    EXPECT_EQ(name(fit->face), "plane");
    TriMesh dome = shapes::rectangle(80, 60, 16, 12); // on a sphere
    for (int v = 0; v < dome.vertices(); ++v)
        dome.position(2, v) = std::sqrt(4e4 - dome.position.col(v).head<2>().squaredNorm());
    EXPECT_FALSE(fit_target(dome, all_faces(dome)));
    EXPECT_TRUE(fit_target(dome, all_faces(dome), 0.3)) << "a plane will do for so little";
    EXPECT_THROW(fit_target(hat, {}), InputError);
    EXPECT_THROW(fit_target(hat, {hat.triangles()}), InputError);
}

} // namespace spia
