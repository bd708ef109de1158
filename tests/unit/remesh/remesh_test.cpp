#include "engine/remesh/remesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <oneapi/tbb/global_control.h>
#include <random>
#include <set>

#include "engine/core/error.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/edge_graph.h"
#include "engine/mesh/topology.h"
#include "engine/remesh/border_clearance.h"
#include "engine/remesh/mesh_distance.h"
#include "engine/remesh/thin_faces.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/parametric_mesh.h"
#include "tests/support/samples.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

constexpr double degrees = std::numbers::pi / 180, pi = std::numbers::pi;

/// Splits edges and faces of the mesh near their corners, at random, so that there are many needles
/// and caps. The surface is the same.
TriMesh with_slivers(const TriMesh& mesh, int splits, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.01, 0.2);
    TriMesh result = mesh;
    result.position.conservativeResize(3, mesh.vertices() + splits);
    result.triangle.conservativeResize(3, mesh.triangles() + 2 * splits);
    int faces = mesh.triangles();
    for (int k = 0; k < splits; ++k) {
        const int f = int(random() % unsigned(faces)), v = mesh.vertices() + k;
        const Eigen::Vector3i t = result.triangle.col(f);
        const double a = share(random), b = share(random) / 4;
        result.position.col(v) =
            (1 - a - b) * result.position.col(t[0]) + a * result.position.col(t[1]) + b * result.position.col(t[2]);
        result.triangle.col(f) << t[0], t[1], v;
        result.triangle.col(faces++) << t[1], t[2], v;
        result.triangle.col(faces++) << t[2], t[0], v;
    }
    return result;
}

/// The largest distance of many random places of one mesh from another, drawn by area.
double sampled_distance(const TriMesh& from, const TriMesh& to, int samples)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0, 1);
    const ClosestPointSearch search(to);
    const Eigen::VectorXd weight = area_vectors(from).colwise().norm();
    std::discrete_distribution<int> face(weight.begin(), weight.end());
    double most = 0;
    for (int k = 0; k < samples; ++k) {
        const auto t = from.triangle.col(face(random));
        double a = share(random), b = share(random);
        if (a + b > 1)
            a = 1 - a, b = 1 - b;
        const Eigen::Vector3d p =
            (1 - a - b) * from.position.col(t[0]) + a * from.position.col(t[1]) + b * from.position.col(t[2]);
        most = std::max(most, search.nearest(p).distance);
    }
    return most;
}

std::vector<double> loop_lengths(const TriMesh& mesh)
{
    std::vector<double> result;
    for (const std::vector<int>& loop : boundary_loops(mesh)) {
        result.push_back(0);
        for (size_t i = 0; i < loop.size(); ++i)
            result.back() += (mesh.position.col(loop[i]) - mesh.position.col(loop[(i + 1) % loop.size()])).norm();
    }
    return result;
}

/// Two plane halves of 100 x 40 mm that meet at a right angle along y = 0.
TriMesh angle_profile(int columns, int rows)
{
    TriMesh mesh = shapes::rectangle(100, 80, columns, 2 * rows);
    for (int v = 0; v < mesh.vertices(); ++v) {
        const double y = mesh.position(1, v) - mesh.position.row(1).minCoeff() - 40;
        mesh.position(1, v) = std::max(y, 0.0);
        mesh.position(2, v) = std::max(-y, 0.0);
    }
    return mesh;
}

TEST(Remesh, ThinTrianglesBecomeGoodOnes)
{
    for (const char* name : {"sphere-cap", "saddle", "perforated-channel"}) {
        const TriMesh thin = with_slivers(shapes::sample(name).make(4000), 3000, 3);
        const RemeshResult result = remesh(thin);
        // else there is nothing to be mended
        EXPECT_LT(result.before.least_angle, 1 * degrees) << name;
        EXPECT_GT(shapes::least_angles(result.mesh).minCoeff(), 20 * degrees) << name;
        EXPECT_LT(result.after.edge_ratio, 3) << name;
        EXPECT_NEAR(result.after.least_angle, shapes::least_angles(result.mesh).minCoeff(), 1e-12);
    }
}

