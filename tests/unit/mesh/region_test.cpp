#include "engine/mesh/region.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

#include "engine/mesh/topology.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

constexpr double degree = std::numbers::pi / 180;

FaceSet random_set(int faces, double share, unsigned seed)
{
    std::mt19937 random(seed);
    std::bernoulli_distribution in(share);
    FaceSet result;
    for (int f = 0; f < faces; ++f)
        if (in(random))
            result.push_back(f);
    return result;
}

FaceSet all(const TriMesh& mesh)
{
    FaceSet result(size_t(mesh.triangles()));
    std::iota(result.begin(), result.end(), 0);
    return result;
}

bool share_vertex(const TriMesh& mesh, int f, int g)
{
    for (const int v : mesh.triangle.col(f))
        if ((mesh.triangle.col(g).array() == v).any())
            return true;
    return false;
}

Eigen::Vector3d middle(const TriMesh& mesh, int f)
{
    return mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean();
}

/// Two plates of 40 x 30 that meet along y = 0 at an angle, as one mesh.
TriMesh angle_section(double angle)
{
    TriMesh mesh = shapes::rectangle(40, 60, 8, 12);
    for (auto place : mesh.position.colwise()) {
        const double y = place.y() - 30;
        place.y() = y <= 0 ? y : y * std::cos(angle);
        place.z() = y <= 0 ? 0 : y * std::sin(angle);
    }
    return mesh;
}

} // namespace

TEST(Region, SetsFollowTheLawsOfSets)
{
    const int faces = 500;
    const FaceSet a = random_set(faces, 0.4, 1), b = random_set(faces, 0.5, 2);
    const std::set<int> in_a(a.begin(), a.end()), in_b(b.begin(), b.end());
    const FaceSet u = united(a, b), d = without(a, b), i = inverted(a, faces);
    const std::set<int> in_u(u.begin(), u.end()), in_d(d.begin(), d.end()), in_i(i.begin(), i.end());
    for (int f = 0; f < faces; ++f) {
        EXPECT_EQ(in_u.count(f), in_a.count(f) | in_b.count(f));
        EXPECT_EQ(in_d.count(f), in_a.count(f) & ~in_b.count(f));
        EXPECT_NE(in_i.count(f), in_a.count(f));
    }
    for (const FaceSet* set : {&u, &d, &i})
        EXPECT_TRUE(std::is_sorted(set->begin(), set->end()));
    EXPECT_EQ(inverted(i, faces), a);
}

TEST(Region, GrowingTakesExactlyTheFacesThatTouchAndShrinkingLosesThoseThatTouchOthers)
{
    const TriMesh mesh = shapes::permuted(shapes::rectangle(30, 20, 12, 9), 5).mesh;
    for (const double share : {0.02, 0.9}) {
        const FaceSet set = random_set(mesh.triangles(), share, 3), others = inverted(set, mesh.triangles());
        const auto touches = [&](int f, const FaceSet& some) {
            return std::any_of(some.begin(), some.end(), [&](int g) { return share_vertex(mesh, f, g); });
        };
        FaceSet larger, smaller;
        for (int f = 0; f < mesh.triangles(); ++f) {
            if (touches(f, set))
                larger.push_back(f);
            if (!touches(f, others))
                smaller.push_back(f);
        }
        EXPECT_EQ(grown(mesh, set), larger);
        EXPECT_EQ(shrunk(mesh, set), smaller);
    }
    EXPECT_EQ(shrunk(mesh, all(mesh)), all(mesh)); // the edge of the sheet is not eaten away
    EXPECT_TRUE(grown(mesh, {}).empty());
}

TEST(Region, FloodStopsExactlyWhereTheSheetTurnsByMore)
{
    const TriMesh mesh = angle_section(20 * degree);
    const RegionSearch search(mesh);
    EXPECT_EQ(search.flood(0, 20.01 * degree), all(mesh));
    for (const int start : {0, mesh.triangles() - 1}) {
        const bool lower = middle(mesh, start).y() < 0;
        FaceSet side;
        for (int f = 0; f < mesh.triangles(); ++f)
            if ((middle(mesh, f).y() < 0) == lower)
                side.push_back(f);
        EXPECT_EQ(search.flood(start, 19.99 * degree), side);
        EXPECT_EQ(int(side.size()), mesh.triangles() / 2);
    }
}

TEST(Region, FloodDoesNotReachAnotherPiece)
{
    const TriMesh pieces = shapes::two_rectangles();
    const FaceSet one = RegionSearch(pieces).flood(0, std::numbers::pi);
    EXPECT_LT(int(one.size()), pieces.triangles());
    EXPECT_EQ(one, without(all(pieces), RegionSearch(pieces).flood(pieces.triangles() - 1, std::numbers::pi)));
}

TEST(Region, FloodByAnAngleIsWhatWalkingOverAllPairsOfFacesGives)
{
    const TriMesh mesh = shapes::permuted(shapes::saddle({.side = 100, .radius = 20, .triangles = 600}), 4).mesh;
    const Eigen::Matrix3Xd normal = area_vectors(mesh);
    const RegionSearch search(mesh);
    for (const double angle : {2 * degree, 5 * degree, 9 * degree}) {
        std::set<int> truth = {17};
        for (size_t before = 0; before != truth.size();) {
            before = truth.size();
            for (int f = 0; f < mesh.triangles(); ++f)
                for (const int g : std::set<int>(truth)) {
                    int common = 0;
                    for (const int v : mesh.triangle.col(f))
                        common += (mesh.triangle.col(g).array() == v).any();
                    const double cosine = normal.col(f).normalized().dot(normal.col(g).normalized());
                    if (common == 2 && std::acos(std::min(cosine, 1.)) <= angle)
                        truth.insert(f);
                }
        }
        EXPECT_EQ(search.flood(17, angle), FaceSet(truth.begin(), truth.end()));
    }
}

