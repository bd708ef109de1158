#include "engine/mesh/doctor/doctor.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

#include "engine/core/error.h"
#include "engine/mesh/halfedges.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

using Eigen::Vector3d;
using Faces = std::vector<std::vector<int>>;

PolygonSoup soup_of(std::vector<Vector3d> position, const Faces& faces)
{
    PolygonSoup soup;
    soup.position = std::move(position);
    for (const auto& face : faces)
        soup.add_polygon(face);
    return soup;
}

/// A rectangle of columns x rows unit quads, some of them missing.
PolygonSoup quads(int columns, int rows, const std::vector<int>& missing = {})
{
    PolygonSoup soup;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            soup.position.emplace_back(i, j, 0);
    for (int cell = 0; cell < columns * rows; ++cell) {
        const int a = cell % columns + cell / columns * (columns + 1);
        if (std::find(missing.begin(), missing.end(), cell) == missing.end())
            soup.add_polygon(std::array<int, 4>{a, a + 1, a + columns + 2, a + columns + 1});
    }
    return soup;
}

/// A band of n quads whose ends are joined after `half_turns` half turns.
PolygonSoup band(int n, int half_turns)
{
    PolygonSoup soup;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n, tilt = half_turns * angle / 2;
        const Vector3d out(std::cos(angle), std::sin(angle), 0),
            across = std::cos(tilt) * Vector3d::UnitZ() + std::sin(tilt) * out;
        soup.position.push_back(10 * out - across);
        soup.position.push_back(10 * out + across);
    }
    for (int i = 0; i < n; ++i) {
        const int a = 2 * i, b = 2 * i + 1, next = 2 * ((i + 1) % n);
        const bool swap = i + 1 == n && half_turns % 2 != 0;
        soup.add_polygon(std::array<int, 4>{a, swap ? next + 1 : next, swap ? next : next + 1, b});
    }
    return soup;
}