TEST(Remesh, NoPlaceIsFartherThanItSays)
{
    for (const char* name : {"dome", "hat-channel", "inner-panel", "fender"}) {
        const TriMesh part = shapes::sample(name).make(4000);
        RemeshOptions options;
        options.tolerance = bounding_diagonal(part) / 1500;
        const RemeshResult result = remesh(part, options);
        const double seen =
            std::max(sampled_distance(part, result.mesh, 50000), sampled_distance(result.mesh, part, 50000));
        EXPECT_LE(seen, result.distance) << name;
        // the bound says something
        EXPECT_GT(seen, 0.8 * result.distance - 0.11 * *options.tolerance) << name;
        EXPECT_LE(result.distance, *options.tolerance) << name;
    }
}

TEST(MeshDistance, OfParallelTiltedAndBentMeshesIsThatOfThePlane)
{
    const TriMesh flat = shapes::rectangle(100, 60, 7, 5);
    TriMesh tilted = shapes::rectangle(100, 60, 3, 2);
    const double low = tilted.position.row(0).minCoeff();
    for (int v = 0; v < tilted.vertices(); ++v)
        tilted.position(2, v) = 0.01 * (tilted.position(0, v) - low); // up to 1 mm
    const ClosestPointSearch search(flat);
    const MeshDistance found = farthest(tilted, flat, search, 1e-3);
    EXPECT_NEAR(found.seen, 1, 1e-9);
    EXPECT_GE(found.bound, found.seen);
    EXPECT_LE(found.bound, 1.1);
    // A ridge between two samples: the middle of a chord over a roof is 5 mm below it, and no
    // vertex shows that.
    TriMesh roof = shapes::rectangle(100, 60, 2, 1), chord = shapes::rectangle(100, 60, 1, 1);
    for (int v = 0; v < roof.vertices(); ++v)
        if (std::abs(roof.position(0, v) - roof.position.row(0).mean()) < 1)
            roof.position(2, v) = 5;
    const ClosestPointSearch to_roof(roof);
    const MeshDistance under = farthest(chord, roof, to_roof, 1e-3);
    const double exact = 5 * std::cos(std::atan(5.0 / 50));
    EXPECT_GE(under.bound, exact * (1 - 1e-9));
    EXPECT_LE(under.bound, exact * 1.11);
    EXPECT_LE(under.seen, exact * (1 + 1e-9));
}

TEST(Remesh, StraightBordersCornersAndSharpEdgesStayExactly)
{
    for (const double size : {2.0, 9.0}) {
        const TriMesh part = angle_profile(50, 20); // edges of 2 mm
        RemeshOptions options;
        options.size = size;
        const RemeshResult result = remesh(part, options);
        EXPECT_NEAR(loop_lengths(result.mesh).at(0), 360, 1e-9);
        // four of the sheet and both ends of the edge
        EXPECT_EQ(result.corners, 6);
        EXPECT_NEAR(area(result.mesh), area(part), 1e-9 * area(part)); // no face cuts the edge off
        double sharp = 0;
        const Eigen::Matrix3Xd normal = area_vectors(result.mesh);
        for (const EdgeGraph::Edge& edge : edge_graph(result.mesh).edge)
            if (!edge.boundary() && normal.col(edge.face).normalized().dot(normal.col(edge.twin).normalized()) < 0.5)
                sharp += edge.length;
        EXPECT_NEAR(sharp, 100, 1e-9);
        for (const double x : {part.position.row(0).minCoeff(), part.position.row(0).maxCoeff()})
            for (const Eigen::Vector3d& corner : {Eigen::Vector3d(x, 40, 0), {x, 0, 0}, {x, 0, 40}})
                EXPECT_LT((result.mesh.position.colwise() - corner).colwise().norm().minCoeff(), 1e-12);
        EXPECT_NEAR(result.after.median_edge, size, 0.35 * size);
    }
}

