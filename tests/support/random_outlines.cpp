#include "tests/support/random_outlines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <vector>

#include "engine/mesh/mesh_polygon.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"
#include "tests/support/seeded_random.h"

namespace spia::shapes {

namespace {

using Point = Eigen::Vector2d;
using Points = std::vector<Point>;

using std::numbers::pi;
constexpr int pieces_of_outline = 260; // about

Point polar(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

Points star(SeededRandom& random)
{
    const int tips = random.whole(4, 10);
    Points corners;
    for (int i = 0; i < 2 * tips; ++i)
        corners.push_back(polar(i % 2 ? random.between(0.2, 0.7) : random.between(0.8, 1.3),
                                pi * (i + random.between(-0.25, 0.25)) / tips));
    return corners;
}

Points l_shape(SeededRandom& random)
{
    const double a = random.between(1, 2), b = random.between(1, 2), w = random.between(0.1, 0.7),
                 h = random.between(0.1, 0.7);
    return {{0, 0}, {a, 0}, {a, h}, {w, h}, {w, b}, {0, b}};
}

Points u_shape(SeededRandom& random)
{
    const double a = random.between(1, 2), w = random.between(0.1, 0.4), v = random.between(0.1, 0.4),
                 h = random.between(0.1, 0.5), left = random.between(0.7, 3), right = random.between(0.7, 3);
    return {{0, 0}, {a, 0}, {a, right}, {a - v, right}, {a - v, h}, {w, h}, {w, left}, {0, left}};
}

Points comb(SeededRandom& random)
{
    const int teeth = random.whole(3, 8);
    const double gap = random.between(0.25, 0.7), back = random.between(0.3, 2);
    const bool both_sides = random.coin();
    Points corners = {{0, -back}};
    for (int i = 0; both_sides && i + 1 < teeth; ++i) {
        const double depth = random.between(0.3, 2.5);
        corners.insert(
            corners.end(),
            {{i + 1 - gap, -back}, {i + 1 - gap, -back - depth}, {i + 1.0, -back - depth}, {i + 1.0, -back}});
    }
    corners.push_back({teeth - gap, -back});
    for (int i = teeth - 1; i >= 0; --i) {
        const double depth = random.between(0.3, 4);
        if (i < teeth - 1)
            corners.push_back({i + 1 - gap, 0});
        corners.insert(corners.end(), {{i + 1 - gap, depth}, {double(i), depth}});
        if (i > 0)
            corners.push_back({double(i), 0});
    }
    return corners;
}

/// A band whose width is a share of the pitch.
Points spiral(SeededRandom& random)
{
    const double windings = random.between(0.8, 3), share = random.between(0.3, 0.75), core = random.between(0.6, 1.5);
    const int n = int(30 * (core + windings) * windings);
    Points outer, inner;
    for (int i = 0; i <= n; ++i) {
        const double t = windings * i / n;
        outer.push_back(polar(core + t + share / 2, 2 * pi * t));
        inner.push_back(polar(core + t - share / 2, 2 * pi * t));
    }
    outer.insert(outer.end(), inner.rbegin(), inner.rend());
    return outer;
}

Points lobes(SeededRandom& random)
{
    std::vector<double> a, phase;
    for (int k = 2; k <= 7; ++k) {
        a.push_back(random.between(0, 0.3));
        phase.push_back(random.between(0, 2 * pi));
    }
    Points points;
    for (int i = 0; i < pieces_of_outline; ++i) {
        const double angle = 2 * pi * i / pieces_of_outline;
        double radius = 1;
        for (size_t k = 0; k < a.size(); ++k)
            radius += a[k] * std::cos(double(k + 2) * angle + phase[k]);
        points.push_back(polar(std::max(radius, 0.15), angle));
    }
    return points;
}

/// Corridors on a chess board that branch and never meet again.
Points maze(SeededRandom& random)
{
    using Field = std::pair<int, int>;
    const std::array<Field, 4> ways = {Field{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    std::set<Field> taken = {{0, 0}};
    std::vector<Field> order = {{0, 0}};
    const size_t fields = size_t(random.whole(8, 30));
    for (int trial = 0; trial < 3000 && order.size() < fields; ++trial) {
        const Field from = order[size_t(random.whole(0, int(order.size()) - 1))],
                    way = ways[size_t(random.whole(0, 3))];
        const Field to = {from.first + way.first, from.second + way.second};
        bool free = !taken.contains(to);
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j) { // nothing around but what touches the field it came
                                            // from
                const Field other = {to.first + i, to.second + j};
                free = free && (!taken.contains(other) || other == from ||
                                (std::abs(other.first - from.first) + std::abs(other.second - from.second) == 1 &&
                                 std::abs(i) + std::abs(j) == 2));
            }
        if (free) {
            taken.insert(to);
            order.push_back(to);
        }
    }
    std::map<Field, Field> next; // around the fields, these to the left
    for (const auto& [x, y] : order) {
        if (!taken.contains({x, y - 1}))
            next[{x, y}] = {x + 1, y};
        if (!taken.contains({x + 1, y}))
            next[{x + 1, y}] = {x + 1, y + 1};
        if (!taken.contains({x, y + 1}))
            next[{x + 1, y + 1}] = {x, y + 1};
        if (!taken.contains({x - 1, y}))
            next[{x, y + 1}] = {x, y};
    }
    Points points;
    Field at = next.begin()->first;
    const Field start = at;
    do {
        points.emplace_back(at.first, at.second);
        at = next.at(at);
    } while (at != start);
    Points corners; // without the straight ones
    for (size_t i = 0; i < points.size(); ++i) {
        const Point& here = points[i];
        if (cross(here - points[(i + points.size() - 1) % points.size()], points[(i + 1) % points.size()] - here) != 0)
            corners.push_back(here);
    }
    return corners;
}

Points plate(SeededRandom& random)
{
    if (random.coin())
        return l_shape(random);
    Points points;
    const int n = random.whole(4, 60);
    for (int i = 0; i < n; ++i)
        points.push_back(polar(1, 2 * pi * (i + random.between(0, 0.5)) / n));
    return points;
}

double length(const Points& loop)
{
    double sum = 0;
    for (size_t i = 0; i < loop.size(); ++i)
        sum += (loop[(i + 1) % loop.size()] - loop[i]).norm();
    return sum;
}

Points turned_and_stretched(const Points& loop, SeededRandom& random)
{
    const Eigen::Rotation2D<double> first(random.between(0, 2 * pi)), second(random.between(0, 2 * pi));
    const double stretch = std::exp(random.between(0, 0.9)), size = std::exp(random.between(0, 5));
    Points result;
    for (const Point& p : loop) {
        Point q = first * p;
        q.x() *= stretch;
        result.push_back(size * (second * q));
    }
    return result;
}

Points divided(const Points& corners, double spacing)
{
    Points result;
    for (size_t i = 0; i < corners.size(); ++i) {
        const Point a = corners[i], b = corners[(i + 1) % corners.size()];
        const int pieces = std::max(1, int(std::lround((b - a).norm() / spacing)));
        for (int k = 0; k < pieces; ++k)
            result.push_back(a + (b - a) * k / pieces);
    }
    return result;
}

/// Each triangle in four, as often as is said.
TriMesh finer(const TriMesh& mesh, int times)
{
    if (times == 0)
        return mesh;
    std::map<std::pair<int, int>, int> middle;
    std::vector<Eigen::Vector3d> added;
    std::vector<Eigen::Vector3i> triangles;
    const auto between = [&](int a, int b) {
        const auto [it, is_new] = middle.try_emplace(std::minmax(a, b), mesh.vertices() + int(added.size()));
        if (is_new)
            added.push_back(0.5 * (mesh.position.col(a) + mesh.position.col(b)));
        return it->second;
    };
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Eigen::Vector3i t = mesh.triangle.col(f);
        const Eigen::Vector3i m(between(t[0], t[1]), between(t[1], t[2]), between(t[2], t[0]));
        triangles.insert(triangles.end(), {{t[0], m[0], m[2]}, {t[1], m[1], m[0]}, {t[2], m[2], m[1]}, m});
    }
    TriMesh result;
    result.position.resize(3, mesh.vertices() + Eigen::Index(added.size()));
    result.position.leftCols(mesh.vertices()) = mesh.position;
    for (size_t i = 0; i < added.size(); ++i)
        result.position.col(mesh.vertices() + Eigen::Index(i)) = added[i];
    result.triangle.resize(3, Eigen::Index(triangles.size()));
    for (size_t i = 0; i < triangles.size(); ++i)
        result.triangle.col(Eigen::Index(i)) = triangles[i];
    return finer(result, times - 1);
}

/// The mesh without some triangles and the vertices that only they have.
TriMesh without(const TriMesh& mesh, const std::vector<char>& removed)
{
    std::vector<int> number(size_t(mesh.vertices()), -1), vertices;
    std::vector<Eigen::Vector3i> triangles;
    for (int f = 0; f < mesh.triangles(); ++f) {
        if (removed[size_t(f)])
            continue;
        Eigen::Vector3i t = mesh.triangle.col(f);
        for (int k = 0; k < 3; ++k) {
            int& n = number[size_t(t[k])];
            if (n < 0) {
                n = int(vertices.size());
                vertices.push_back(t[k]);
            }
            t[k] = n;
        }
        triangles.push_back(t);
    }
    TriMesh result;
    result.position.resize(3, Eigen::Index(vertices.size()));
    for (size_t v = 0; v < vertices.size(); ++v)
        result.position.col(Eigen::Index(v)) = mesh.position.col(vertices[v]);
    result.triangle.resize(3, Eigen::Index(triangles.size()));
    for (size_t t = 0; t < triangles.size(); ++t)
        result.triangle.col(Eigen::Index(t)) = triangles[t];
    return result;
}

/// Cuts up to `wanted` holes with jagged edges into a mesh: around random vertices far enough from
/// everything that is cut.
TriMesh with_holes(const TriMesh& mesh, int wanted, SeededRandom& random)
{
    std::vector<int> outline = boundary_loops(mesh)[0];
    std::vector<char> near(size_t(mesh.vertices()), 0),
        removed(size_t(mesh.triangles()), 0); // near: a hole or the outline
    const auto spread = [&](std::vector<char>& mark, int rings) {
        for (int ring = 0; ring < rings; ++ring) {
            const std::vector<char> before = mark;
            for (int f = 0; f < mesh.triangles(); ++f) {
                const Eigen::Vector3i t = mesh.triangle.col(f);
                if (before[size_t(t[0])] || before[size_t(t[1])] || before[size_t(t[2])])
                    for (int k = 0; k < 3; ++k)
                        mark[size_t(t[k])] = 1;
            }
        }
    };
    for (const int v : outline)
        near[size_t(v)] = 1;
    spread(near, 1);
    int cut = 0;
    for (int trial = 0; trial < 400 && cut < wanted; ++trial) {
        std::vector<char> hole(size_t(mesh.vertices()), 0);
        hole[size_t(random.whole(0, mesh.vertices() - 1))] = 1;
        spread(hole, random.whole(1, 3)); // the balls around a vertex, so that no edge pinches
        bool free = true;
        for (size_t v = 0; v < hole.size(); ++v)
            free = free && !(hole[v] && near[v]);
        if (!free)
            continue;
        for (int f = 0; f < mesh.triangles(); ++f) {
            const Eigen::Vector3i t = mesh.triangle.col(f);
            removed[size_t(f)] |= char(hole[size_t(t[0])] && hole[size_t(t[1])] && hole[size_t(t[2])]);
        }
        // it would leave an island: not there
        if (boundary_loops(without(mesh, removed)).size() != size_t(cut + 2)) {
            for (int f = 0; f < mesh.triangles(); ++f) {
                const Eigen::Vector3i t = mesh.triangle.col(f);
                if (hole[size_t(t[0])] && hole[size_t(t[1])] && hole[size_t(t[2])])
                    removed[size_t(f)] = 0;
            }
            continue;
        }
        spread(hole, 1);
        for (size_t v = 0; v < hole.size(); ++v)
            near[v] = char(near[v] || hole[v]);
        ++cut;
    }
    return without(mesh, removed);
}

/// The inner angle of a loop at vertex i, as its points at an arc length before and behind it see
/// it.
double inner_angle(const Points& loop, size_t i, double reach)
{
    const size_t n = loop.size();
    const auto walk = [&](int way) {
        double left = reach;
        size_t at = i;
        for (;;) {
            const size_t to = (at + n + size_t(way)) % n;
            const double edge = (loop[to] - loop[at]).norm();
            if (edge >= left)
                return Point(loop[at] + (loop[to] - loop[at]) * left / edge);
            left -= edge;
            at = to;
        }
    };
    const Point ahead = walk(1) - loop[i], behind = walk(-1) - loop[i];
    const double angle = std::atan2(cross(ahead, behind), ahead.dot(behind));
    return angle > 0 ? angle : angle + 2 * pi;
}

std::array<int, 4> random_corners(const TriMesh& part, SeededRandom& random)
{
    const auto loops = boundary_loops(part);
    size_t outer = 0;
    std::vector<Points> points;
    for (const auto& loop : loops) {
        points.emplace_back();
        for (const int v : loop)
            points.back().push_back(part.position.col(v).head<2>());
        if (length(points.back()) > length(points[outer])) // jagged holes are small
            outer = points.size() - 1;
    }
    const Points& loop = points[outer];
    std::vector<int> convex;
    for (size_t i = 0; i < loop.size(); ++i)
        if (inner_angle(loop, i, 1e-9 * length(loop)) < pi - 0.002 &&
            inner_angle(loop, i, 0.01 * length(loop)) < pi - 0.05)
            convex.push_back(int(i));
    if (convex.size() < 4)
        throw std::logic_error("an outline without four places for corners");
    std::set<int> chosen;
    while (chosen.size() < 4)
        chosen.insert(convex[size_t(random.whole(0, int(convex.size()) - 1))]);
    std::array<int, 4> corner;
    size_t k = 0;
    for (const int i : chosen)
        corner[k++] = loops[outer][size_t(i)];
    return corner;
}

} // namespace

TriMesh meshed_outline(const std::vector<Eigen::Vector2d>& outline)
{
    Eigen::Matrix2Xd points(2, outline.size());
    for (size_t i = 0; i < outline.size(); ++i)
        points.col(Eigen::Index(i)) = outline[i];
    const PlanarMesh mesh = mesh_polygon(points);
    TriMesh part;
    part.position = Eigen::Matrix3Xd::Zero(3, mesh.position.cols());
    part.position.topRows(2) = mesh.position;
    part.triangle = mesh.triangle;
    return part;
}

std::string_view outline_kind(int kind)
{
    constexpr std::array<std::string_view, outline_kinds> names = {"star",   "L",     "U",    "comb",
                                                                   "spiral", "lobes", "maze", "plate with holes"};
    return names.at(size_t(kind));
}

RandomOutline random_outline(int kind, int number)
{
    SeededRandom random(std::uint64_t(1000 * kind + number + 1));
    using Draw = Points (*)(SeededRandom&);
    constexpr std::array<Draw, outline_kinds> draw = {star, l_shape, u_shape, comb, spiral, lobes, maze, plate};
    RandomOutline result;
    result.name = fmt::format("{} {}", outline_kind(kind), number);
    const Points corners = turned_and_stretched(draw[size_t(kind)](random), random);
    // mesh_polygon() refuses some outlines with many points on a straight line that rounding has
    // bent: other points then.
    for (int pieces = pieces_of_outline; result.part.triangles() == 0; pieces += 7)
        result.part = meshed_outline(divided(corners, length(corners) / pieces));
    if (kind == outline_kinds - 1)
        result.part = with_holes(finer(result.part, 1), 1 + number % 20, random);
    result.corner = random_corners(result.part, random);
    return result;
}

} // namespace spia::shapes
