// Parts that no sheet can become as they are: where they are cut open, and what is left.
#include "engine/mesh/cut/cut.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <set>

#include "engine/core/error.h"
#include "engine/mesh/cut/ring_strain.h"
#include "engine/mesh/edge_graph.h"
#include "engine/mesh/topology.h"
#include "tests/support/grid_surface.h"
#include "tests/support/inner_panel.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"
#include "tests/support/square_cup.h"

namespace spia {
namespace {

using shapes::Cell;
using std::numbers::pi;

/// What every cut must keep: the faces where they were, the copies behind their originals, and one
/// sheet.
void expect_the_same_part_as_a_sheet(const CutPart& cut, const TriMesh& part)
{
    ASSERT_EQ(cut.mesh.triangles(), part.triangles());
    ASSERT_EQ(int(cut.source.size()), cut.mesh.vertices());
    EXPECT_TRUE(std::is_sorted(cut.source.begin(), cut.source.end()));
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = cut.mesh.triangle(k, f);
            ASSERT_EQ(cut.source[size_t(v)], part.triangle(k, f));
            ASSERT_EQ(cut.mesh.position.col(v), part.position.col(part.triangle(k, f)));
        }
    const SurfaceType type = surface_type(cut.mesh);
    EXPECT_EQ(type.components, 1);
    EXPECT_EQ(type.genus, 0);
    EXPECT_GE(type.loops, 1);
    // The seam is its own length, and each of its edges is now an edge of the boundary, once on
    // either side.
    double length = 0;
    int edges = 0;
    for (const auto& row : cut.seam)
        for (size_t i = 1; i < row.size(); ++i, ++edges)
            length += (part.position.col(row[i]) - part.position.col(row[i - 1])).norm();
    EXPECT_NEAR(cut.length, length, 1e-9 * (1 + length));
    size_t before = 0, after = 0;
    for (const auto& loop : boundary_loops(part))
        before += loop.size();
    for (const auto& loop : boundary_loops(cut.mesh))
        after += loop.size();
    EXPECT_EQ(after, before + 2 * size_t(edges));
}

/// A ring of cubes: the outer square of a x b without its inside.
std::set<Cell> frame(int a, int b, int windows = 1)
{
    std::set<Cell> cubes;
    for (int i = 0; i < a; ++i)
        for (int j = 0; j < b; ++j) {
            const bool rim = i == 0 || i == a - 1 || j == 0 || j == b - 1;
            const bool bar = windows == 2 && i == a / 2;
            if (rim || bar)
                cubes.insert({i, j, 0});
        }
    return cubes;
}

std::string complaint(const TriMesh& part, const std::vector<std::vector<int>>& path)
{
    try {
        cut_open(part, {SeamOptions::Mode::given, path});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(SurfaceTypeOf, CountsPiecesLoopsAndHandles)
{
    const auto expect = [](const TriMesh& mesh, int components, int loops, int genus) {
        const SurfaceType type = surface_type(mesh);
        EXPECT_EQ(type.components, components);
        EXPECT_EQ(type.loops, loops);
        EXPECT_EQ(type.genus, genus);
    };
    expect(shapes::rectangle(3, 2, 3, 2), 1, 1, 0);
    expect(shapes::two_rectangles(), 2, 2, 0);
    expect(shapes::pipe(10, 10, 20, 12, 4), 1, 2, 0);
    expect(shapes::torus(30, 10, 400), 1, 0, 1);
    expect(shapes::body_surface(frame(5, 3, 2), 10, 1), 1, 0, 2);
}

TEST(CutOpen, LeavesSheetsWithHolesAlone)
{
    const TriMesh ring = shapes::without_faces(shapes::sharp_cup({.radius = 60, .height = 10, .triangles = 3000}).mesh,
                                               [](const Eigen::Vector3d& x) { return x.head<2>().norm() < 30; });
    for (const TriMesh& part : {shapes::plate(), shapes::inner_panel({.triangles = 6000}).mesh, ring,
                                shapes::grid_surface({60, 8, true, false},
                                                     // a flat ring
                                                     [](double u, double v) -> Eigen::Vector3d {
                                                         return (20 + 40 * v) * Eigen::Vector3d(std::cos(2 * pi * u),
                                                                                                -std::sin(2 * pi * u),
                                                                                                0);
                                                     }),
                                // a collar: a third of its width high
                                shapes::pipe(50, 50, 35, 60, 7), shapes::pipe(60, 20, 10, 60, 8)}) {
        ASSERT_GT(boundary_loops(part).size(), 1u);
        const CutPart cut = cut_open(part);
        EXPECT_TRUE(cut.seam.empty()) << cut.why;
        EXPECT_EQ(cut.mesh.triangle, part.triangle);
        EXPECT_EQ(cut.length, 0);
        std::vector<int> count(size_t(part.vertices()));
        std::iota(count.begin(), count.end(), 0);
        EXPECT_EQ(cut.source, count);
    }
}

TEST(CutOpen, CutsATubeAlongOneGenerator)
{
    const TriMesh tube = shapes::pipe(25, 25, 100, 40, 25);
    const CutPart cut = cut_open(tube);
    expect_the_same_part_as_a_sheet(cut, tube);
    ASSERT_EQ(cut.seam.size(), 1u);
    EXPECT_EQ(cut.seam[0].size(), 26u);
    EXPECT_NEAR(cut.length, 100, 1e-9);
    EXPECT_EQ(boundary_loops(cut.mesh).size(), 1u);
    EXPECT_NE(cut.why.find("tube"), std::string::npos);
    // a little more than a collar
    EXPECT_EQ(cut_open(shapes::pipe(50, 50, 50, 60, 10)).seam.size(), 1u);
    EXPECT_TRUE(cut_open(tube, {SeamOptions::Mode::none}).seam.empty());
}

TEST(CutOpen, CutsAConeButNotTheShallowOne)
{
    // The lines around a cone grow by 2 pi sin(alpha): the scale of the ring by (1 / sin(alpha) -
    // 1) ln(ratio).
    const TriMesh steep = shapes::pipe(20, 60, 150, 48, 30), shallow = shapes::pipe(20, 60, 30, 48, 16);
    expect_the_same_part_as_a_sheet(cut_open(steep), steep);
    EXPECT_EQ(cut_open(steep).seam.size(), 1u);
    EXPECT_TRUE(cut_open(shallow).seam.empty());
}

TEST(CutOpen, CutsEveryBranchOfAPipe)
{
    // Three arms of cubes, open at their ends.
    std::set<Cell> cubes;
    for (int i = -4; i <= 4; ++i)
        cubes.insert({i, 0, 0});
    for (int i = 1; i <= 4; ++i)
        cubes.insert({0, i, 0});
    const TriMesh part = shapes::body_surface(cubes, 10, 3, [](const Cell& cube, const Eigen::Vector3i& outwards) {
        return cube[0] * outwards[0] == 4 || cube[1] * outwards[1] == 4;
    });
    ASSERT_EQ(boundary_loops(part).size(), 3u);
    const CutPart cut = cut_open(part);
    expect_the_same_part_as_a_sheet(cut, part);
    EXPECT_EQ(boundary_loops(cut.mesh).size(), 1u);
}

TEST(CutOpen, OfATorusTakesItsTwoShortestCircles)
{
    // The tube's circle, 2 pi r, and the inner equator, 2 pi (R - r).
    const TriMesh torus = shapes::torus(60, 20, 4000);
    const CutPart cut = cut_open(torus);
    expect_the_same_part_as_a_sheet(cut, torus);
    EXPECT_EQ(boundary_loops(cut.mesh).size(), 1u);
    EXPECT_NEAR(cut.length, 2 * pi * 20 + 2 * pi * 40, 0.02 * 2 * pi * 60);
}

TEST(CutOpen, OfTwoHandlesIsTheShortestOnTheCubes)
{
    // A frame of cubes with one window of 1 x 1: around the window 4, around a bar 4, and they
    // meet.
    const TriMesh one = shapes::body_surface(frame(3, 3), 10, 2);
    const CutPart cut = cut_open(one);
    expect_the_same_part_as_a_sheet(cut, one);
    EXPECT_NEAR(cut.length, 80, 1e-9);
    const TriMesh two = shapes::body_surface(frame(5, 3, 2), 10, 2);
    const CutPart both = cut_open(two);
    expect_the_same_part_as_a_sheet(both, two);
    EXPECT_EQ(boundary_loops(both.mesh).size(), 1u);
    EXPECT_LE(both.length, 170 + 1e-9); // two of the ones above, joined over the middle bar
    EXPECT_GE(both.length, 120 - 1e-9);
}

TEST(CutOpen, OpensAHandleOfASheetAndKeepsItsHoles)
{
    // A plate with an arch on it; the plate has a border and a hole of its own.
    std::set<Cell> cubes;
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 5; ++j)
            cubes.insert({i, j, 0});
    for (const auto& [i, k] : {std::pair(3, 1), {5, 1}, {3, 2}, {4, 2}, {5, 2}})
        cubes.insert({i, 2, k});
    const TriMesh part = shapes::body_surface(cubes, 10, 2, [](const Cell& cube, const Eigen::Vector3i& outwards) {
        return outwards[2] < 0 ? cube[2] == 0 : cube[2] == 0 && (outwards[2] == 0 || (cube[0] == 1 && cube[1] == 1));
    });
    ASSERT_EQ(surface_type(part).genus, 1);
    ASSERT_EQ(surface_type(part).loops, 2);
    const CutPart cut = cut_open(part);
    expect_the_same_part_as_a_sheet(cut, part);
    EXPECT_LE(cut.length, 80 + 1e-9); // around a leg and through the arch
}

TEST(CutOpen, OfALittleHandleOnALargeSheetStaysThere)
{
    std::set<Cell> cubes;
    for (int i = 0; i < 71; ++i)
        for (int j = 0; j < 71; ++j)
            cubes.insert({i, j, 0});
    for (const auto& [i, k] : {std::pair(34, 1), {36, 1}, {34, 2}, {35, 2}, {36, 2}})
        cubes.insert({i, 35, k});
    const TriMesh part = shapes::body_surface(cubes, 10, 1, [](const Cell& cube, const Eigen::Vector3i& outwards) {
        return cube[2] == 0 && outwards[2] <= 0;
    });
    const CutPart cut = cut_open(part);
    expect_the_same_part_as_a_sheet(cut, part);
    EXPECT_LE(cut.length, 110); // around a leg and through the arch, with no way to them
    for (const auto& row : cut.seam)
        for (const int v : row)
            EXPECT_LE((part.position.col(v) - Eigen::Vector3d(355, 355, 20)).norm(), 50);
}

TEST(CutOpen, OfAClosedPartRunsBetweenItsFarthestPoints)
{
    const TriMesh sphere = shapes::closed_sphere(50, 2000);
    const CutPart cut = cut_open(sphere);
    expect_the_same_part_as_a_sheet(cut, sphere);
    ASSERT_EQ(cut.seam.size(), 1u);
    EXPECT_GT(cut.length, 0.95 * pi * 50);
    EXPECT_LT(cut.length, 1.15 * pi * 50);
    TriMesh tetrahedron;
    tetrahedron.position.resize(3, 4);
    tetrahedron.position << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
    tetrahedron.triangle.resize(3, 4);
    tetrahedron.triangle << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
    expect_the_same_part_as_a_sheet(cut_open(tetrahedron), tetrahedron);
}

TEST(CutOpen, PassesTheWindowsOfATube)
{
    // Ends half a width away from the windows: no collar, and still one tube.
    const TriMesh whole = shapes::pipe(30, 30, 120, 40, 24);
    const TriMesh part = shapes::without_faces(whole, [](const Eigen::Vector3d& x) {
        const double place = std::fmod(std::atan2(x[1], x[0]) / (2 * pi) * 4 + 4, 1);
        return place > 0.25 && place < 0.75 && x[2] > 25 && x[2] < 95;
    });
    ASSERT_EQ(boundary_loops(part).size(), 6u);
    const CutPart cut = cut_open(part);
    expect_the_same_part_as_a_sheet(cut, part);
    EXPECT_LE(cut.length, 55); // 25 and 25 mm: through a window, whose edge is open already
    EXPECT_EQ(boundary_loops(cut.mesh).size(), 4u);
}

TEST(CutOpen, OpensABottleButNotACup)
{
    const TriMesh bottle = shapes::sphere_cap({.radius = 50, .half_angle_deg = 172, .triangles = 1500}).mesh;
    const CutPart cut = cut_open(bottle);
    expect_the_same_part_as_a_sheet(cut, bottle);
    EXPECT_NEAR(cut.length, 50 * 172 * pi / 180, 15); // to the pole
    EXPECT_NE(cut.why.find("mouth"), std::string::npos);
    for (const double half_angle : {90.0, 120.0, 160.0})
        EXPECT_TRUE(cut_open(shapes::sphere_cap({.half_angle_deg = half_angle, .triangles = 1500}).mesh).seam.empty());
    EXPECT_TRUE(cut_open(shapes::sharp_cup({.radius = 10, .height = 120, .triangles = 2000}).mesh).seam.empty());
}

TEST(CutOpen, SaysWhatAGivenSeamLeavesThatWouldHaveBeenCut)
{
    const auto why = [](const TriMesh& part, std::vector<std::vector<int>> path) {
        return cut_open(part, {SeamOptions::Mode::given, std::move(path)}).why;
    };
    const TriMesh tube = shapes::pipe(25, 25, 100, 40, 25); // 40 vertices a row, or 26 a line: by
                                                            // their places
    const auto at_height = [&](double z) {
        const Eigen::RowVectorXd off = (tube.position.colwise() - Eigen::Vector3d(25, 0, z)).colwise().squaredNorm();
        Eigen::Index nearest = 0;
        off.minCoeff(&nearest);
        return int(nearest);
    };
    const double low = tube.position.row(2).minCoeff(), high = tube.position.row(2).maxCoeff();
    ASSERT_NEAR(high - low, 100, 1e-9);
    EXPECT_NE(why(tube, {{at_height(low), at_height((low + high) / 2)}}).find("still a tube"), std::string::npos);
    EXPECT_EQ(why(tube, {{at_height(low), at_height(high)}}), "as it was given");
    const TriMesh plate = shapes::rectangle(40, 30, 4, 3);
    EXPECT_EQ(why(plate, {{2, 7, 12}}), "as it was given");
    const TriMesh bottle = shapes::sphere_cap({.radius = 50, .half_angle_deg = 172, .triangles = 1500}).mesh;
    const std::vector<int> mouth = boundary_loops(bottle).front();
    const auto [first, second] = [&] { // from the mouth inwards by one edge
        for (int f = 0; f < bottle.triangles(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int a = bottle.triangle(k, f), b = bottle.triangle((k + 1) % 3, f);
                const auto at_mouth = [&](int v) { return std::find(mouth.begin(), mouth.end(), v) != mouth.end(); };
                if (at_mouth(a) && !at_mouth(b))
                    return std::pair(a, b);
            }
        return std::pair(-1, -1);
    }();
    EXPECT_NE(why(bottle, {{first, second}}).find("still a bottle"), std::string::npos);
}

TEST(CutOpen, GoesWhereItIsTold)
{
    const TriMesh tube = shapes::pipe(25, 25, 100, 40, 25);
    // half way around
    const CutPart cut = cut_open(tube, {SeamOptions::Mode::given, {{7, 25 * 40 + 27}}});
    expect_the_same_part_as_a_sheet(cut, tube);
    EXPECT_EQ(cut.seam[0].front() + cut.seam[0].back(), 7 + 25 * 40 + 27);
    EXPECT_GT(cut.length, std::hypot(100, 25 * pi) - 1);
    // A slit from the edge of a plate inwards: the other copy of the end on the edge follows its
    // original.
    const TriMesh plate = shapes::rectangle(40, 30, 4, 3);
    const CutPart slit = cut_open(plate, {SeamOptions::Mode::given, {{2, 7, 12}}});
    expect_the_same_part_as_a_sheet(slit, plate);
    EXPECT_EQ(slit.mesh.vertices(), plate.vertices() + 2);
    EXPECT_EQ(slit.source[3], 2);
    EXPECT_DOUBLE_EQ(slit.length, 20);
}

TEST(CutOpen, SaysWhatAGivenSeamLacks)
{
    const TriMesh plate = shapes::rectangle(40, 30, 4, 3);
    EXPECT_NE(complaint(plate, {{2, 17}}).find("2 pieces"), std::string::npos);
    EXPECT_NE(complaint(plate, {{2}}).find("fewer than two"), std::string::npos);
    EXPECT_NE(complaint(plate, {{2, 99}}).find("vertex 99"), std::string::npos);
    EXPECT_NE(complaint(plate, {{2, 2}}).find("no path along edges"), std::string::npos);
    EXPECT_NE(complaint(shapes::torus(60, 20, 400), {{0, 1}}).find("still closed"), std::string::npos);
    EXPECT_NE(complaint(shapes::torus(60, 20, 400), {{0, 1, 2}}).find("a handle"), std::string::npos);
}

TEST(CutAlong, MakesAsManyCopiesAsPiecesMeet)
{
    const TriMesh plate = shapes::rectangle(20, 20, 2, 2); // vertex 4 in the middle
    const CutPart cross = cut_along(plate, {{1, 4}, {4, 7}, {3, 4}, {4, 5}});
    EXPECT_EQ(std::count(cross.source.begin(), cross.source.end(), 4), 4);
    EXPECT_EQ(std::count(cross.source.begin(), cross.source.end(), 1), 2);
    EXPECT_EQ(surface_type(cross.mesh).components, 4);
    EXPECT_THROW(cut_along(plate, {{0, 8}}), InputError);
}

TEST(EdgePaths, ReachAFreeRimAsAWhole)
{
    // Symmetric about the diagonal from which the ways start: two of the same length lead to the
    // rim.
    const TriMesh part = shapes::without_faces(shapes::rectangle(80, 80, 8, 8), [](const Eigen::Vector3d& x) {
        return std::abs(x[0] - 40) < 20 && std::abs(x[1] - 40) < 20;
    });
    const EdgeGraph graph = edge_graph(part);
    const std::vector<int> rim = boundary_loops(part)[1];
    for (int source = 0; source < part.vertices(); ++source) {
        if (graph.on_rim[size_t(source)])
            continue;
        const EdgePaths paths = shortest_paths(graph, {source}, RimCost::none);
        int along = 0;
        for (const int v : rim) {
            const int e = paths.edge[size_t(v)];
            along += e >= 0 && graph.edge[size_t(e)].boundary();
            EXPECT_EQ(paths.distance[size_t(v)], paths.distance[size_t(rim[0])]);
        }
        EXPECT_EQ(along, int(rim.size()) - 1);
    }
}

TEST(FrontMarch, CrossesTrianglesStraight)
{
    // From the slanted side of a sheared rectangle no edge goes the shortest way.
    TriMesh part = shapes::rectangle(60, 40, 30, 20);
    const double shear = -0.5; // acute triangles: through obtuse ones fronts go along edges
    part.position.row(0) += shear * part.position.row(1);
    std::vector<int> side;
    for (int j = 0; j <= 20; ++j)
        side.push_back(31 * j);
    FrontMarch march(part);
    march.run(side, std::vector<char>(size_t(part.vertices()), 0));
    int compared = 0;
    for (int v = 0; v < part.vertices(); ++v) {
        const double x = part.position(0, v), y = part.position(1, v), before = x - shear * y;
        const double distance = before / std::hypot(1, shear);
        // of the plumb line on the side
        const double foot = y + shear * distance / std::hypot(1, shear);
        // the ends disturb their neighbourhood
        if (foot < 10 || foot > 30)
            continue;
        ASSERT_NEAR(march.distance(v), distance, 0.01 * distance); // along edges: 12 % too far
        ++compared;
    }
    EXPECT_GT(compared, 200);
}

TEST(RingStrain, OfATubeAConeAndAFlatRingIsTheClosedForm)
{
    const auto measured = [](const TriMesh& part, double end) {
        const auto loops = boundary_loops(part);
        size_t hole = 0;
        while (std::abs(part.position(2, loops[hole][0]) - end) > 1e-9)
            ++hole;
        std::vector<char> stop(size_t(part.vertices()), 0);
        for (const int v : loops[1 - hole])
            stop[size_t(v)] = 1;
        FrontMarch march(part);
        return ring_strain(march, loops[hole], stop);
    };
    constexpr double lines = 21.0 / 24; // of the reach, from the first line looked at to the last
    const RingStrain tube = measured(shapes::pipe(25, 25, 100, 80, 50), 0);
    EXPECT_NEAR(tube.reach, 100, 0.5);
    EXPECT_NEAR(tube.ring, lines * 2 * pi * 100 / (2 * pi * 25), 0.02);
    EXPECT_NEAR(tube.fan, 0, 0.02);
    // A cone of 30 degrees: the lines double and more from 20 to 60 mm of radius; 2 pi s sin(alpha)
    // longer at s.
    const double slope = std::sqrt(3.0);
    const RingStrain cone = measured(shapes::pipe(20, 60, 40 * slope, 96, 40), 0);
    EXPECT_NEAR(cone.reach, 80, 0.5);
    const double near = 20 + 0.5 * 80 * 1.5 / 24, far = 20 + 0.5 * 80 * 22.5 / 24;
    EXPECT_NEAR(cone.ring, (1 / 0.5 - 1) * std::log(far / near), 0.03);
    EXPECT_LT(cone.fan, 0.03);
}

} // namespace spia