TEST(Remesh, BordersBetweenLabelsStay)
{
    const TriMesh part = shapes::rectangle(100, 60, 20, 12);
    const double middle = part.position.row(0).mean();
    std::vector<int> label;
    for (int f = 0; f < part.triangles(); ++f)
        label.push_back(part.position(0, Eigen::all)(part.triangle.col(f)).mean() < middle ? 4 : 9);
    RemeshOptions options;
    options.size = 3.7;
    const RemeshResult result = remesh(part, options, label);
    double area_of_4 = 0;
    const Eigen::VectorXd each = area_vectors(result.mesh).colwise().norm();
    for (int f = 0; f < result.mesh.triangles(); ++f)
        if (label[size_t(result.nearest_face[size_t(f)])] == 4)
            area_of_4 += each[f];
    EXPECT_NEAR(area_of_4, 3000, 1e-9);
    EXPECT_TRUE(std::is_sorted(result.nearest_face.begin(), result.nearest_face.end()));
    EXPECT_TRUE(std::is_sorted(result.nearest_vertex.begin(), result.nearest_vertex.end()));
}

/// Exact area of a quarter cylinder, and what a remesh of finer and finer chords makes of it.
TEST(Remesh, ACylinderKeepsItsAreaToSecondOrder)
{
    std::vector<double> h, error;
    for (const int triangles : {500, 2000, 8000, 32000}) {
        const TriMesh part = shapes::quarter_cylinder({.radius = 50, .length = 80, .triangles = triangles}).mesh;
        const RemeshResult result = remesh(with_slivers(part, triangles / 3, 5));
        h.push_back(shapes::mean_edge(part));
        error.push_back(std::abs(area(result.mesh) - 50 * pi / 2 * 80));
        // vertices lie on the given mesh, so between its chords and the cylinder
        const double deepest = 50 * (1 - std::cos(pi / 4 / std::floor(50 * pi / 2 / (1.1 * h.back()))));
        for (int v = 0; v < result.mesh.vertices(); ++v) {
            const double r = std::hypot(result.mesh.position(0, v), result.mesh.position(2, v));
            EXPECT_LE(r, 50 + 1e-9);
            EXPECT_GE(r, 50 - 8 * deepest);
        }
    }
    EXPECT_GT(shapes::convergence_order(h, error), 1.8);
}

TEST(Remesh, OverfineMeshesBecomeCoarser)
{
    const TriMesh part = shapes::sample("dome").make(30000);
    RemeshOptions options;
    options.size = 4;
    const RemeshResult result = remesh(part, options);
    EXPECT_LT(result.mesh.triangles(), part.triangles() / 3);
    EXPECT_GT(result.after.least_angle, 25 * degrees);
    EXPECT_LE(sampled_distance(part, result.mesh, 30000), result.tolerance);
    EXPECT_EQ(boundary_loops(result.mesh).size(), boundary_loops(part).size());
}

TEST(Remesh, ATurnedAndMovedPartIsRemeshedAlike)
{
    const TriMesh part = shapes::sample("inner-panel").make(3000);
    RemeshOptions options;
    options.size = 10; // the defaults hang on the box
    options.tolerance = 0.7;
    const RemeshResult here = remesh(part, options);
    const RemeshResult there = remesh(shapes::transformed(part, shapes::random_rotation(5), {1000, -300, 20}), options);
    EXPECT_NEAR(here.mesh.triangles(), there.mesh.triangles(), 0.02 * here.mesh.triangles());
    EXPECT_NEAR(area(here.mesh), area(there.mesh), 2e-3 * area(part));
}

