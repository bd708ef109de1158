#include "engine/unfold/plan/bends.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "engine/unfold/plan/turns.h"
#include "tests/support/bent_family.h"
#include "tests/support/bent_parts.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

using shapes::Profile;
using std::numbers::pi;

struct BentProfile {
    const char* name;
    Profile profile;
    double length;
    int triangles;
};
std::ostream& operator<<(std::ostream& out, const BentProfile& shape) { return out << shape.name; }

class Profiles : public testing::TestWithParam<BentProfile> {};

/// Whether two labellings split the faces alike. @param face face f of the first is face[f] of the
/// second
void expect_same_split(const Eigen::VectorXi& first, const Eigen::VectorXi& second, const std::vector<int>& face)
{
    std::map<int, int> there, back;
    for (int f = 0; f < first.size(); ++f) {
        const int a = first[f], b = second[face[size_t(f)]];
        ASSERT_EQ(there.try_emplace(a, b).first->second, b) << "face " << f;
        ASSERT_EQ(back.try_emplace(b, a).first->second, a) << "face " << f;
    }
}

std::vector<int> same_faces(int count)
{
    std::vector<int> face(static_cast<size_t>(count));
    for (int f = 0; f < count; ++f)
        face[size_t(f)] = f;
    return face;
}

TriMesh without_face(TriMesh mesh, int face)
{
    mesh.triangle.col(face) = mesh.triangle.col(mesh.triangles() - 1).eval();
    mesh.triangle.conservativeResize(3, mesh.triangles() - 1);
    return mesh;
}

} // namespace

