#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/layout/plane_graph.h"
#include "engine/layout/plane_lines.h"

namespace spia {

namespace {

constexpr double small_hole = 2; ///< times its radius is the distance to the rest of the border, or
                                 ///< more
constexpr double share = 0.4;    ///< of the distance that a ring takes
constexpr double widest = 3;     ///< radii of the hole

/// The arcs of each closed row on the border, in order.
std::vector<std::vector<int>> rows_of(const PlaneGraph& graph)
{
    std::map<int, int> leaving; // vertex to arc
    for (int c = 0; c < int(graph.curve.size()); ++c)
        if (graph.curve[size_t(c)].on_border())
            leaving[graph.curve[size_t(c)].vertex[0]] = c;
    std::vector<std::vector<int>> rows;
    std::vector<char> seen(graph.curve.size(), 0);
    for (int c = 0; c < int(graph.curve.size()); ++c) {
        if (seen[size_t(c)] || !graph.curve[size_t(c)].on_border())
            continue;
        rows.emplace_back();
        for (int at = c; !seen[size_t(at)]; at = leaving.at(graph.curve[size_t(at)].vertex[1])) {
            seen[size_t(at)] = 1;
            rows.back().push_back(at);
        }
    }
    return rows;
}

Eigen::Matrix2Xd points_of(const PlaneGraph& graph, const std::vector<int>& row)
{
    Eigen::Matrix2Xd points(2, 0);
    for (const int c : row) {
        const Eigen::Matrix2Xd& p = graph.curve[size_t(c)].plane;
        points.conservativeResize(2, points.cols() + p.cols() - 1);
        points.rightCols(p.cols() - 1) = p.leftCols(p.cols() - 1);
    }
    return points;
}

double twice_area(const Eigen::Matrix2Xd& p)
{
    double sum = 0;
    for (Eigen::Index i = 0, j = p.cols() - 1; i < p.cols(); j = i++)
        sum += p(0, j) * p(1, i) - p(0, i) * p(1, j);
    return sum;
}

} // namespace

void add_rings(PlaneGraph& graph)
{
    const auto rows = rows_of(graph);
    std::vector<Eigen::Matrix2Xd> points;
    for (const auto& row : rows)
        points.push_back(points_of(graph, row));
    graph.closed.assign(graph.vertex.size(), 0);
    for (size_t h = 0; h < rows.size(); ++h) {
        if (twice_area(points[h]) > 0) // the outline
            continue;
        const Eigen::Vector2d middle = (points[h].rowwise().minCoeff() + points[h].rowwise().maxCoeff()) / 2;
        const double radius = (points[h].colwise() - middle).colwise().norm().maxCoeff();
        // of the rest of the border from the middle
        double away = std::numeric_limits<double>::infinity();
        for (size_t other = 0; other < rows.size(); ++other)
            for (Eigen::Index i = 0, j = points[other].cols() - 1; other != h && i < points[other].cols(); j = i++)
                away = std::min(away, distance_to_segment(middle, points[other].col(j), points[other].col(i)));
        for (const LayoutCurve& curve : graph.curve) // edges of the part
            for (Eigen::Index i = 0; curve.kept && i + 1 < curve.plane.cols(); ++i)
                away = std::min(away, distance_to_segment(middle, curve.plane.col(i), curve.plane.col(i + 1)));
        const size_t count = rows[h].size();
        if (!(away - radius > small_hole * radius) || count < 4)
            continue;
        const double outer = std::min(radius + share * (away - radius), widest * radius);
        std::vector<Eigen::Vector2d> ring; // in the hole's order, clockwise
        for (const int c : rows[h]) {
            const Eigen::Vector2d out = graph.vertex[size_t(graph.curve[size_t(c)].vertex[0])] - middle;
            ring.push_back(middle + outer * out.normalized());
        }
        bool clear = true; // of the hole, all of it, and turning one way
        for (size_t k = 0; k < count; ++k) {
            const Eigen::Vector2d &a = ring[k], &b = ring[(k + 1) % count], &c = ring[(k + 2) % count];
            clear =
                clear && distance_to_segment(middle, a, b) > 1.05 * radius && leads_inside(a, b, c, b + (b - middle));
            const Eigen::Vector2d from = graph.vertex[size_t(graph.curve[size_t(rows[h][k])].vertex[0])];
            for (Eigen::Index i = 0, j = points[h].cols() - 1; i < points[h].cols(); j = i++)
                if (points[h].col(i) != from && points[h].col(j) != from &&
                    segments_meet(from, a, points[h].col(j), points[h].col(i)))
                    clear = false;
        }
        if (!clear)
            continue;
        const int first = int(graph.vertex.size());
        for (size_t k = 0; k < count; ++k) {
            graph.closed[size_t(graph.curve[size_t(rows[h][k])].vertex[0])] = 1;
            graph.vertex.push_back(ring[k]);
            graph.border.push_back(BorderTurn{ring[(k + count - 1) % count], ring[(k + 1) % count]});
            graph.closed.push_back(0);
        }
        const auto line = [&](int a, int b) {
            LayoutCurve curve;
            curve.vertex = {a, b};
            curve.plane.resize(2, 2);
            curve.plane << graph.vertex[size_t(a)], graph.vertex[size_t(b)];
            graph.curve.push_back(std::move(curve));
        };
        for (size_t k = 0; k < count; ++k) {
            line(first + int(k), first + int((k + 1) % count));
            line(graph.curve[size_t(rows[h][k])].vertex[0], first + int(k));
        }
    }
}

} // namespace spia