TEST(Remesh, SaysWhereTheToleranceCannotBeKept)
{
    RemeshOptions options;
    options.size = 40;
    options.tolerance = 1e-4;
    try {
        remesh(shapes::sample("dome").make(100), options);
        FAIL() << "a tenth of a micrometre is kept";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("from the given one at"), std::string::npos) << text;
        EXPECT_NE(text.find("without remeshing"), std::string::npos) << text;
    }
    for (const double bad : {0.0, -1.0, 1e6, std::nan("")}) {
        const TriMesh flat = shapes::rectangle(100, 60, 2, 2);
        EXPECT_THROW(remesh(flat, {.size = bad}), InputError) << bad;
        EXPECT_THROW(remesh(flat, {.tolerance = bad}), InputError) << bad;
    }
}

TEST(Remesh, RefusesWhatCannotBeHeldBeforeItIsMade)
{
    const TriMesh plate = shapes::rectangle(100, 60, 10, 6);
    const auto said = [&](const RemeshOptions& options) -> std::string {
        try {
            remesh(plate, options);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    RemeshOptions fine, blunt;
    fine.size = 0.02; // 35 million triangles
    EXPECT_NE(said(fine).find("would take 35 million triangles; give a larger size"), std::string::npos) << said(fine);
    for (const double angle : {0.0, -0.1, 3.2, std::nan("")}) {
        blunt.sharp = angle;
        EXPECT_NE(said(blunt).find("sharp edges"), std::string::npos) << angle;
        RemeshOptions ridge;
        ridge.ridge = angle;
        EXPECT_NE(said(ridge).find("ridges"), std::string::npos) << angle;
    }
}

/// A plate in which many edges are gaps: on one side they are divided at a vertex that is off by up
/// to the gap, and a thin face lies between, as CAD faces that do not quite meet are sewn.
TriMesh with_gaps(TriMesh mesh, int gaps, double gap)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(0.3, 0.7), off(-gap, gap);
    const int step = mesh.triangles() / gaps;
    for (int k = 0; k < gaps; ++k) {
        const int f = k * step, c = mesh.vertices(), faces = mesh.triangles();
        const Eigen::Vector3i t = mesh.triangle.col(f);
        const double s = share(random);
        mesh.position.conservativeResize(3, c + 1);
        mesh.position.col(c) = (1 - s) * mesh.position.col(t[0]) + s * mesh.position.col(t[1]) +
                               Eigen::Vector3d(off(random), off(random), off(random));
        mesh.triangle.conservativeResize(3, faces + 2);
        mesh.triangle.col(f) << t[0], c, t[2];
        mesh.triangle.col(faces) << c, t[1], t[2];
        mesh.triangle.col(faces + 1) << t[0], t[1], c; // faces[f] had t0 to t1, and so has this one
    }
    return mesh;
}

double largest_turn(const TriMesh& mesh)
{
    const Eigen::Matrix3Xd normal = area_vectors(mesh);
    return std::acos((normal.row(2).array() / normal.colwise().norm().array()).minCoeff());
}

TEST(ThinFaces, ThatLookAsideVanishIntoTheirNeighbours)
{
    const TriMesh plate = shapes::rectangle(80, 40, 16, 8), part = with_gaps(plate, 30, 1e-3);
    ASSERT_GT(largest_turn(part), 90 * degrees); // some are turned over
    std::vector<int> none;
    const TriMesh even = without_thin_faces(part, 5e-3, none);
    EXPECT_LT(largest_turn(even), 26 * degrees); // thin ones that look there about stay
    EXPECT_EQ(even.position, part.position);
    EXPECT_NEAR(area(even), 3200, 0.1);
    EXPECT_EQ(boundary_loops(even).size(), 1u);
    EXPECT_EQ(without_thin_faces(part, 1e-6, none).triangle, part.triangle); // none is that thin
    // each of its own: no edge may be flipped
    std::vector<int> label(size_t(part.triangles()));
    std::iota(label.begin(), label.end(), 0);
    const int faces = without_thin_faces(part, 5e-3, label).triangles();
    EXPECT_EQ(label.size(), size_t(faces));
    EXPECT_GT(largest_turn(without_thin_faces(part, 5e-3, label)), 90 * degrees);
}

TEST(Remesh, GapsBetweenFacesLeaveNoSlivers)
{
    const TriMesh part = with_gaps(shapes::rectangle(80, 40, 16, 8), 30, 1e-3);
    RemeshOptions options;
    options.size = 4;
    const RemeshResult result = remesh(part, options);
    EXPECT_LT(result.before.least_angle, 0.1 * degrees);
    EXPECT_GT(result.after.least_angle, 25 * degrees);
    EXPECT_LE(std::max(sampled_distance(part, result.mesh, 20000), sampled_distance(result.mesh, part, 20000)),
              result.distance);
}

TEST(Remesh, OneThreadOrTwoGiveTheSameBits)
{
    const TriMesh part = with_slivers(shapes::sample("perforated-channel").make(3000), 1000, 9);
    const auto with = [&](size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return remesh(part);
    };
    const RemeshResult one = with(1), two = with(2);
    EXPECT_EQ(one.mesh.position, two.mesh.position);
    EXPECT_EQ(one.mesh.triangle, two.mesh.triangle);
    EXPECT_EQ(one.nearest_face, two.nearest_face);
    EXPECT_EQ(one.distance, two.distance);
}

/// A half ring in the plane with a slit along its middle, `width` wide, each of whose banks has its
/// own vertices.
TriMesh slit_ring(double width, int around)
{
    constexpr int across = 20, middle = across / 2;
    std::map<std::array<int, 3>, int> number;
    std::vector<Eigen::Vector3d> place;
    const auto vertex = [&](int i, int j, int bank) {
        const bool cut = j == middle && i > around / 10 && i < around - around / 10;
        const auto [found, is_new] = number.try_emplace({i, j, cut ? bank : 0}, int(place.size()));
        if (is_new) {
            const double radius = 50 + 100.0 * j / across + (cut ? bank * width / 2 : 0), angle = pi * i / around;
            place.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
        }
        return found->second;
    };
    TriMesh mesh{{}, Eigen::Matrix3Xi(3, 2 * around * across)};
    for (int i = 0, f = 0; i < around; ++i)
        for (int j = 0; j < across; ++j, f += 2) {
            const int inner = j == middle ? 1 : 0, outer = j + 1 == middle ? -1 : 0;
            const int a = vertex(i, j, inner), b = vertex(i, j + 1, outer), c = vertex(i + 1, j + 1, outer),
                      d = vertex(i + 1, j, inner);
            mesh.triangle.col(f) << a, b, c;
            mesh.triangle.col(f + 1) << a, c, d;
        }
    mesh.position.resize(3, Eigen::Index(place.size()));
    for (size_t v = 0; v < place.size(); ++v)
        mesh.position.col(Eigen::Index(v)) = place[v];
    return mesh;
}

/// How many of some places in the plane near the circle of radius 100 lie in several triangles.
int covered_twice(const TriMesh& mesh)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    int twice = 0;
    for (int k = 0; k < 4000; ++k) {
        const double radius = 99 + 2 * share(random), angle = pi * (0.15 + 0.7 * share(random));
        const Eigen::Vector2d p(radius * std::cos(angle), radius * std::sin(angle));
        int layers = 0;
        for (int f = 0; f < mesh.triangles(); ++f) {
            int left = 0;
            for (int e = 0; e < 3; ++e) {
                const Eigen::Vector2d a = mesh.position.col(mesh.triangle(e, f)).head<2>(),
                                      b = mesh.position.col(mesh.triangle((e + 1) % 3, f)).head<2>();
                left += (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x() > 0 ? 1 : -1;
            }
            layers += std::abs(left) == 3;
        }
        twice += layers > 1;
    }
    return twice;
}

TEST(Remesh, TheBanksOfANarrowSlitDoNotCross)
{
    for (const auto& [width, size, tolerance] :
         {std::tuple(0.2, 25., 1.), {0.2, 17., 0.6}, {0.05, 10., 2.}, {2., 25., 1.}}) {
        const TriMesh ring = slit_ring(width, 240);
        ASSERT_EQ(covered_twice(ring), 0);
        RemeshOptions options;
        options.size = size;
        options.tolerance = tolerance;
        const RemeshResult result = remesh(ring, options);
        EXPECT_EQ(covered_twice(result.mesh), 0) << width << ' ' << size << ' ' << tolerance;
        EXPECT_LT(result.mesh.triangles(), ring.triangles()) << "it is coarser all the same";
    }
}

TEST(BorderClearance, IsTheWidthOfSlitsAndHoles)
{
    const TriMesh ring = slit_ring(0.2, 240);
    const Eigen::VectorXd gap = border_clearance(ring, 1);
    for (int v = 0; v < ring.vertices(); ++v) {
        const double radius = ring.position.col(v).norm(), angle = std::atan2(ring.position(1, v), ring.position(0, v));
        const bool bank = std::abs(std::abs(radius - 100) - 0.1) < 1e-9;
        if (bank && angle > 0.15 * pi && angle < 0.85 * pi) {
            EXPECT_LE(gap[v], 0.2 + 1e-9);
            EXPECT_GE(gap[v], 0.1);
        } else if (std::abs(radius - 100) > 6) {
            EXPECT_EQ(gap[v], 2) << "wider than that is not looked for";
        }
    }
}

/// A quarter of a cylinder in strips along its generators, as BRepMesh makes of bends.
TriMesh strips(int count)
{
    TriMesh mesh{Eigen::Matrix3Xd(3, 2 * (count + 1)), Eigen::Matrix3Xi(3, 2 * count)};
    for (int i = 0; i <= count; ++i)
        for (int end = 0; end < 2; ++end) {
            const double angle = pi / 2 * i / count;
            mesh.position.col(2 * i + end) << 200 * std::cos(angle), 200 * std::sin(angle), 1000 * end;
        }
    for (int i = 0; i < count; ++i) {
        mesh.triangle.col(2 * i) << 2 * i, 2 * i + 2, 2 * i + 3;
        mesh.triangle.col(2 * i + 1) << 2 * i, 2 * i + 3, 2 * i + 1;
    }
    return mesh;
}

TEST(Remesh, StripsAreNotDividedAlongTheirLengthBeforeTheyVanish)
{
    int reports = 0; // one for every 256 edges or faces that are looked at
    const Progress progress([&](double, std::string_view) { ++reports; });
    const RemeshResult result = remesh(strips(1000), {}, {}, progress);
    EXPECT_LT(result.mesh.triangles(), 2000);
    EXPECT_GT(result.after.least_angle_of_99, 30 * degrees);
    EXPECT_LT(reports, 20000) << "145 000 where each strip is divided first, 6500 where not";
}

TEST(Remesh, ALongLineCanBeCancelledWhileItIsDivided)
{
    const auto cancel = std::make_shared<std::atomic<bool>>(false);
    int reports = 0;
    const Progress progress(
        [&](double, std::string_view step) {
            if (step == "dividing the kept lines" && ++reports == 500)
                *cancel = true;
        },
        cancel);
    EXPECT_THROW(remesh(strips(1000), {}, {}, progress), Cancelled);
    EXPECT_EQ(reports, 500);
}

TEST(Remesh, EndsWhenItIsCancelled)
{
    const auto cancel = std::make_shared<std::atomic<bool>>(false);
    int reports = 0;
    const Progress progress(
        [&](double fraction, std::string_view) {
            EXPECT_GE(fraction, 0);
            EXPECT_LE(fraction, 1);
            if (++reports == 9)
                *cancel = true;
        },
        cancel);
    EXPECT_THROW(remesh(shapes::sample("dome").make(2000), {}, {}, progress), Cancelled);
    EXPECT_EQ(reports, 9);
}

} // namespace
} // namespace spia
