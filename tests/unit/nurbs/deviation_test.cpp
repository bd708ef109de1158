#include "engine/nurbs/deviation.h"

#include <cmath>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "engine/core/error.h"
#include "engine/nurbs/interpolate.h"
#include "engine/nurbs/tessellate.h"
#include "tests/support/known_surfaces.h"
#include "tests/support/shapes.h"

namespace spia {

namespace {

/// A mesh inscribed in a sphere about the origin, up to `reach` (radians) left, right, below and
/// above the x axis.
TriMesh inscribed(double radius, double reach, int cells)
{
    TriMesh mesh = shapes::rectangle(2 * reach, 2 * reach, cells, cells);
    for (int v = 0; v < mesh.vertices(); ++v) {
        const double azimuth = mesh.position(0, v) - reach, latitude = mesh.position(1, v) - reach;
        mesh.position.col(v) << radius * std::cos(latitude) * std::cos(azimuth),
            radius * std::cos(latitude) * std::sin(azimuth), radius * std::sin(latitude);
    }
    return mesh;
}

/// A flat square of 100 mm, z = height, as a surface through a grid of cells x cells.
NurbsSurface flat(double height, int cells)
{
    return interpolate(surfaces::grid(cells, cells,
                                      [&](double s, double t) { return Eigen::Vector3d(100 * s, 100 * t, height); }))
        .surface;
}

} // namespace

TEST(Deviation, MeshInscribedInASphereAgainstALargerSphere)
{
    const double radius = 50, offset = 0.4;
    const NurbsSurface surface = surfaces::sphere_patch(radius + offset);
    const TriMesh mesh = inscribed(radius, 0.7, 24); // the feet of all its places are inside the
                                                     // patch
    const Deviation d = deviation(surface, mesh);

    // The distance of a place of the mesh is radius + offset less its own distance from the centre.
    double lowest = radius;
    for (int f = 0; f < mesh.triangles(); ++f) {
        const auto a = mesh.position.col(mesh.triangle(0, f)), b = mesh.position.col(mesh.triangle(1, f)),
                   c = mesh.position.col(mesh.triangle(2, f));
        for (double size : {((a + b + c) / 3).norm(), ((a + b) / 2).norm(), ((b + c) / 2).norm(), ((c + a) / 2).norm()})
            lowest = std::min(lowest, size);
    }
    EXPECT_NEAR(d.mesh_to_surface.max, radius + offset - lowest, 1e-9);
    EXPECT_NEAR(d.mesh_to_surface.where.norm(), lowest, 1e-9);
    EXPECT_EQ(d.mesh_to_surface.excluded, 0);
    for (double at_vertex : d.at_vertex)
        EXPECT_NEAR(at_vertex, offset, 1e-9) << "positive: the surface is on the outer side";
    EXPECT_EQ(d.max(), std::max(d.mesh_to_surface.max, d.surface_to_mesh.max));

    const Deviation inner = deviation(surfaces::sphere_patch(radius - offset), mesh);
    for (double at_vertex : inner.at_vertex)
        EXPECT_NEAR(at_vertex, -offset, 1e-9);
}

TEST(Deviation, LargerSphereAgainstAMeshInscribedInASphere)
{
    const double radius = 50, offset = 0.4;
    const int cells = 120;
    const double reach = 0.95; // corners of the patch project inside of the mesh
    const Deviation d =
        deviation(surfaces::sphere_patch(radius + offset), inscribed(radius, reach, cells), {.samples_per_span = 16});
    // of a cell: no place is farther from a vertex
    const double half_diagonal = radius * reach / cells * std::sqrt(2.);
    const double sag = half_diagonal * half_diagonal / (2 * radius);
    EXPECT_EQ(d.surface_to_mesh.samples, 17 * 17);
    EXPECT_GE(d.surface_to_mesh.max, offset);
    EXPECT_LE(d.surface_to_mesh.max, offset + 1.01 * sag);
    EXPECT_GE(d.surface_to_mesh.mean, offset);
    EXPECT_NEAR(d.surface_to_mesh.where.norm(), radius + offset, 1e-9);
    EXPECT_EQ(d.between_data.samples, 0) << "no data were given";
}

TEST(Deviation, StatisticsWeighTheAreaAndNotTheSamples)
{
    // A plane 1 mm below the surface on the left tenth, where the mesh is 20 times as fine, and 3
    // mm on the rest.
    TriMesh fine = shapes::rectangle(10, 100, 20, 100), mesh = shapes::rectangle(90, 100, 9, 5);
    fine.position.row(2).setConstant(-1);
    mesh.position.row(2).setConstant(-3);
    mesh.position.row(0).array() += 10;
    const int first = mesh.vertices();
    mesh.position.conservativeResize(3, first + fine.vertices());
    mesh.position.rightCols(fine.vertices()) = fine.position;
    const int first_face = mesh.triangles();
    mesh.triangle.conservativeResize(3, first_face + fine.triangles());
    mesh.triangle.rightCols(fine.triangles()) = fine.triangle.array() + first;

    const DeviationStatistics d = deviation(flat(0, 10), mesh).mesh_to_surface;
    EXPECT_NEAR(d.mean, 0.1 * 1 + 0.9 * 3, 1e-10);
    EXPECT_NEAR(d.rms, std::sqrt(0.1 * 1 + 0.9 * 9), 1e-10);
    EXPECT_NEAR(d.p95, 3, 1e-10);
    EXPECT_NEAR(d.max, 3, 1e-10);
    EXPECT_EQ(d.samples,
              mesh.vertices() + mesh.triangles() + (9 * 6 + 10 * 5 + 9 * 5) + (20 * 101 + 21 * 100 + 20 * 100));
}

TEST(Deviation, NinetyFivePercentOfTheAreaAreBelowP95)
{
    // A plane tilted against the surface: the distance grows evenly from 0 to 10.
    TriMesh mesh = shapes::rectangle(100, 100, 100, 2);
    mesh.position.row(2) = 0.1 * mesh.position.row(0);
    const DeviationStatistics d = deviation(flat(0, 40), mesh).mesh_to_surface;
    EXPECT_NEAR(d.p95, 9.5, 0.1); // a sample's share of the area is up to 1 %
    EXPECT_NEAR(d.mean, 5, 1e-9);
    EXPECT_NEAR(d.rms, 10 / std::sqrt(3.), 1e-9);
    EXPECT_NEAR(d.max, 10, 1e-9);
    EXPECT_NEAR(d.where.x(), 100, 1e-9);
}

TEST(Deviation, ErrorBetweenTheDataIsSeenThere)
{
    const auto wave = [](double s, double t) {
        return Eigen::Vector3d(100 * s, 60 * t, 5 * std::sin(9 * s) * (1 + t));
    };
    const InterpolateResult result = interpolate(surfaces::grid(8, 8, wave));
    TriMesh mesh = shapes::rectangle(1, 1, 300, 60);
    for (int v = 0; v < mesh.vertices(); ++v)
        mesh.position.col(v) = wave(mesh.position(0, v), mesh.position(1, v));
    DeviationOptions options;
    options.data_u = result.u;
    options.data_v = result.v;
    const Deviation d = deviation(result.surface, mesh, options);
    EXPECT_EQ(d.between_data.samples, 8 * 8);
    EXPECT_GT(d.between_data.max, 0.01);
    EXPECT_LE(d.between_data.max, 1.5 * d.surface_to_mesh.max);
    EXPECT_GT(d.between_data.max, 0.3 * d.surface_to_mesh.max) << "the middle shows what the data hide";
}

TEST(Deviation, FilledHoleIsNoDeviation)
{
    // The part is flat, its hole [30, 60] x [30, 60] was filled by a bulge the surface knows
    // nothing of.
    TriMesh whole = shapes::rectangle(100, 100, 50, 50), filled = whole;
    int part_faces = 0;
    const auto in_hole = [&](int f) {
        const Eigen::Vector3d middle =
            (whole.position.col(whole.triangle(0, f)) + whole.position.col(whole.triangle(1, f)) +
             whole.position.col(whole.triangle(2, f))) /
            3;
        return middle.x() > 30 && middle.x() < 60 && middle.y() > 30 && middle.y() < 60;
    };
    for (bool fill : {false, true})
        for (int f = 0; f < whole.triangles(); ++f)
            if (in_hole(f) == fill) {
                filled.triangle.col(part_faces++) = whole.triangle.col(f);
            }
    part_faces -= 15 * 15 * 2;
    int inner = 0;
    for (int v = 0; v < filled.vertices(); ++v) {
        const double x = filled.position(0, v), y = filled.position(1, v);
        if (x > 31 && x < 59 && y > 31 && y < 59) {
            filled.position(2, v) = 7;
            ++inner;
        }
    }
    const NurbsSurface surface = flat(0.25, 20);
    DeviationOptions options;
    options.part_faces = part_faces;
    const Deviation d = deviation(surface, filled, options);
    EXPECT_NEAR(d.max(), 0.25, 1e-9);
    EXPECT_NEAR(d.mesh_to_surface.rms, 0.25, 1e-9);
    EXPECT_NEAR(d.surface_to_mesh.rms, 0.25, 1e-9);
    EXPECT_EQ(d.mesh_to_surface.excluded, inner);
    const auto samples_between = [&](double from, double to) {
        int count = 0;
        for (double u : sample_parameters(surface.knots_u, surface.degree_u, options.samples_per_span))
            count += from < 100 * u && 100 * u < to; // S(u, v) = (100 u, 100 v, 0.25)
        return count * count;
    };
    EXPECT_GE(d.surface_to_mesh.excluded, samples_between(30.001, 59.999));
    EXPECT_LE(d.surface_to_mesh.excluded, samples_between(29.999, 60.001));
    EXPECT_NEAR(d.at_vertex.minCoeff(), -6.75, 1e-9) << "vertices of the fill are measured nevertheless";
    EXPECT_GT(deviation(surface, filled).max(), 5) << "it is the fill that is far away";
}

TEST(Deviation, OneAndTwoThreadsGiveTheSameBits)
{
    const InterpolateResult result = interpolate(surfaces::grid(
        30, 30, [](double s, double t) { return Eigen::Vector3d(100 * s, 60 * t, 5 * std::sin(9 * s) * (1 + t)); }));
    TriMesh mesh = shapes::rectangle(100, 60, 70, 50);
    for (int v = 0; v < mesh.vertices(); ++v)
        mesh.position(2, v) = std::sin(0.3 * mesh.position(0, v)) * std::cos(0.2 * mesh.position(1, v));
    const auto on_threads = [&](size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return deviation(result.surface, mesh);
    };
    const Deviation one = on_threads(1), two = on_threads(2);
    EXPECT_EQ(one.at_vertex, two.at_vertex);
    for (const auto& statistics : {&Deviation::surface_to_mesh, &Deviation::mesh_to_surface}) {
        EXPECT_EQ((one.*statistics).rms, (two.*statistics).rms);
        EXPECT_EQ((one.*statistics).mean, (two.*statistics).mean);
        EXPECT_EQ((one.*statistics).p95, (two.*statistics).p95);
        EXPECT_EQ((one.*statistics).max, (two.*statistics).max);
        EXPECT_EQ((one.*statistics).where, (two.*statistics).where);
    }
}

TEST(Deviation, OptionsOutOfRangeAreRefused)
{
    const NurbsSurface surface = flat(0, 4);
    const TriMesh mesh = shapes::rectangle(100, 100, 2, 2);
    EXPECT_THROW(deviation(surface, mesh, {.samples_per_span = 0}), InputError);
    EXPECT_THROW(deviation(surface, mesh, {.part_faces = 0}), InputError);
    EXPECT_THROW(deviation(surface, mesh, {.part_faces = 9}), InputError);
    EXPECT_THROW(deviation(surface, mesh, {.data_u = {0, 1}}), InputError) << "along v they are missing";
    EXPECT_THROW(deviation(surface, mesh, {.data_u = {0, 2}, .data_v = {0, 1}}), InputError);
    EXPECT_THROW(deviation(surface, TriMesh{}), InputError);
}

TEST(Deviation, CancelledWhenItsOwnerAsksForIt)
{
    const auto cancel = std::make_shared<const std::atomic<bool>>(true);
    EXPECT_THROW(deviation(flat(0, 4), shapes::rectangle(100, 100, 2, 2), {}, Progress(nullptr, cancel)), Cancelled);
}

TEST(Deviation, NormalsAreComparedWhicheverWayTheSurfaceLooks)
{
    // A plane against a roof of two planes at 0.1 and 0.5 radians to it, their ridge sharp, each of
    // half the width.
    const double gentle = 0.1, steep = 0.5;
    TriMesh mesh = shapes::rectangle(100, 100, 20, 20);
    for (int v = 0; v < mesh.vertices(); ++v) {
        const double x = mesh.position(0, v) - 50;
        mesh.position(2, v) = x < 0 ? std::tan(gentle) * x : -std::tan(steep) * x;
    }
    for (const bool turned_round : {false, true}) {
        const NurbsSurface surface =
            interpolate(surfaces::grid(8, 8, [&](double s, double t) {
                return turned_round ? Eigen::Vector3d(100 * t, 100 * s, 0) : Eigen::Vector3d(100 * s, 100 * t, 0);
            })).surface;
        DeviationOptions options;
        options.sharp_angle = 0.4;
        const Deviation d = deviation(surface, mesh, options);
        EXPECT_NEAR(d.normal.max, steep, 1e-12);
        EXPECT_NEAR(d.normal.max_smooth, steep, 1e-12);
        EXPECT_GT(d.normal.mean, gentle);
        EXPECT_LT(d.normal.mean, steep);
        EXPECT_NEAR(d.normal.p95, steep, 1e-12);
        EXPECT_EQ(d.normal.turned, 0);
        EXPECT_TRUE(d.turned.empty());
    }
}

TEST(Deviation, FacesWithASharpEdgeAreLeftOutOfTheGreatestSmoothAngle)
{
    // A ridge of two columns of cells across a flat sheet, with sharp edges at its top and feet,
    // under a plane.
    TriMesh mesh = shapes::rectangle(100, 100, 20, 20);
    for (int v = 0; v < mesh.vertices(); ++v)
        if (std::abs(mesh.position(0, v) - 50) < 1e-9)
            mesh.position(2, v) = -3;
    const Deviation d = deviation(flat(0, 8), mesh);
    EXPECT_NEAR(d.normal.max, std::atan2(3, 5), 1e-12);
    EXPECT_EQ(d.normal.max_smooth, 0);
    DeviationOptions blunt;
    blunt.sharp_angle = 1.2; // more than twice the slope
    EXPECT_NEAR(deviation(flat(0, 8), mesh, blunt).normal.max_smooth, std::atan2(3, 5), 1e-12);
}

TEST(Deviation, FoldedSurfaceLooksTheOtherWayWhereItRunsBack)
{
    // Along u it goes to 60, back to 40 and on: a fifth of its length, over flat ground.
    const NurbsSurface surface = interpolate(surfaces::grid(70, 4, [](double s, double t) {
                                     const double x = 140 * s;
                                     return Eigen::Vector3d(x < 60 ? x : x < 80 ? 120 - x : x - 40, 100 * t, 0);
                                 })).surface;
    DeviationOptions options;
    options.tolerance = 1;
    const Deviation d = deviation(surface, shapes::rectangle(100, 100, 20, 20), options);
    EXPECT_NEAR(d.normal.turned, 20. / 140, 0.02);
    EXPECT_FALSE(d.turned.empty());
    for (const BeyondTolerance& sample : d.turned) {
        EXPECT_GT(sample.u, 55. / 140);
        EXPECT_LT(sample.u, 85. / 140);
    }
    EXPECT_TRUE(d.beyond.empty()) << "it is on the ground all the same";
    EXPECT_EQ(d.within(), 1);
}

} // namespace spia
