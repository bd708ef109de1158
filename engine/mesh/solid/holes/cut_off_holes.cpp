#include "engine/mesh/solid/holes/cut_off_holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/small_dense.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/fit/cylinder_fit.h"
#include "engine/mesh/solid/fit/plane_regions.h"
#include "engine/mesh/solid/holes/hole_limits.h"

namespace spia {
namespace {

/// The circle across the direction in which places lie least apart.
std::optional<RoundEdge> circle_of(const Eigen::Matrix3Xd& places, double within)
{
    const Eigen::Matrix3Xd from = places.colwise() - Eigen::Vector3d(places.rowwise().mean());
    return round_edge(places, eigen_pairs(from * from.transpose()).vector.col(0), within);
}

} // namespace

CutOffHoles::CutOffHoles(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const ThinSolid& sheet)
    : solid_(solid), normal_(normal), sheet_(sheet),
      neighbour_(face_neighbours(solid.triangles(), edge_uses(solid.triangle)))
{
}

std::array<CutOffHoles::Meeting, 2> CutOffHoles::meetings(const std::vector<int>& wall) const
{
    std::array<Meeting, 2> result;
    for (const int f : wall)
        for (int k = 0; k < 3; ++k) {
            const int next = neighbour_(k, f);
            if (next < 0 || sheet_.side[size_t(next)] == SheetSide::rim)
                continue;
            Meeting& at = result[sheet_.side[size_t(next)] == SheetSide::outer ? 0 : 1];
            at.way.emplace(solid_.triangle((k + 1) % 3, f), solid_.triangle(k, f));
            at.wall.push_back(f);
        }
    return result;
}

bool CutOffHoles::square(const std::vector<int>& wall, const Eigen::Vector3d& axis) const
{
    constexpr double most = 0.1; // 6 degrees
    double along = 0, size = 0;
    for (const int f : wall) {
        along += std::abs(normal_.col(f).dot(axis));
        size += normal_.col(f).norm();
    }
    return along <= most * size;
}

bool CutOffHoles::around(const RoundEdge& circle, int f) const
{
    constexpr double chord = 0.5; // of normals, 30 degrees: slivers are off by more than chords are
    const Eigen::Vector3d n = normal_.col(f);
    const Eigen::Vector3d out =
        circle.off_axis(solid_.position(Eigen::all, solid_.triangle.col(f)).rowwise().mean()).normalized();
    return altitude(solid_, f, n) < sunk_in_hole * sheet_.thickness ||
           std::abs(n.dot(circle.axis.cross(out))) < chord * n.norm();
}

SunkHole CutOffHoles::cut_off(const Meeting& meeting, SheetSide skin, const Eigen::Vector3d& inwards) const
{
    SunkHole hole;
    hole.skin = skin;
    hole.inwards = inwards;
    hole.counterbore = square(meeting.wall, inwards);
    hole.face = *std::ranges::min_element(meeting.wall);
    hole.cut_off = true;
    hole.edge =
        outlines_along(meeting.way, skin, solid_, normal_, [&](int f) { return sheet_.side[size_t(f)] == skin; });
    return hole;
}

std::vector<SunkHole> CutOffHoles::of(const RoundHole& hole) const
{
    const double t = sheet_.thickness;
    const std::vector<int> vertex = corners(solid_, hole.wall);
    const auto radius = [&](int v) { return hole.mouth.off_axis(solid_.position.col(v)).norm(); };
    const auto height = [&](int v) { return hole.mouth.height(solid_.position.col(v)); };
    const double low = height(solid_.triangle(0, hole.beyond.front())); // of the other skin
    double least = std::numeric_limits<double>::infinity();
    for (const int v : vertex)
        least = std::min(least, radius(v));
    std::vector<int> narrowest;
    for (const int v : vertex)
        if (radius(v) <= least + same_in_hole * t)
            narrowest.push_back(v);
    const auto [deepest, highest] = std::ranges::minmax(narrowest, {}, height);
    const bool round = hole.mouth.surrounded(solid_.position(Eigen::all, narrowest));
    const auto meeting = meetings(hole.wall);
    const SheetSide far = sheet_.side[size_t(hole.beyond.front())],
                    near = far == SheetSide::outer ? SheetSide::inner : SheetSide::outer;
    std::vector<SunkHole> found;
    const auto measured = [&](SunkHole each, double wide, double depth) {
        each.diameter = 2 * wide;
        each.least = round ? 2 * least : 0;
        each.depth = depth;
        found.push_back(std::move(each));
    };
    const Meeting &at_far = meeting[far == SheetSide::outer ? 0 : 1],
                  &at_near = meeting[near == SheetSide::outer ? 0 : 1];
    if (far == SheetSide::rim || at_far.wall.empty() || at_near.wall.empty())
        return {};
    if (least < hole.mouth.radius - sunk_in_hole * t) {
        SunkHole each = cut_off(at_near, near, -hole.mouth.axis);
        each.centre = hole.mouth.centre;
        each.cut_off = false;
        each.edge.clear();
        if (near == SheetSide::outer)
            for (const auto& [v, next] : at_near.way)
                if (each.outer.empty() || each.outer.back() != v)
                    each.outer.push_back(v);
        measured(std::move(each), hole.mouth.radius, -height(highest));
    }
    if (least < hole.far - sunk_in_hole * t) {
        SunkHole each = cut_off(at_far, far, hole.mouth.axis);
        each.centre = hole.mouth.centre + low * hole.mouth.axis;
        measured(std::move(each), hole.far, height(deepest) - low);
    }
    return found;
}

std::vector<RoundEdge> CutOffHoles::sharp_circles(const std::vector<int>& wall) const
{
    constexpr double sharp =
        0.906; // the cosine of 25 degrees: a cone of 60 turns by 30 at its cylinder, chords by less
    std::vector<std::pair<int, int>> edges;
    std::vector<int> ends;
    for (const int f : wall)
        for (int k = 0; k < 3; ++k) {
            const int next = neighbour_(k, f);
            if (next < f || sheet_.side[size_t(next)] != SheetSide::rim ||
                normal_.col(f).dot(normal_.col(next)) > sharp * normal_.col(f).norm() * normal_.col(next).norm())
                continue;
            edges.emplace_back(solid_.triangle(k, f), solid_.triangle((k + 1) % 3, f));
            ends.insert(ends.end(), {edges.back().first, edges.back().second});
        }
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    const auto number = [&](int v) { return int(std::ranges::lower_bound(ends, v) - ends.begin()); };
    DisjointSets together(ends.size());
    for (const auto& [a, b] : edges)
        together.join(number(a), number(b));
    std::map<int, std::vector<int>> rows;
    for (size_t i = 0; i < ends.size(); ++i)
        rows[together.root(int(i))].push_back(ends[i]);
    std::vector<RoundEdge> circles;
    for (const auto& [root, row] : rows)
        if (const auto circle = circle_of(solid_.position(Eigen::all, row), same_in_hole * sheet_.thickness))
            circles.push_back(*circle);
    return circles;
}

std::vector<SunkHole> CutOffHoles::over_bend(const std::vector<int>& wall) const
{
    const double t = sheet_.thickness;
    const auto meeting = meetings(wall);
    if (meeting[0].wall.empty() || meeting[1].wall.empty())
        return {};
    const std::vector<int> vertex = corners(solid_, wall);
    std::vector<SunkHole> found;
    for (const RoundEdge& circle : sharp_circles(wall)) {
        const auto narrower = [&](int v) {
            return circle.off_axis(solid_.position.col(v)).norm() < circle.radius - same_in_hole * t;
        };
        const auto is_around = [&](int f) { return around(circle, f); };
        if (std::ranges::any_of(vertex, narrower) || !std::ranges::all_of(wall, is_around))
            continue;
        for (const size_t i : {size_t(0), size_t(1)}) {
            Eigen::Vector3d centre = Eigen::Vector3d::Zero();
            double wide = 0;
            for (const auto& [v, next] : meeting[i].way) {
                centre += solid_.position.col(v) / double(meeting[i].way.size());
                wide = std::max(wide, circle.off_axis(solid_.position.col(v)).norm());
            }
            if (wide < circle.radius + sunk_in_hole * t)
                continue;
            const double way = circle.height(centre) > 0 ? -1 : 1;
            SunkHole hole = cut_off(meeting[i], i == 0 ? SheetSide::outer : SheetSide::inner, way * circle.axis);
            hole.centre = circle.centre + circle.height(centre) * circle.axis;
            hole.least = 2 * circle.radius;
            found.push_back(std::move(hole));
        }
        if (!found.empty())
            break;
    }
    return found;
}

} // namespace spia
