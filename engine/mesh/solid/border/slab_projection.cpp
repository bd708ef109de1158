#include "engine/mesh/solid/border/slab_projection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/flat/polygon_union.h"
#include "engine/mesh/nearest_share.h"
#include "engine/mesh/solid/border/askew_wall.h"
#include "engine/mesh/vectors.h"

namespace spia {
namespace {

using Point = Eigen::Vector2d;

/// A triangle of a solid between two planes.
struct SlabTriangle {
    int face;
    Eigen::Matrix2Xd flat;  ///< its corners, seen square to the planes
    Eigen::Vector3d height; ///< mm, over the middle between them
    Point outwards;         ///< of its unit normal, the part along the planes
    double lean;            ///< and square to them, upwards
};

/// Closed rows around the triangles that are seen from above: how often they go around a place is
/// how many layers of the solid are below it.
std::vector<Eigen::Matrix2Xd> around_upper(const TriMesh& solid, const std::vector<SlabTriangle>& slab,
                                           const FlatChart& chart, double flipped)
{
    constexpr double rounding = 1e-6;        // of a square wall's normal
    std::map<std::pair<int, int>, int> uses; // of an edge, from its lower end on
    for (const SlabTriangle& each : slab)
        for (int k = 0; each.lean > rounding && k < 3; ++k) {
            int a = solid.triangle(k, each.face), b = solid.triangle((k + 1) % 3, each.face);
            if (flipped < 0)
                std::swap(a, b);
            uses[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    std::multimap<int, int> next;
    for (const auto& [edge, times] : uses)
        if (times != 0)
            next.insert(times > 0 ? edge : std::pair(edge.second, edge.first));
    std::vector<Eigen::Matrix2Xd> rows;
    while (!next.empty()) {
        std::vector<int> row;
        for (auto at = next.begin(); at != next.end(); at = next.find(row.back())) {
            row.push_back(at->second);
            next.erase(at);
        }
        rows.emplace_back(2, row.size());
        for (size_t i = 0; i < row.size(); ++i)
            rows.back().col(Eigen::Index(i)) = chart.flat(solid.position.col(row[i]));
    }
    return rows;
}

/// Those of walls that cross the sheet askew.
std::vector<SlabTriangle> askew(const TriMesh& solid, const std::vector<SlabTriangle>& slab, const SheetPlane& sheet)
{
    const Eigen::Matrix3Xi neighbour = face_neighbours(solid.triangles(), edge_uses(solid.triangle));
    std::vector<char> taken(size_t(solid.triangles()), 0), crosses = taken;
    std::vector<SlabTriangle> result;
    for (const SlabTriangle& each : slab) {
        if (!taken[size_t(each.face)]) {
            const AskewWall wall = askew_wall(solid, neighbour, each.face, sheet);
            for (const int f : wall.face) {
                taken[size_t(f)] = 1;
                crosses[size_t(f)] |= wall.crosses;
            }
        }
        if (crosses[size_t(each.face)])
            result.push_back(each);
    }
    return result;
}

/// What is beyond where such a wall crosses the middle: the part of it that hangs over, and
/// straight outwards from the middle what a chamfer has left of a corner there.
/// @param into  gets these polygons
void add_overhanging(const SlabTriangle& wall, double half, std::vector<Eigen::Matrix2Xd>& into)
{
    std::vector<Point> part, middle;
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const double over = wall.lean > 0 ? -1 : 1, a = over * wall.height[k], b = over * wall.height[next];
        if (a >= 0)
            part.emplace_back(wall.flat.col(k));
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
            part.emplace_back(wall.flat.col(k) + a / (a - b) * (wall.flat.col(next) - wall.flat.col(k)));
            middle.push_back(part.back());
        }
    }
    const Point beyond = half * std::abs(wall.lean) * wall.outwards / wall.outwards.squaredNorm();
    if (middle.size() == 2) {
        into.emplace_back(2, 4);
        into.back() << middle[0], middle[1], middle[1] + beyond, middle[0] + beyond;
    }
    if (part.size() < 3)
        return;
    into.emplace_back(2, part.size());
    for (size_t i = 0; i < part.size(); ++i)
        into.back().col(Eigen::Index(i)) = part[i];
}

} // namespace

SlabProjection::SlabProjection(const GivenSolid& given, const FlatChart& chart)
{
    const TriMesh& solid = given.mesh;
    const std::vector<StatedSurface>& surface = given.surface;
    const double half = given.thickness / 2;
    constexpr double square = 0.01; // sine of 0.6 degrees
    const SheetPlane sheet{chart.origin, chart.normal, half};
    std::vector<SlabTriangle> slab;
    std::vector<Eigen::Matrix2Xd> overhanging;
    for (int f = 0; f < solid.triangles(); ++f) {
        if (!sheet.holds(solid, f))
            continue;
        SlabTriangle here{f, Eigen::Matrix2Xd(2, 3), {}, {}, 0};
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d p = solid.position.col(solid.triangle(k, f));
            here.flat.col(k) = chart.flat(p);
            here.height[k] = chart.height(p);
        }
        const Eigen::Matrix3d corner = solid.position(Eigen::all, solid.triangle.col(f));
        const Eigen::Vector3d normal =
            given.flipped * (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0)).normalized();
        here.outwards = {normal.dot(chart.x), normal.dot(chart.y)};
        here.lean = normal.dot(chart.normal);
        slab.push_back(here);
        if (surface.empty() || surface[size_t(f)].kind != StatedSurface::Kind::cylinder ||
            surface[size_t(f)].direction.cross(chart.normal).norm() > square)
            continue;
        const Point axis = chart.flat(surface[size_t(f)].point);
        for (int k = 0; k < 3; ++k)
            arc_[key(here.flat.col(k), here.flat.col((k + 1) % 3))] = {axis, surface[size_t(f)].radius};
    }
    for (const SlabTriangle& each : askew(solid, slab, sheet))
        add_overhanging(each, half, overhanging);
    ring_ = polygon_union(around_upper(solid, slab, chart, given.flipped), overhanging);
}

