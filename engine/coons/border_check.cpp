#include "engine/coons/border_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/coons/locate_nodes.h"
#include "engine/core/text.h"
#include "engine/mesh/vectors.h"

namespace spia {

namespace {

/// The border nodes, counter-clockwise, without repetition.
std::vector<Eigen::Vector2d> border_polygon(const QuadGrid& grid)
{
    std::vector<Eigen::Vector2d> border;
    const auto add = [&](int i, int j) {
        const Eigen::Vector2d point = grid.position.col(grid.node(i, j)).head<2>();
        if (border.empty() || point != border.back())
            border.push_back(point);
    };
    for (int i = 0; i < grid.columns; ++i)
        add(i, 0);
    for (int j = 0; j < grid.rows; ++j)
        add(grid.columns, j);
    for (int i = grid.columns; i > 0; --i)
        add(i, grid.rows);
    for (int j = grid.rows; j > 0; --j)
        add(0, j);
    return border;
}

/// How often a closed polygon turns around, counter-clockwise positive. Only 1 can bound unfolded
/// cells.
int turns(const std::vector<Eigen::Vector2d>& polygon)
{
    double turning = 0;
    const size_t n = polygon.size();
    for (size_t k = 0; k < n; ++k) {
        const Eigen::Vector2d in = polygon[(k + 1) % n] - polygon[k], out = polygon[(k + 2) % n] - polygon[(k + 1) % n];
        turning += std::atan2(cross(in, out), in.dot(out));
    }
    return int(std::lround(turning / (2 * std::numbers::pi)));
}

double area(const std::vector<Eigen::Vector2d>& polygon)
{
    double doubled = 0;
    for (size_t k = 0; k < polygon.size(); ++k)
        doubled += cross(polygon[k] - polygon[0], polygon[(k + 1) % polygon.size()] - polygon[0]);
    return doubled / 2;
}

int crossings(const std::vector<Eigen::Vector2d>& polygon)
{
    const size_t n = polygon.size();
    int count = 0;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = i + 2; j < n; ++j) {
            const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % n], &c = polygon[j],
                                  &d = polygon[(j + 1) % n];
            count += cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
        }
    return count;
}

constexpr double rounding_deg = 1e-6;

} // namespace

double inner_angle_deg(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
    const double angle = std::atan2(cross(a, b), a.dot(b)) * 180 / std::numbers::pi;
    return angle > 0 ? angle : angle + 360;
}

double corner_angle_deg(const QuadGrid& q, int k)
{
    const int m = q.columns, n = q.rows;
    const std::array<std::array<int, 3>, 4> corner = {{{q.node(0, 0), q.node(1, 0), q.node(0, 1)},
                                                       {q.node(m, 0), q.node(m, 1), q.node(m - 1, 0)},
                                                       {q.node(m, n), q.node(m - 1, n), q.node(m, n - 1)},
                                                       {q.node(0, n), q.node(0, n - 1), q.node(1, n)}}};
    const Eigen::Vector3d a = q.position.col(corner[size_t(k)][1]) - q.position.col(corner[size_t(k)][0]);
    const Eigen::Vector3d b = q.position.col(corner[size_t(k)][2]) - q.position.col(corner[size_t(k)][0]);
    return inner_angle_deg(a.head<2>(), b.head<2>());
}

int impossible_corner(const QuadGrid& grid)
{
    for (int k = 0; k < 4; ++k)
        if (corner_angle_deg(grid, k) > 180 - rounding_deg)
            return k;
    return -1;
}

std::optional<StraightCorner> straight_corner(const FilledMesh& filled, const BlankBoundary& boundary, int columns,
                                              int rows, double reach)
{
    // Places of a side, from a corner on.
    const auto near = [&](std::vector<int> side, bool backwards, int cells) {
        if (backwards)
            std::reverse(side.begin(), side.end());
        const auto at = [&](size_t i) -> Eigen::Vector2d { return filled.plane.col(side[i]); };
        double whole = 0, walked = 0;
        for (size_t i = 1; i < side.size(); ++i)
            whole += (at(i) - at(i - 1)).norm();
        const double most = reach * whole / cells;
        std::vector<Eigen::Vector2d> places;
        for (size_t i = 1; i < side.size() && walked < most; ++i) {
            const Eigen::Vector2d step = at(i) - at(i - 1);
            places.push_back(at(i - 1) + std::min(1., (most - walked) / step.norm()) * step);
            walked += step.norm();
        }
        return places;
    };
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d corner = filled.plane.col(boundary.corner[size_t(k)]);
        const int along = k % 2 == 0 ? columns : rows, before = k % 2 == 0 ? rows : columns;
        const auto next = near(boundary.side[size_t(k)], false, along),
                   last = near(boundary.side[size_t(k + 3) % 4], true, before);
        double least = 360;
        for (const Eigen::Vector2d& a : next)
            for (const Eigen::Vector2d& b : last)
                least = std::min(least, inner_angle_deg(a - corner, b - corner));
        if (least > 180 - rounding_deg)
            return StraightCorner{k, least};
    }
    return std::nullopt;
}

bool follows_outline(const GridResult& grid, bool overlaps)
{
    constexpr double least_area = 0.7, largest_area = 1.4, crossing_share = 0.1;
    const std::vector<Eigen::Vector2d> border = border_polygon(grid.planar);
    std::vector<Eigen::Vector2d> outline;
    for (const int v : grid.filled->outline)
        outline.push_back(grid.filled->plane.col(v));
    const double share = area(border) / area(outline);
    return turns(border) == 1 && share > least_area && share < largest_area &&
           (overlaps || crossings(border) <= crossing_share * double(border.size()));
}

bool border_is_possible(const GridResult& grid, bool overlaps)
{
    return impossible_corner(grid.planar) < 0 && follows_outline(grid, overlaps);
}

std::string soundness(const GridResult& grid, bool overlaps)
{
    if (is_sound(grid))
        return "sound";
    if (impossible_corner(grid.planar) >= 0)
        return "no cell fits into a corner";
    if (!follows_outline(grid, overlaps))
        return "the border nodes do not follow the outline";
    if (const int folded = grid.quality.folded_cells; folded > 0)
        return counted(folded, "cell folds", "cells fold");
    return counted(grid.nodes_outside, "node is off the blank", "nodes are off the blank");
}

std::pair<int, double> widest_vertex(const FilledMesh& filled)
{
    std::vector<double> angle(size_t(filled.mesh.vertices()), 0);
    for (int f = 0; f < filled.mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3i t = filled.mesh.triangle.col(f);
            const Eigen::Vector2d a = filled.plane.col(t[(k + 1) % 3]) - filled.plane.col(t[k]);
            const Eigen::Vector2d b = filled.plane.col(t[(k + 2) % 3]) - filled.plane.col(t[k]);
            angle[size_t(t[k])] += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) * 180 / std::numbers::pi;
        }
    const int widest = *std::max_element(filled.outline.begin(), filled.outline.end(),
                                         [&](int a, int b) { return angle[size_t(a)] < angle[size_t(b)]; });
    return {widest, angle[size_t(widest)]};
}

} // namespace spia
