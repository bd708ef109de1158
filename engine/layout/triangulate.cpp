#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/layout/plane_graph.h"
#include "engine/layout/plane_lines.h"
#include "engine/mesh/orient2d.h"
#include "engine/mesh/vectors.h"

namespace spia {

namespace {

/// A line that leaves the border at less would run along it but for rounding, and leave no room for
/// cells.
constexpr double least_angle = 4 * std::numbers::pi / 180;
constexpr double rounding = 1e-6; ///< radians, the same where no line is to be missing

/// What a line may not meet. Its ends are vertices of the graph, or -1.
struct Wall {
    Eigen::Vector2d a, b;
    int from = -1, to = -1;
};

struct Line {
    int from = -1, to = -1;
    double cost = 0;
};

std::vector<Wall> walls_of(const PlaneGraph& graph)
{
    std::vector<Wall> walls;
    for (const LayoutCurve& curve : graph.curve)
        for (Eigen::Index i = 0; i + 1 < curve.plane.cols(); ++i)
            walls.push_back({curve.plane.col(i), curve.plane.col(i + 1), i == 0 ? curve.vertex[0] : -1,
                             i + 2 == curve.plane.cols() ? curve.vertex[1] : -1});
    return walls;
}

bool same_direction(const Eigen::Vector2d& at, const Eigen::Vector2d& p, const Eigen::Vector2d& q)
{
    return orient2d(at, p, q) == 0 && (p - at).dot(q - at) > 0;
}

bool blocks(const Wall& wall, const PlaneGraph& graph, const Line& line)
{
    const Eigen::Vector2d &p = graph.vertex[size_t(line.from)], &q = graph.vertex[size_t(line.to)];
    const bool at_from = wall.from == line.from || wall.from == line.to,
               at_to = wall.to == line.from || wall.to == line.to;
    if (at_from && at_to) // a straight arc between the same two, or an arc of a loop with two
                          // vertices
        return true;
    if (!at_from && !at_to)
        return segments_meet(p, q, wall.a, wall.b);
    const Eigen::Vector2d &shared = at_from ? wall.a : wall.b, &other = at_from ? wall.b : wall.a;
    return same_direction(shared, other, shared == p ? q : p);
}

/// Radians between two vectors of the plane, 0 to pi.
double plane_angle(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
    return std::abs(std::atan2(cross(a, b), a.dot(b)));
}

/// Per vertex the points to which the border and the lines that are kept lead from it.
std::vector<std::vector<Eigen::Vector2d>> fixed_ways(const PlaneGraph& graph)
{
    std::vector<std::vector<Eigen::Vector2d>> ways(graph.vertex.size());
    for (size_t v = 0; v < ways.size(); ++v)
        if (const auto& border = graph.border[v])
            ways[v] = {border->before, border->after};
    for (const LayoutCurve& curve : graph.curve)
        if (curve.kept) {
            ways[size_t(curve.vertex[0])].push_back(curve.plane.col(1));
            ways[size_t(curve.vertex[1])].push_back(curve.plane.col(curve.plane.cols() - 2));
        }
    return ways;
}

/// Radians, the least between the line and what is fixed at both ends, up to a right angle.
double angle_to_fixed(const PlaneGraph& graph, const std::vector<std::vector<Eigen::Vector2d>>& ways, int from, int to)
{
    double least = std::numbers::pi / 2;
    for (const auto& [v, w] : {std::pair(from, to), std::pair(to, from)}) {
        const Eigen::Vector2d at = graph.vertex[size_t(v)], d = graph.vertex[size_t(w)] - at;
        for (const Eigen::Vector2d& way : ways[size_t(v)])
            least = std::min(least, plane_angle(d, way - at));
    }
    return least;
}

bool leaves_into_sheet(const PlaneGraph& graph, int v, int to)
{
    const auto& border = graph.border[size_t(v)];
    if (size_t(v) < graph.closed.size() && graph.closed[size_t(v)])
        return false;
    return !border || leads_inside(border->before, graph.vertex[size_t(v)], border->after, graph.vertex[size_t(to)]);
}

} // namespace

void triangulate(PlaneGraph& graph, bool complete, const Progress& progress)
{
    std::vector<Line> lines;
    std::set<std::array<int, 2>> beside; // a line along an arc would leave a face of two sides
    for (const LayoutCurve& curve : graph.curve)
        beside.insert({std::min(curve.vertex[0], curve.vertex[1]), std::max(curve.vertex[0], curve.vertex[1])});
    const auto ways = fixed_ways(graph);
    const int n = int(graph.vertex.size());
    for (int i = 0; i < n; ++i)
        for (int j = i + 1; j < n; ++j)
            if (!beside.contains({i, j}) && leaves_into_sheet(graph, i, j) && leaves_into_sheet(graph, j, i))
                if (const double angle = angle_to_fixed(graph, ways, i, j);
                    angle > (complete ? rounding : least_angle)) // long ones and flat ones are dear
                    lines.push_back(
                        {i, j, (graph.vertex[size_t(j)] - graph.vertex[size_t(i)]).norm() / std::sin(angle)});
    std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.cost < b.cost; });
    const std::vector<Wall> fixed = walls_of(graph);
    std::vector<Wall> taken;
    for (size_t k = 0; k < lines.size(); ++k) {
        const Line& line = lines[k];
        if (k % 1000 == 0)
            progress.checkpoint(double(k) / double(lines.size()), "dividing the blank into triangles");
        const auto blocked = [&](const Wall& wall) { return blocks(wall, graph, line); };
        if (std::any_of(taken.begin(), taken.end(), blocked) || std::any_of(fixed.begin(), fixed.end(), blocked))
            continue;
        taken.push_back({graph.vertex[size_t(line.from)], graph.vertex[size_t(line.to)], line.from, line.to});
        LayoutCurve curve;
        curve.vertex = {line.from, line.to};
        curve.plane.resize(2, 2);
        curve.plane << taken.back().a, taken.back().b;
        graph.curve.push_back(std::move(curve));
    }
}

} // namespace spia