AlongRing SlabProjection::nearest(const Point& place) const
{
    AlongRing best;
    for (size_t r = 0; r < ring_.size(); ++r)
        for (Eigen::Index i = 0; i < ring_[r].cols(); ++i) {
            const Point a = ring_[r].col(i), way = ring_[r].col((i + 1) % ring_[r].cols()) - a;
            const double share = nearest_share(place, a, way);
            if (const double distance = (a + share * way - place).norm(); distance < best.distance)
                best = {r, double(i) + share, distance};
        }
    return best;
}

std::vector<Point> SlabProjection::between(const AlongRing& from, const AlongRing& to) const
{
    const Eigen::Matrix2Xd& ring = ring_[from.ring];
    const double n = double(ring.cols());
    std::vector<Point> result;
    const double end = to.at > from.at ? to.at : to.at + n;
    for (double i = std::floor(from.at) + 1; i < end; ++i)
        add(ring.col(Eigen::Index(i) % ring.cols()), ring, Eigen::Index(i), result);
    return result;
}

std::vector<Point> SlabProjection::whole(size_t r) const
{
    std::vector<Point> result;
    for (Eigen::Index i = 0; i < ring_[r].cols(); ++i)
        add(ring_[r].col(i), ring_[r], i, result);
    return result;
}

SlabProjection::Key SlabProjection::key(const Point& a, const Point& b)
{
    const auto less = [](const Point& p, const Point& q) { return std::pair(p.x(), p.y()) < std::pair(q.x(), q.y()); };
    return less(a, b) ? Key{a.x(), a.y(), b.x(), b.y()} : Key{b.x(), b.y(), a.x(), a.y()};
}

void SlabProjection::add(const Point& point, const Eigen::Matrix2Xd& ring, Eigen::Index i,
                         std::vector<Point>& result) const
{
    const Point before = ring.col((i - 1 + ring.cols()) % ring.cols());
    if (const auto found = arc_.find(key(before, point)); found != arc_.end()) {
        constexpr double finest = 3 * std::numbers::pi / 180; // as round_border() has them
        const auto& [centre, radius] = found->second;
        const Point a = before - centre, b = point - centre;
        const double angle = std::atan2(cross(a, b), a.dot(b));
        const int pieces = int(std::ceil(std::abs(angle) / finest - 1e-6));
        for (int k = 1; k < pieces; ++k) {
            const Eigen::Rotation2Dd turn(angle * k / pieces);
            result.emplace_back(centre + radius * (turn * a).normalized());
        }
    }
    result.push_back(point);
}

} // namespace spia