PolygonSoup torus(int n, int m, int missing_quads)
{
    PolygonSoup soup;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
            soup.position.emplace_back((10 + 3 * std::cos(v)) * std::cos(u), (10 + 3 * std::cos(v)) * std::sin(u),
                                       3 * std::sin(v));
        }
    const auto at = [&](int i, int j) { return i % n * m + j % m; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j)
            if (i * m + j >= missing_quads)
                soup.add_polygon(std::array<int, 4>{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    return soup;
}

/// The same faces with vertices of their own, as an STL file has them.
PolygonSoup torn(const PolygonSoup& soup)
{
    PolygonSoup result;
    for (int p = 0; p < soup.polygons(); ++p) {
        std::vector<int> corners;
        for (const int v : soup.polygon(p)) {
            corners.push_back(result.vertices());
            result.position.push_back(soup.position[size_t(v)]);
        }
        result.add_polygon(corners);
    }
    return result;
}

int count(const Examination& e, Fault fault)
{
    const Finding* f = e.report.find(fault);
    return f ? f->count : 0;
}
int first(const Examination& e, Fault fault)
{
    const Finding* f = e.report.find(fault);
    return f ? f->first : -2;
}
bool fatal(const Examination& e, Fault fault)
{
    const Finding* f = e.report.find(fault);
    return f && f->severity == Severity::fatal;
}

void expect_refused(const Examination& e, const std::string& words)
{
    try {
        require_healthy(e.report);
        ADD_FAILURE() << "was accepted; expected: " << words;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

} // namespace

TEST(Doctor, HealthyMeshComesBackUnchangedWithNothingToReport)
{
    const TriMesh mesh = shapes::rectangle(30, 20, 5, 4);
    const Examination e = examine(shapes::soup_of(mesh));
    EXPECT_TRUE(e.report.findings.empty());
    EXPECT_EQ(e.mesh.position, mesh.position);
    EXPECT_EQ(e.mesh.triangle, mesh.triangle);
    EXPECT_EQ(e.report.components, 1);
    EXPECT_EQ(e.report.boundary_loops, 1);
    EXPECT_EQ(e.report.genus, 0);
    EXPECT_NO_THROW(require_healthy(e.report));
}

TEST(Doctor, EachHoleAddsALoop)
{
    const Examination e = examine(quads(7, 7, {8, 11, 24, 39}));
    EXPECT_EQ(e.report.boundary_loops, 5);
    EXPECT_EQ(e.report.genus, 0);
    EXPECT_EQ(e.report.euler_characteristic, 2 - 5); // chi of a disk with four holes
    EXPECT_EQ(count(e, Fault::polygon), 45);
    EXPECT_NEAR(area(e.mesh), 45, 1e-12);
    EXPECT_NO_THROW(require_healthy(e.report));
}

TEST(Doctor, RandomlyTurnedFacesAreTurnedBackToTheSideOfTheLargerArea)
{
    const TriMesh mesh = shapes::rectangle(30, 20, 20, 20);
    PolygonSoup soup = shapes::soup_of(mesh);
    std::mt19937 random(7);
    int turned = 0, first_turned = -1;
    for (int f = 0; f < soup.polygons(); ++f)
        if (random() % 3 == 0) {
            std::swap(soup.corner[size_t(3 * f)], soup.corner[size_t(3 * f + 1)]);
            first_turned = turned++ == 0 ? f : first_turned;
        }
    const Examination e = examine(soup);
    EXPECT_EQ(count(e, Fault::flipped_face), turned);
    EXPECT_EQ(first(e, Fault::flipped_face), first_turned);
    EXPECT_NEAR(area_vectors(e.mesh).row(2).sum(), 30 * 20, 1e-9);
    EXPECT_NO_THROW(halfedges(e.mesh));
}

TEST(Doctor, MoebiusStripIsRefusedAndAFullTwistIsNot)
{
    const Examination moebius = examine(band(24, 1));
    EXPECT_TRUE(fatal(moebius, Fault::one_sided));
    EXPECT_EQ(moebius.report.boundary_loops, 1);
    EXPECT_EQ(moebius.report.euler_characteristic, 0);
    EXPECT_FALSE(moebius.report.genus.has_value());
    expect_refused(moebius, "Moebius");

    const Examination annulus = examine(band(24, 2));
    EXPECT_EQ(annulus.report.boundary_loops, 2);
    EXPECT_EQ(annulus.report.genus, 0);
    EXPECT_NO_THROW(require_healthy(annulus.report));
}

TEST(Doctor, TorusIsClosedAndAPuncturedTorusKeepsItsHandle)
{
    const Examination closed = examine(torus(12, 8, 0));
    EXPECT_EQ(closed.report.genus, 1);
    EXPECT_EQ(closed.report.boundary_loops, 0);
    EXPECT_TRUE(fatal(closed, Fault::closed_surface));
    expect_refused(closed, "closed");

    const Examination punctured = examine(torus(12, 8, 3));
    EXPECT_EQ(punctured.report.genus, 1);
    EXPECT_EQ(punctured.report.boundary_loops, 1);
    EXPECT_FALSE(fatal(punctured, Fault::closed_surface));
    expect_refused(punctured, "handle");
}

namespace {

/// Another sheet 5 above, not connected.
void add_above(PolygonSoup& soup, const PolygonSoup& other, double scale)
{
    const int offset = soup.vertices();
    for (const Vector3d& p : other.position)
        soup.position.push_back(scale * p + Vector3d(0, 0, 5));
    for (int p = 0; p < other.polygons(); ++p) {
        std::vector<int> corners;
        for (const int v : other.polygon(p))
            corners.push_back(v + offset);
        soup.add_polygon(corners);
    }
}

} // namespace

TEST(Doctor, SeveralPiecesAreCountedWithTheirSizes)
{
    PolygonSoup soup = quads(3, 1);
    add_above(soup, quads(2, 2), 1);
    const Examination e = examine(soup);
    EXPECT_EQ(e.report.components, 2);
    EXPECT_EQ(e.report.boundary_loops, 2);
    EXPECT_EQ(first(e, Fault::several_components), 0); // the second piece is the larger one
    expect_refused(e, "2 separate pieces, the largest by area first: of 8, 6 triangles");
}

TEST(Doctor, TheLargestPieceIsTheOneWithTheMostSheetNotTheMostTriangles)
{
    PolygonSoup soup = quads(2, 2);
    add_above(soup, quads(1, 1), 20); // two triangles, and a hundred times as large
    const Examination e = examine(soup);
    EXPECT_EQ(first(e, Fault::several_components), 0); // what "keep the largest" would leave out
    expect_refused(e, "of 2, 8 triangles");
}

TEST(Doctor, ThirdFaceAtAnEdgeIsFatalAndNamed)
{
    PolygonSoup soup = quads(2, 1);
    soup.position.emplace_back(1, 0.5, 1);
    soup.add_polygon(std::array<int, 3>{1, 4, 6});
    const Examination e = examine(soup);
    EXPECT_EQ(count(e, Fault::crowded_edge), 1);
    EXPECT_FALSE(e.report.genus.has_value());
    expect_refused(e, "between the vertices 1 and 4");
    EXPECT_NE(e.report.find(Fault::crowded_edge)->advice.find(mention(option::keep_largest)), std::string::npos);
}

TEST(Doctor, WhoKeepsTheLargestIsNotAdvisedTo)
{
    PolygonSoup soup = quads(2, 1); // from the inner edge a flap goes up and down again to the
                                    // border
    soup.position.emplace_back(1.2, 0.5, 1);
    soup.add_polygon(std::array<int, 3>{1, 4, 6});
    soup.add_polygon(std::array<int, 3>{4, 5, 6});
    const Examination e = examine(soup, {.keep_largest = true});
    if (const Finding* crowded = e.report.find(Fault::crowded_edge))
        EXPECT_EQ(crowded->advice.find(mention(option::keep_largest)), std::string::npos) << crowded->advice;
    else
        ADD_FAILURE() << "nothing is crowded";
}

TEST(Doctor, HolesThatTouchInAVertexAreSeparated)
{
    // Two missing cells of 4 x 4 that meet in the vertex (2, 2) = 12: one vertex too few for two
    // proper holes.
    const Examination e = examine(quads(4, 4, {5, 10}));
    EXPECT_EQ(count(e, Fault::touching_fans), 1);
    EXPECT_EQ(first(e, Fault::touching_fans), 12);
    EXPECT_EQ(e.mesh.vertices(), 26);
    EXPECT_EQ(e.source_vertex[12], 12);
    EXPECT_EQ(e.source_vertex[13], 12);
    EXPECT_EQ(e.source_vertex[14], 13);
    EXPECT_EQ(e.mesh.position.col(12), e.mesh.position.col(13));
    EXPECT_EQ(e.report.boundary_loops, 2); // outer boundary, and the two holes joined through the
                                           // vertex
    EXPECT_EQ(e.report.genus, 0);
    EXPECT_EQ(boundary_loops(e.mesh).size(), 2u);
    EXPECT_NO_THROW(require_healthy(e.report));
}

TEST(Doctor, StrayVerticesAndDuplicateFacesAreLeftOutAndTheOrderIsKept)
{
    PolygonSoup soup = quads(2, 1);
    soup.position.insert(soup.position.begin(), Vector3d(9, 9, 9));
    for (int& v : soup.corner)
        ++v;
    const std::vector<int> quad(soup.polygon(0).rbegin(), soup.polygon(0).rend());
    soup.add_polygon(quad); // the first face again, from the other side
    const Examination e = examine(soup);
    EXPECT_EQ(count(e, Fault::stray_vertex), 1);
    EXPECT_EQ(first(e, Fault::stray_vertex), 0);
    EXPECT_EQ(count(e, Fault::duplicate_face), 1);
    EXPECT_EQ(first(e, Fault::duplicate_face), 2);
    EXPECT_EQ(e.source_vertex, (std::vector<int>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(e.source_face, (std::vector<int>{0, 0, 1, 1}));
    EXPECT_NO_THROW(require_healthy(e.report));
}

TEST(Doctor, ImpossibleNumbersAreRefusedWithTheirPlace)
{
    PolygonSoup soup = quads(2, 1);
    soup.position[4].y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(first(examine(soup), Fault::bad_coordinate), 4);
    expect_refused(examine(soup), "vertex 4");
    soup.position[4].y() = 1e300;
    expect_refused(examine(soup), "vertex 4");
    soup = quads(2, 1);
    soup.corner[5] = 6;
    EXPECT_EQ(first(examine(soup), Fault::bad_index), 1);
    soup.corner[5] = -1;
    expect_refused(examine(soup), "face 1, vertex -1");
    expect_refused(examine({}), "no faces");
    expect_refused(examine(soup_of({Vector3d(1, 2, 3), Vector3d(1, 2, 3), Vector3d(1, 2, 3)}, {{0, 1, 2}})), "no area");
}

TEST(Doctor, RepeatedCornersShortenAFaceOrRemoveIt)
{
    // A triangle written as a quad, an edge written as a triangle, and a face that goes through a
    // vertex twice.
    PolygonSoup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 2}, {0, 2, 3}, {0, 2, 0}});
    const Examination e = examine(soup);
    EXPECT_EQ(count(e, Fault::repeated_corner), 2);
    EXPECT_EQ(first(e, Fault::repeated_corner), 0);
    EXPECT_NEAR(area(e.mesh), 1, 1e-15);
    EXPECT_NO_THROW(require_healthy(e.report));
    soup.add_polygon(std::array<int, 5>{0, 1, 2, 0, 3});
    expect_refused(examine(soup), "twice (first: face 3)");
}

TEST(Doctor, NeedleWithTwoVerticesAtOnePlaceIsClosed)
{
    // The row of vertices x = 1 of a 2 x 2 rectangle is doubled at its middle; two needles fill the
    // slit.
    const Examination e = examine(soup_of(
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}, {1, 1, 0}},
        {{0, 1, 4, 3}, {3, 4, 7, 6}, {1, 2, 5, 9}, {9, 5, 8, 7}, {1, 9, 4}, {4, 9, 7}}));
    EXPECT_EQ(count(e, Fault::flat_face), 2);
    EXPECT_EQ(first(e, Fault::flat_face), 4);
    EXPECT_EQ(e.mesh.vertices(), 9);
    EXPECT_EQ(e.mesh.triangles(), 8);
    EXPECT_EQ(e.report.boundary_loops, 1);
    EXPECT_NEAR(area(e.mesh), 4, 1e-15);
    EXPECT_NO_THROW(require_healthy(e.report));
}