TEST(Region, SmoothPiecesOfAHatProfileAreItsFlatsAndItsBends)
{
    for (const int triangles : {12000, 40000}) {
        const shapes::HatChannel shape{.triangles = triangles};
        const shapes::DevelopablePart part = shapes::hat_channel(shape);
        // Across the flat sheet: flange, bend, wall, bend, top, bend, wall, bend, flange; a bend is
        // as wide as its chords.
        const Eigen::Vector2d least = part.flat.rowwise().minCoeff(), extent = part.flat.rowwise().maxCoeff() - least;
        Eigen::Index across = 0; // the axis of `flat` with the profile
        (extent.array() - shape.length).abs().maxCoeff(&across);
        const double flats = 2 * shape.flange + 2 * shape.wall + shape.top, bend = (extent[across] - flats) / 4;
        ASSERT_NEAR(bend, shape.radius * shape.angle_deg * degree, 0.1 * bend);
        std::vector<double> border = {0};
        for (const double width :
             {shape.flange, bend, shape.wall, bend, shape.top, bend, shape.wall, bend, shape.flange})
            border.push_back(border.back() + width);
        std::vector<FaceSet> piece(9);
        for (int f = 0; f < part.mesh.triangles(); ++f) {
            double at = 0;
            for (const int v : part.mesh.triangle.col(f))
                at += (part.flat(across, v) - least[across]) / 3;
            piece[size_t(std::upper_bound(border.begin(), border.end(), at) - border.begin()) - 1].push_back(f);
        }
        for (const double scale : {1., 1000.}) {
            const RegionSearch search(shapes::scaled(part.mesh, scale));
            for (const FaceSet& expected : piece)
                for (const size_t i : {size_t(0), expected.size() / 2, expected.size() - 1})
                    EXPECT_EQ(search.smooth_region(expected[i]), expected) << triangles << " " << i;
        }
    }
}

TEST(Region, AGentlyCurvedPieceEndsWhereABendBeginsAtAnySize)
{
    // Along the profile: an arc of radius 150, a quarter of radius 8, an arc of radius 150 again,
    // all tangent.
    const std::vector<double> radius = {150, 8, 150}, width = {100, 8 * std::numbers::pi / 2, 60};
    const std::vector<int> cells = {60, 6, 36};
    std::vector<Eigen::Vector2d> profile = {{0, 0}};
    double heading = 0;
    for (size_t piece = 0; piece < 3; ++piece)
        for (int i = 0; i < cells[piece]; ++i) { // chords
            const double turn = width[piece] / radius[piece] / cells[piece];
            const double chord = 2 * radius[piece] * std::sin(turn / 2);
            profile.push_back(profile.back() +
                              chord * Eigen::Vector2d(std::cos(heading + turn / 2), std::sin(heading + turn / 2)));
            heading += turn;
        }
    const int columns = int(profile.size()) - 1;
    TriMesh mesh = shapes::rectangle(columns, 60, columns, 15);
    for (auto place : mesh.position.colwise()) {
        const Eigen::Vector2d at = profile[size_t(std::lround(place.x()))];
        place = Eigen::Vector3d(at.x(), place.y(), at.y());
    }
    const TriMesh flat = shapes::rectangle(columns, 60, columns, 15);
    std::vector<FaceSet> piece(3);
    for (int f = 0; f < mesh.triangles(); ++f) {
        const double at = middle(flat, f).x();
        piece[at < 60 ? 0 : at < 66 ? 1 : 2].push_back(f);
    }
    for (const double scale : {0.001, 1., 1000.}) {
        const RegionSearch search(shapes::scaled(mesh, scale));
        for (const FaceSet& expected : piece)
            for (const int f : expected)
                ASSERT_EQ(search.smooth_region(f), expected) << "face " << f << " at scale " << scale;
    }
}

TEST(Region, AnEdgeOfThreeFacesSeparatesThem)
{
    TriMesh mesh; // three leaves along the z axis, the first one of two faces
    mesh.position.resize(3, 6);
    mesh.position << 0, 0, 1, -1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1;
    mesh.triangle.resize(3, 4);
    mesh.triangle << 0, 0, 0, 2, 2, 3, 4, 5, 1, 1, 1, 1;
    const RegionSearch search(mesh);
    EXPECT_EQ(search.flood(0, std::numbers::pi), (FaceSet{0, 3}));
    EXPECT_EQ(search.flood(1, std::numbers::pi), FaceSet{1});
    EXPECT_EQ(search.flood(2, std::numbers::pi), FaceSet{2});
}

TEST(Region, SmoothRegionEndsAtFeatureEdgesAndCoversGentleCurvature)
{
    const TriMesh edge = angle_section(50 * degree), dome = shapes::saddle();
    EXPECT_EQ(int(RegionSearch(edge).smooth_region(0).size()), edge.triangles() / 2);
    EXPECT_EQ(RegionSearch(dome).smooth_region(100), all(dome));
}

} // namespace spia