TEST_P(Profiles, AreSplitAtTheirArcsWhateverTheirAngle)
{
    const BentProfile& shape = GetParam();
    const TriMesh part = shapes::extruded(shape.profile, shape.length, shape.triangles).mesh;
    const BendMap map = find_bends(part);
    // The pieces of the profile, in its order, and what the labels say along it.
    std::vector<const Profile::Piece*> arcs, flats;
    for (const Profile::Piece& piece : shape.profile.pieces())
        (std::abs(piece.curvature) > 1.0 / 20 ? arcs : flats).push_back(&piece);
    ASSERT_EQ(map.regions.size(), flats.size());
    ASSERT_EQ(map.bends.size(), arcs.size());
    std::vector<double> wanted, found;
    for (const auto* flat : flats)
        wanted.push_back((flat->to - flat->from) * shape.length);
    for (const SheetRegion& region : map.regions)
        found.push_back(region.area);
    std::sort(wanted.begin(), wanted.end());
    std::sort(found.begin(), found.end());
    for (size_t k = 0; k < wanted.size(); ++k)
        EXPECT_NEAR(found[k], wanted[k], 1e-3 * wanted[k])
            << "area of a flat piece: the mesh has a row at every bend line";
    for (const Bend& bend : map.bends) {
        EXPECT_GE(bend.b, 0) << "joins two regions";
        EXPECT_NEAR(bend.length, shape.length, 1e-6 * shape.length);
        const auto like = std::find_if(arcs.begin(), arcs.end(), [&](const auto* arc) {
            // to the left, where the outer side is
            const double angle = -(arc->to - arc->from) * arc->curvature;
            return std::abs(bend.angle - angle) < 0.02 && std::abs(bend.radius * std::abs(arc->curvature) - 1) < 0.12;
        });
        EXPECT_NE(like, arcs.end()) << "no arc turns by " << bend.angle << " over " << bend.radius << " mm";
        if (like != arcs.end())
            arcs.erase(like);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Bends, Profiles,
    testing::Values(
        BentProfile{"hat",
                    Profile({0, 0}, 0)
                        .straight(30)
                        .bend(8, pi / 2)
                        .straight(35)
                        .bend(8, -pi / 2)
                        .straight(60)
                        .bend(8, -pi / 2)
                        .straight(35)
                        .bend(8, pi / 2)
                        .straight(30),
                    200, 4000},
        BentProfile{"Z", Profile({0, 0}, 0).straight(40).bend(5, pi / 2).straight(30).bend(5, -pi / 2).straight(40),
                    120, 3000},
        BentProfile{"shallow Z",
                    Profile({0, 0}, 0).straight(40).bend(5, pi / 9).straight(30).bend(5, -pi / 9).straight(40), 120,
                    3000},
        BentProfile{"U with returned flanges",
                    Profile({0, 0}, -pi / 2)
                        .straight(8)
                        .bend(6, -pi / 2)
                        .straight(12)
                        .bend(6, -pi / 2)
                        .straight(40)
                        .bend(6, -pi / 2)
                        .straight(60)
                        .bend(6, -pi / 2)
                        .straight(40)
                        .bend(6, -pi / 2)
                        .straight(12)
                        .bend(6, -pi / 2)
                        .straight(8),
                    200, 6000},
        BentProfile{"hem", Profile({0, 0}, 0).straight(60).bend(3, pi).straight(15), 120, 8000},
        BentProfile{"spiral hem", Profile({0, 0}, 0).straight(60).bend(6, 1.5 * pi).straight(8), 120, 6000},
        BentProfile{"cylinder panel with flange", Profile({0, 0}, 0).bend(150, pi / 3).bend(5, pi / 2).straight(20),
                    150, 12000}),
    [](const auto& each) {
        std::string n = each.param.name;
        std::replace(n.begin(), n.end(), ' ', '_');
        return n;
    });

TEST(Bends, TheSplitDependsNeitherOnNumbersNorOnPlaceAndSize)
{
    const TriMesh part = shapes::round_cup({.triangles = 3000});
    const BendMap map = find_bends(part);
    EXPECT_GE(map.regions.size(), 3u);
    const shapes::Permuted other = shapes::permuted(part, 7);
    expect_same_split(map.label, find_bends(other.mesh).label, other.face);
    for (const double size : {1e-3, 40.0}) {
        const TriMesh moved =
            shapes::transformed(shapes::scaled(part, size), shapes::random_rotation(3), {500, -20, 7});
        const BendMap there = find_bends(moved);
        expect_same_split(map.label, there.label, same_faces(part.triangles()));
        ASSERT_EQ(there.bends.size(), map.bends.size());
        for (size_t k = 0; k < map.bends.size(); ++k) {
            EXPECT_NEAR(there.bends[k].angle, map.bends[k].angle, 1e-6);
            EXPECT_NEAR(there.bends[k].radius, size * map.bends[k].radius, 1e-6 * size);
        }
    }
    TriMesh turned = part;
    turned.triangle.row(1).swap(turned.triangle.row(2));
    const BendMap inside = find_bends(turned);
    for (size_t k = 0; k < map.bends.size(); ++k)
        EXPECT_NEAR(inside.bends[k].angle, -map.bends[k].angle, 1e-6) << "what bulges is hollow from the other side";
}

TEST(Bends, FlatsOfTwoTrianglesAndOfThousandsAreTheSameRegions)
{
    const auto channel = [](int rows, int cells) { // of flats 60 x 200 and 30 x 200 with radii of 5
                                                   // in six facets
        const Profile profile =
            Profile({0, 0}, 0).straight(30).bend(5, pi / 2).straight(60).bend(5, -pi / 2).straight(30);
        std::vector<double> s = {0};
        for (const Profile::Piece& piece : profile.pieces()) {
            const int n = piece.curvature == 0 ? cells : 6;
            for (int i = 1; i <= n; ++i)
                s.push_back(piece.from + (piece.to - piece.from) * i / n);
        }
        std::vector<shapes::Patch> patches;
        for (size_t i = 0; i + 1 < s.size(); ++i) {
            const Eigen::Vector2d p = profile.at(s[i]), q = profile.at(s[i + 1]);
            patches.push_back({{Eigen::Vector3d(p[0], 0, p[1]), Eigen::Vector3d(q[0], 0, q[1]),
                                Eigen::Vector3d(q[0], 200, q[1]), Eigen::Vector3d(p[0], 200, p[1])},
                               1,
                               rows});
        }
        return shapes::patchwork(patches);
    };
    const BendMap coarse = find_bends(channel(1, 1)), fine = find_bends(channel(40, 20));
    ASSERT_EQ(coarse.regions.size(), 3u);
    ASSERT_EQ(fine.regions.size(), 3u);
    ASSERT_EQ(coarse.bends.size(), 2u);
    for (size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(coarse.regions[k].area, fine.regions[k].area, 1e-6 * fine.regions[k].area);
    for (size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(std::abs(coarse.bends[k].angle), pi / 2, 1e-6);
}

TEST(Bends, AShallowEdgeBetweenFlatsIsNoBendInACoarseMeshNorInAFineOne)
{
    for (const double degrees : {15, 25})
        for (const int cells : {1, 40}) {
            const double angle = degrees * pi / 180;
            const Eigen::Vector3d over(60 * std::cos(angle), 0, -60 * std::sin(angle)), along(0, 100, 0);
            const Eigen::Vector3d a(-60, 0, 0), b(0, 0, 0);
            const BendMap map = find_bends(shapes::patchwork(
                {{{a, b, b + along, a + along}, cells, cells}, {{b, over, over + along, b + along}, cells, cells}}));
            EXPECT_EQ(map.regions.size(), degrees < 20 ? 1u : 2u) << cells << " cells, " << degrees << " degrees";
        }
}

TEST(Bends, TheLengthOfABendIsThatAlongItThoughTheMeshZigzags)
{
    // two bends whole, one whole, one cut by holes
    const BendMap map = find_bends(shapes::perforated_channel().mesh);
    ASSERT_EQ(map.regions.size(), 5u);
    for (size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(map.bends[k].length, 200, 2);
    EXPECT_GT(map.bends.size(), 4u) << "a hole parts a bend";
}

TEST(Bends, SharpEdgesOfABoxAreListedWithTheirLengths)
{
    const BendMap map = find_bends(shapes::lipped_box());
    ASSERT_EQ(map.regions.size(), 9u);
    std::vector<double> length;
    for (const Bend& bend : map.bends) {
        EXPECT_EQ(bend.faces, 0);
        EXPECT_NEAR(bend.angle, pi / 2, 1e-9);
        EXPECT_EQ(bend.radius, 0);
        length.push_back(std::round(bend.length));
    }
    EXPECT_EQ(length, (std::vector<double>{100, 100, 80, 80, 70, 70, 50, 50, 30, 30, 30, 30}));
    EXPECT_NEAR(map.regions[0].area, 7000, 1e-6);
    EXPECT_EQ(map.label_of_bend(0), -1);
}

TEST(Bends, ACurvedBendLineHasTheRadiusOfItsProfileAndTheLengthOfItsArc)
{
    const Profile profile =
        Profile({100, 0}, 0).straight(60).bend(6, pi / 2).straight(20).bend(4, -pi / 2).straight(12);
    const BendMap map = find_bends(shapes::swept(profile, pi / 3, 2));
    ASSERT_EQ(map.regions.size(), 3u);
    ASSERT_EQ(map.bends.size(), 2u);
    EXPECT_NEAR(std::abs(map.bends[0].angle), pi / 2, 0.03);
    EXPECT_NEAR(map.bends[0].radius, 6, 0.3); // area over the mean border: the arc's middle lies a
                                              // little farther out
    EXPECT_NEAR(map.bends[0].length, pi / 3 * 163, 1);
    EXPECT_NEAR(map.bends[1].radius, 4, 0.3);
    EXPECT_NEAR(map.bends[1].length, pi / 3 * 168, 1);
}

TEST(Bends, AWallAllAroundIsOneRegionThoughItLooksEveryWay)
{
    const BendMap map = find_bends(shapes::round_cup());
    ASSERT_EQ(map.regions.size(), 3u);
    ASSERT_EQ(map.bends.size(), 2u);
    const auto wall = std::min_element(map.regions.begin(), map.regions.end(),
                                       [](const auto& x, const auto& y) { return x.flatness < y.flatness; });
    EXPECT_LT(wall->flatness, 0.01);
    EXPECT_NEAR(wall->area, 2 * pi * 40 * 22, 0.06 * 2 * pi * 40 * 22);
    for (const Bend& bend : map.bends) {
        EXPECT_TRUE(bend.a == int(wall - map.regions.begin()) || bend.b == int(wall - map.regions.begin()));
        EXPECT_NEAR(std::abs(bend.angle), pi / 2, 0.12) << "a row of vertices lies beside the bend line";
    }
}

TEST(Bends, GentlyCurvedSheetIsOneRegion)
{
    for (const TriMesh& part : {shapes::sphere_cap().mesh, shapes::saddle(), shapes::quarter_cylinder().mesh,
                                shapes::cone_sector().mesh, shapes::plate()}) {
        const BendMap map = find_bends(part);
        EXPECT_EQ(map.regions.size(), 1u);
        EXPECT_TRUE(map.bends.empty());
        EXPECT_NEAR(map.regions[0].area, area(part), 1e-9 * area(part));
    }
}

TEST(Bends, NoiseOfAScanMakesNoRegions)
{
    const TriMesh clean = shapes::hat_channel({.triangles = 8000}).mesh;
    const BendMap exact = find_bends(clean);
    for (const double noise : {0.1, 0.3}) { // mm, at edges of 3.4 mm
        const BendMap map = find_bends(shapes::noisy(clean, noise));
        EXPECT_TRUE(map.smoothed);
        ASSERT_EQ(map.regions.size(), 5u) << noise;
        std::map<std::pair<int, int>, int> together;
        for (int f = 0; f < clean.triangles(); ++f)
            if (exact.label[f] < 5)
                ++together[{exact.label[f], map.label[f]}];
        for (int r = 0; r < 5; ++r) {
            int most = 0;
            for (const auto& [labels, count] : together)
                if (labels.first == r)
                    most = std::max(most, count);
            EXPECT_GT(most, 0.75 * exact.regions[size_t(r)].faces) << "all but the rows beside the bends";
        }
    }
    EXPECT_FALSE(exact.smoothed);
}

TEST(Bends, AnExactMeshThatIsCoarseAtItsBendsIsNoScan)
{
    int rough = 0;
    // bends of 90 degrees by two rows of faces
    for (const shapes::BentShape& shape : shapes::bent_family(600, 6)) {
        const TriMesh part = shape.make().mesh;
        rough += sheet_turns(part).roughness > 0.01;
        EXPECT_FALSE(find_bends(part).smoothed) << shape.name();
    }
    EXPECT_GE(rough, 5) << "or this test shows nothing";
    const TriMesh scan = shapes::noisy(shapes::lipped_channel({.triangles = 600}).mesh, 0.1);
    EXPECT_TRUE(find_bends(scan).smoothed);
}

TEST(Bends, APlaceOfEachRegionLiesInIt)
{
    const TriMesh part = shapes::round_cup();
    const BendMap map = find_bends(part);
    for (size_t r = 0; r < map.regions.size(); ++r) {
        const FaceSet faces = map.faces_of(int(r));
        EXPECT_EQ(int(faces.size()), map.regions[r].faces);
        EXPECT_TRUE(std::any_of(faces.begin(), faces.end(), [&](int f) {
            const Eigen::Vector3d middle = part.position(Eigen::all, part.triangle.col(f)).rowwise().mean();
            return (middle - map.regions[r].place).norm() < 1e-9;
        }));
    }
    EXPECT_EQ(map.name(0), "region 1");
    EXPECT_EQ(map.name(int(map.regions.size())), "bend 1");
}

TEST(Bends, RefusesWhatIsNoSheetAndSaysWhy)
{
    TriMesh part = shapes::rectangle(10, 10, 4, 4);
    part.triangle.col(5) << 1, 1, 2;
    try {
        find_bends(part);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("face 5 has no area"), std::string::npos) << error.what();
    }
    TriMesh fin = shapes::rectangle(10, 10, 1, 1);
    fin.position.conservativeResize(3, 5);
    fin.position.col(4) << 5, 5, 9;
    fin.triangle.conservativeResize(3, 3);
    const Eigen::Vector3i first = fin.triangle.col(0), second = fin.triangle.col(1);
    std::vector<int> common;
    for (const int v : first)
        if ((second.array() == v).any())
            common.push_back(v);
    fin.triangle.col(2) << common[0], common[1], 4;
    EXPECT_THROW(find_bends(fin), InputError);
    EXPECT_THROW(find_bends(TriMesh{Eigen::Matrix3Xd(3, 0), Eigen::Matrix3Xi(3, 0)}), InputError);
    EXPECT_THROW(find_bends(shapes::plate(), {.curvature = 0}), InputError);
    EXPECT_EQ(find_bends(without_face(shapes::plate(), 3)).regions.size(), 1u);
}

} // namespace spia