TEST(Doctor, CapIsTurnedIntoItsNeighbourAndABoundaryCapIsLeftOut)
{
    // (1, 0) lies on the edge (0, 0) - (2, 0) between a lower and an upper triangle fan; triangle 0
    // is the cap.
    const std::vector<Vector3d> points = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 2, 0}, {1, -2, 0}};
    const Examination inner = examine(soup_of(points, {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {0, 4, 1}}));
    EXPECT_EQ(count(inner, Fault::flat_face), 1);
    EXPECT_EQ(first(inner, Fault::flat_face), 0);
    EXPECT_EQ(inner.mesh.triangles(), 4);
    EXPECT_NEAR(area_vectors(inner.mesh).row(2).sum(), 4, 1e-15);
    EXPECT_GT(area_vectors(inner.mesh).row(2).minCoeff(), 0.5);
    EXPECT_EQ(inner.report.boundary_loops, 1);
    EXPECT_NO_THROW(require_healthy(inner.report));

    const Examination outer = examine(soup_of(points, {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}}));
    EXPECT_EQ(count(outer, Fault::flat_face), 1);
    EXPECT_EQ(outer.mesh.triangles(), 2);
    EXPECT_NEAR(area(outer.mesh), 2, 1e-15);
    EXPECT_NO_THROW(require_healthy(outer.report));
}

