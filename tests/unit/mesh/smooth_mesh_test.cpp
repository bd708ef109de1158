#include "engine/mesh/smooth/smooth_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"
#include "tests/support/grid_surface.h"
#include "tests/support/known_sheets.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/profile.h"
#include "tests/support/seeded_random.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

/// Edges of at most three arcs' chords each side; the profile runs along x and z, the sheet along y.
TriMesh bent_sheet(const shapes::Profile& profile, const std::vector<double>& s, double width, int rows)
{
    return shapes::grid_surface({int(s.size()) - 1, rows}, [&](double u, double v) {
        const double at = u * double(s.size() - 1);
        const Eigen::Vector2d p = profile.at(s[size_t(std::lround(at))]);
        return Eigen::Vector3d(p.x(), width * v, p.y());
    });
}

/// Arc lengths: the straight pieces in cells of so many mm, each arc in so many chords.
std::vector<double> spaced(const shapes::Profile& profile, double cell, int chords)
{
    std::vector<double> result = {0};
    for (const auto& piece : profile.pieces()) {
        const int count = piece.curvature != 0 ? chords : std::max(1, int(std::lround((piece.to - piece.from) / cell)));
        for (int k = 1; k <= count; ++k)
            result.push_back(std::lerp(piece.from, piece.to, double(k) / count));
    }
    return result;
}

/// mm, how far a point is from the profile in its plane.
double off_profile(const shapes::Profile& profile, const Eigen::Vector3d& point)
{
    double least = 1e300;
    const Eigen::Vector2d p(point.x(), point.z());
    for (const auto& piece : profile.pieces()) {
        if (piece.curvature == 0) {
            const Eigen::Vector2d along(std::cos(piece.heading), std::sin(piece.heading));
            const double t = std::clamp((p - piece.start).dot(along), 0., piece.to - piece.from);
            least = std::min(least, (piece.start + t * along - p).norm());
        } else {
            const Eigen::Vector2d left(-std::sin(piece.heading), std::cos(piece.heading)),
                centre = piece.start + left / piece.curvature;
            const Eigen::Vector2d from = piece.start - centre, to = profile.at(piece.to) - centre, way = p - centre;
            const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
                return a.x() * b.y() - a.y() * b.x();
            };
            const double turn = piece.curvature > 0 ? 1 : -1;
            if (turn * cross(from, way) >= 0 && turn * cross(way, to) >= 0)
                least = std::min(least, std::abs(way.norm() - 1 / std::abs(piece.curvature)));
        }
    }
    return least;
}

/// Every inner edge belongs to two triangles that run along it in opposite directions.
void expect_conforming(const SmoothMesh& smooth, const TriMesh& from)
{
    EXPECT_EQ(boundary_loops(smooth.mesh).size(), boundary_loops(from).size());
    for_each_edge(edge_uses(smooth.mesh.triangle), [](size_t begin, size_t end) { EXPECT_LE(end - begin, 2u); });
    EXPECT_EQ(smooth.mesh.position.leftCols(from.vertices()), from.position);
    for (size_t t = 0; t < smooth.face.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(smooth.barycentric[t].col(k).sum(), 1, 1e-14);
            EXPECT_GE(smooth.barycentric[t].minCoeff(), 0);
        }
}

} // namespace

TEST(SmoothMesh, ComesNearerToKnownSurfacesByAHigherOrderThanFacets)
{
    for (const shapes::KnownSheet& sheet : shapes::known_sheets()) {
        std::vector<double> h, facets, curved;
        for (const int cells : {16, 32, 64}) {
            const TriMesh mesh = shapes::mesh_of(sheet, cells);
            SmoothMeshOptions options;
            options.chord = 1e-7 * sheet.size;
            options.most_halvings = 2;
            const SmoothMesh smooth = smooth_mesh(mesh, options);
            expect_conforming(smooth, mesh);
            double most = 0;
            for (int v = 0; v < smooth.mesh.vertices(); ++v)
                most = std::max(most, sheet.distance(smooth.mesh.position.col(v)));
            h.push_back(1. / cells);
            facets.push_back(shapes::chord_error(sheet, mesh));
            curved.push_back(most);
        }
        if (facets.back() < 1e-9)
            EXPECT_LT(curved.back(), 1e-9) << sheet.name; // a plane
        else {
            // The bump has a radius of three cells of the finest mesh, and counts as a bend there.
            const bool resolved = sheet.name != "bump";
            EXPECT_GT(shapes::convergence_order(h, curved), resolved ? 2.7 : 1.9) << sheet.name;
            EXPECT_LT(curved.back(), facets.back() / (resolved ? 10 : 4)) << sheet.name;
        }
    }
}

