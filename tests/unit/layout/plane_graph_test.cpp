// Lines that are turned, and faces that are divided strip by strip, on graphs of a few vertices.
#include "engine/layout/plane_graph.h"

#include <gtest/gtest.h>

namespace spia {

namespace {

void add(PlaneGraph& graph, int from, int to, bool border)
{
    LayoutCurve curve;
    curve.vertex = {from, to};
    curve.plane.resize(2, 2);
    curve.plane << graph.vertex[size_t(from)], graph.vertex[size_t(to)];
    if (border) {
        curve.part = Eigen::Matrix3Xd::Zero(3, 2);
        curve.part.topRows(2) = curve.plane;
    }
    graph.curve.push_back(std::move(curve));
}

PlaneGraph graph_of(std::vector<Eigen::Vector2d> vertices, const std::vector<int>& border)
{
    PlaneGraph graph;
    graph.vertex = std::move(vertices);
    graph.border.resize(graph.vertex.size());
    for (size_t k = 0; k < border.size(); ++k)
        add(graph, border[k], border[(k + 1) % border.size()], true);
    return graph;
}

/// Three squares in a row and a triangle at their end.
PlaneGraph row()
{
    PlaneGraph graph = graph_of({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0.5}, {3, 1}, {2, 1}, {1, 1}, {0, 1}},
                                {0, 1, 2, 3, 4, 5, 6, 7, 8});
    add(graph, 1, 7, false);
    add(graph, 2, 6, false);
    add(graph, 3, 5, false);
    return graph;
}

} // namespace

TEST(FlipLines, TurnsTheDiagonalThatLeavesThinTriangles)
{
    for (const bool reversed : {false, true}) {
        PlaneGraph graph = graph_of({{0, 0}, {4, -1}, {8, 0}, {4, 1}}, {0, 1, 2, 3});
        add(graph, reversed ? 2 : 0, reversed ? 0 : 2, false); // the long one
        flip_lines(graph, 4);
        const auto ends = graph.curve[4].vertex;
        EXPECT_EQ(std::min(ends[0], ends[1]), 1);
        EXPECT_EQ(std::max(ends[0], ends[1]), 3);
        EXPECT_EQ(graph.curve[4].plane.col(0), graph.vertex[size_t(ends[0])]);
        EXPECT_EQ(graph.curve[4].plane.col(1), graph.vertex[size_t(ends[1])]);
        flip_lines(graph, 4);
        EXPECT_EQ(graph.curve[4].vertex, ends);
    }
}

TEST(FlipLines, LeavesADiagonalWhoseOtherOneIsOutside)
{
    // bent inwards at vertex 2
    PlaneGraph graph = graph_of({{0, 0}, {4, -5}, {1, 0.1}, {4, 5}}, {0, 1, 2, 3});
    add(graph, 0, 2, false);
    flip_lines(graph, 4);
    EXPECT_EQ(graph.curve[4].vertex, (std::array{0, 2}));
}

TEST(DivideFaces, ATriangleDividesTheStripsAtItsSidesAndNoOthers)
{
    PlaneGraph graph = row();
    std::vector<Face> faces = faces_of(graph);
    ASSERT_EQ(faces.size(), 4u);
    divide_faces(graph, faces, false);
    EXPECT_EQ(faces.size(), 3u + 3 * 2u);
    double area = 0;
    for (const Face& face : faces) {
        EXPECT_EQ(face.size(), 4u);
        const auto points = polygon(graph, face);
        for (size_t i = 0, j = points.size() - 1; i < points.size(); j = i++)
            area += 0.5 * (points[j].x() * points[i].y() - points[j].y() * points[i].x());
        for (size_t k = 0; k < 4; ++k) {
            EXPECT_EQ(start_of(graph, face[(k + 1) % 4]), start_of(graph, turned(face[k])));
            const double angle = corner_angle(graph, face, k);
            EXPECT_GT(angle, 0.3);
            EXPECT_LT(angle, 2.9);
        }
    }
    EXPECT_NEAR(area, 3.5, 1e-12);
    std::vector<int> uses(graph.curve.size(), 0);
    for (const Face& face : faces)
        for (const CurveUse use : face)
            ++uses[size_t(use.curve)];
    for (size_t c = 0; c < uses.size(); ++c)
        EXPECT_EQ(uses[c], graph.curve[c].on_border() ? 1 : 2);
}

TEST(DivideFaces, AllAreDividedFromTheirMiddleWhereThatIsAskedFor)
{
    PlaneGraph graph = row();
    std::vector<Face> faces = faces_of(graph);
    divide_faces(graph, faces, true);
    EXPECT_EQ(faces.size(), 3u + 3 * 4u);
}

TEST(DivideFaces, FacesOfFourSidesStay)
{
    PlaneGraph graph = graph_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 1, 2, 3});
    std::vector<Face> faces = faces_of(graph);
    divide_faces(graph, faces, false);
    EXPECT_EQ(faces.size(), 1u);
    EXPECT_EQ(graph.curve.size(), 4u);
}

} // namespace spia