TEST(Doctor, FlatTriangleThatHoldsTheSurfaceTogetherIsFatal)
{
    // The tips of two caps on one edge: turning it would only make other flat triangles.
    const Examination e = examine(soup_of({{0, 0, 0}, {3, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, -2, 0}},
                                          {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {2, 1, 4}, {0, 5, 3}, {3, 5, 1}}));
    EXPECT_TRUE(fatal(e, Fault::flat_face));
    expect_refused(e, "face 0");
}

TEST(Doctor, TornFacetsAreWeldedInTheOrderOfTheirFirstCorners)
{
    PolygonSoup soup = torn(shapes::soup_of(shapes::rectangle(1, 1, 9, 7)));
    EXPECT_EQ(examine(soup).report.components, 126);
    const Examination e = examine(soup, {.weld = true});
    EXPECT_EQ(e.mesh.vertices(), 80);
    EXPECT_EQ(count(e, Fault::coincident_vertex), 3 * 126 - 80);
    EXPECT_TRUE(std::is_sorted(e.source_vertex.begin(), e.source_vertex.end()));
    for (int v = 0; v < e.mesh.vertices(); ++v)
        for (int earlier = 0; earlier < e.source_vertex[size_t(v)]; ++earlier)
            EXPECT_NE(soup.position[size_t(earlier)], soup.position[size_t(e.source_vertex[size_t(v)])]);
    EXPECT_NO_THROW(require_healthy(e.report));
}