TEST(SmoothMesh, PutsChordsOfBendsOnTheirArcsAndLeavesTheFlatsAlone)
{
    shapes::SeededRandom random(3);
    for (int sample = 0; sample < 20; ++sample) {
        shapes::Profile profile({0, 0}, 0);
        double least = 1e300;
        profile.straight(random.between(20, 60));
        const int bends = random.whole(1, 4), chords = random.whole(2, 6);
        for (int k = 0; k < bends; ++k) {
            const double radius = random.between(3, 20), angle = random.between(0.4, std::min(1.6, 0.35 * chords));
            profile.bend(radius, random.coin() ? angle : -angle).straight(random.between(20, 60));
            least = std::min(least, radius * (1 - std::cos(angle / (2 * chords)))); // of the chords
        }
        const TriMesh mesh = bent_sheet(profile, spaced(profile, 10, chords), 50, 6);
        SmoothMeshOptions options;
        options.chord = 0.02 * least;
        const SmoothMesh smooth = smooth_mesh(mesh, options);
        expect_conforming(smooth, mesh);
        EXPECT_GT(smooth.mesh.vertices(), mesh.vertices());
        EXPECT_GE(smooth.chord, 0.9 * least);
        for (int v = 0; v < smooth.mesh.vertices(); ++v)
            EXPECT_LT(off_profile(profile, smooth.mesh.position.col(v)), 0.1 * smooth.chord)
                << "sample " << sample << ", " << smooth.mesh.position.col(v).transpose();
    }
}

TEST(SmoothMesh, LeavesSheetsOfFlatFacesAsTheyAre)
{
    const TriMesh flat = shapes::plate();
    // By 30 degrees, and by 10, without an arc.
    const TriMesh folded = shapes::grid_surface({8, 5}, [](double u, double v) {
        const double x = 80 * u;
        const double z = x < 30   ? 0
                         : x < 60 ? (x - 30) * std::tan(0.52)
                                  : 30 * std::tan(0.52) + (x - 60) * std::tan(0.7);
        return Eigen::Vector3d(x, 50 * v, z);
    });
    for (const TriMesh* mesh : {&flat, &folded}) {
        const SmoothMesh smooth = smooth_mesh(*mesh, {.chord = 1e-4});
        EXPECT_EQ(smooth.mesh.position, mesh->position);
        EXPECT_EQ(smooth.mesh.triangle, mesh->triangle);
        EXPECT_LT(smooth.chord, 1e-9);
    }
}

TEST(SmoothMesh, SaysWhatIsLeftWhereHalvingsRunOut)
{
    const shapes::KnownSheet sheet = shapes::known_sheets()[1];
    const TriMesh mesh = shapes::mesh_of(sheet, 6);
    double before = smooth_mesh(mesh).chord;
    for (const int halvings : {0, 1, 2}) {
        const SmoothMesh smooth = smooth_mesh(mesh, {.chord = 1e-9, .most_halvings = halvings});
        EXPECT_GT(smooth.left, smooth.asked);
        EXPECT_LE(smooth.left, halvings == 0 ? before : before / 2);
        before = smooth.left;
    }
    const SmoothMesh small = smooth_mesh(mesh, {.chord = 1e-9, .most_triangles = 10 * mesh.triangles()});
    EXPECT_GT(small.mesh.triangles(), mesh.triangles());
    EXPECT_LE(small.mesh.triangles(), 4 * mesh.triangles()); // halved once
    EXPECT_GT(small.left, small.asked);
    const SmoothMesh enough = smooth_mesh(mesh, {.chord = before});
    EXPECT_LE(enough.left, enough.asked);
    EXPECT_EQ(enough.asked, before);
}

TEST(SmoothMesh, KeepsEdgesSharperThanTheCrease)
{
    // Two quarter pipes that meet at an edge of 90 degrees.
    const auto place = [](double u, double v) {
        const double t = (u < 0.5 ? 2 * u : 2 * u - 1) * std::numbers::pi / 2;
        return u < 0.5 ? Eigen::Vector3d(20 * std::sin(t), 40 * v, 20 * std::cos(t))
                       : Eigen::Vector3d(40 - 20 * std::cos(t), 40 * v, 20 * std::sin(t));
    };
    const TriMesh mesh = shapes::grid_surface({16, 6}, place);
    const auto farthest = [&](double crease) {
        const SmoothMesh smooth = smooth_mesh(mesh, {.crease = crease, .chord = 1e-3});
        double most = 0;
        for (int v = 0; v < smooth.mesh.vertices(); ++v) {
            const Eigen::Vector3d p = smooth.mesh.position.col(v);
            const double first = std::abs(std::hypot(p.x(), p.z()) - 20),
                         second = std::abs(std::hypot(p.x() - 40, p.z()) - 20);
            most = std::max(most, p.x() < 20 ? first : second);
        }
        return most;
    };
    EXPECT_GT(farthest(3.2), 5 * farthest(0.8)); // the edge rounded
    EXPECT_LT(farthest(0.8), 0.01);              // of 0.096 of the facets
}

TEST(SmoothMesh, TakesTheNormalsThatAreKnown)
{
    // One triangle of a sphere, whose normals no neighbour tells.
    TriMesh mesh;
    mesh.position.resize(3, 3);
    mesh.position << 0, 3, 0, 0, 0, 3, 10, std::sqrt(91), std::sqrt(91);
    mesh.triangle = Eigen::Vector3i(0, 1, 2);
    EXPECT_EQ(smooth_mesh(mesh).mesh.vertices(), 3);
    const SmoothMesh smooth = smooth_mesh(mesh, {.chord = 1e-3}, {Eigen::Matrix3f(mesh.position.cast<float>() / 10)});
    EXPECT_GT(smooth.mesh.vertices(), 15);
    for (int v = 0; v < smooth.mesh.vertices(); ++v)
        EXPECT_NEAR(smooth.mesh.position.col(v).norm(), 10, 0.01);
    EXPECT_NEAR(smooth.chord, 10 - std::sqrt(100 - 4.5), 0.01); // the longest edge is 3 sqrt(2)
}

TEST(SmoothMesh, DoesNotDependOnWhereThePartLiesOrHowItIsNumbered)
{
    const shapes::KnownSheet sheet = shapes::known_sheets()[2];
    const TriMesh mesh = shapes::mesh_of(sheet, 8);
    const SmoothMesh smooth = smooth_mesh(mesh, {.chord = 0.01});
    const Eigen::Matrix3d turn = shapes::random_rotation(5);
    const Eigen::Vector3d shift(70, -30, 11);
    const SmoothMesh turned = smooth_mesh(shapes::transformed(mesh, turn, shift), {.chord = 0.01});
    ASSERT_EQ(turned.mesh.triangle, smooth.mesh.triangle);
    EXPECT_LT((turned.mesh.position - ((turn * smooth.mesh.position).colwise() + shift)).cwiseAbs().maxCoeff(), 1e-10);
    const shapes::Permuted other = shapes::permuted(mesh, 9);
    const SmoothMesh renumbered = smooth_mesh(other.mesh, {.chord = 0.01});
    EXPECT_EQ(renumbered.mesh.vertices(), smooth.mesh.vertices());
    EXPECT_NEAR(area(renumbered.mesh), area(smooth.mesh), 1e-9 * area(smooth.mesh));
}

TEST(SmoothMesh, LeadsBackToTheFacets)
{
    const shapes::KnownSheet sheet = shapes::known_sheets()[1];
    const TriMesh mesh = shapes::mesh_of(sheet, 5);
    const SmoothMesh smooth = smooth_mesh(mesh, {.chord = 0.05});
    const Eigen::MatrixXd carried = smooth.at_vertices(mesh, mesh.position);
    EXPECT_EQ(carried.leftCols(mesh.vertices()), mesh.position);
    shapes::SeededRandom random(1);
    for (int sample = 0; sample < 200; ++sample) {
        MeshPoint place;
        place.face = random.whole(0, smooth.mesh.triangles() - 1);
        const double a = random.between(0, 1), b = random.between(0, 1 - a);
        place.barycentric = {a, b, 1 - a - b};
        const MeshPoint there = smooth.in_facets(place);
        Eigen::Vector3d one = Eigen::Vector3d::Zero(), other = one;
        for (int k = 0; k < 3; ++k) {
            one += place.barycentric[k] * carried.col(smooth.mesh.triangle(k, place.face));
            other += there.barycentric[k] * mesh.position.col(mesh.triangle(k, there.face));
        }
        EXPECT_LT((one - other).norm(), 1e-12 * sheet.size);
    }
}

} // namespace spia