TEST(Doctor, GapsOfRoundingAreWeldedAndShortRealEdgesAreKept)
{
    // All corners are off at random; one real edge is shorter than the tolerance of 5.7e-3 but
    // longer than the errors.
    const double real_edge = 2e-3;
    PolygonSoup whole = quads(4, 4);
    whole.position[12].x() -= 1 - real_edge; // the middle vertex comes next to its left neighbour
                                             // 11
    PolygonSoup soup = torn(whole);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> noise(-1e-4, 1e-4);
    for (Vector3d& p : soup.position)
        p += Vector3d(noise(random), noise(random), noise(random));
    const Examination e = examine(soup, {.weld = true, .weld_tolerance = 1e-3});
    EXPECT_EQ(e.mesh.vertices(), 25);
    EXPECT_EQ(e.mesh.triangles(), 32);
    EXPECT_EQ(e.report.components, 1);
    EXPECT_EQ(e.report.boundary_loops, 1);
}

TEST(Doctor, SliversAreNotedOnly)
{
    const Examination e =
        examine(soup_of({{0, 0, 0}, {10, 0, 0}, {5, 0.05, 0}, {5, 5, 0}}, {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}}));
    EXPECT_EQ(count(e, Fault::sliver), 1);
    // atan(0.05 / 5)
    EXPECT_NE(e.report.find(Fault::sliver)->text.find("0.573 degrees"), std::string::npos)
        << e.report.find(Fault::sliver)->text;
    EXPECT_NO_THROW(require_healthy(e.report));
}

TEST(Doctor, NumbersDoNotDependOnTheOrderOfFacesOrTheFirstCorner)
{
    const PolygonSoup soup = quads(6, 5, {8, 15, 20});
    std::mt19937 random(11);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<int> order(static_cast<size_t>(soup.polygons()));
        for (size_t i = 0; i < order.size(); ++i)
            order[i] = int(i);
        std::shuffle(order.begin(), order.end(), random);
        PolygonSoup other;
        other.position = soup.position;
        for (const int p : order) {
            std::vector<int> corners(soup.polygon(p).begin(), soup.polygon(p).end());
            std::rotate(corners.begin(), corners.begin() + random() % 4, corners.end());
            other.add_polygon(corners);
        }
        const Examination e = examine(other), reference = examine(soup);
        EXPECT_EQ(e.report.boundary_loops, reference.report.boundary_loops);
        EXPECT_EQ(e.report.euler_characteristic, reference.report.euler_characteristic);
        EXPECT_EQ(e.mesh.position, reference.mesh.position);
        EXPECT_NEAR(area_vectors(e.mesh).row(2).sum(), 27, 1e-12);
    }
}

} // namespace spia
