#include "engine/mesh/solid/border/onto_projection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/flat/inside_polygon.h"
#include "engine/mesh/mesh_polygon.h"
#include "engine/mesh/nearest_share.h"
#include "engine/mesh/solid/border/along_rulings.h"
#include "engine/mesh/solid/border/beside_solid.h"
#include "engine/mesh/solid/fit/plane_regions.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"

namespace spia {
namespace {

using Point = Eigen::Vector2d;

/// A corner of a flat's outline.
struct Corner {
    int vertex; ///< of the middle surface; -1: a new one
    Point at;
};
using Ring = std::vector<Corner>;

/// A middle surface, flat by flat.
class Flats {
public:
    /// @param least_edge  mm, of the border; shorter ones stay
    Flats(const SkinMesh& middle, const std::vector<BesideLoop>& loops, double least_edge)
        : middle_(middle), mesh_(middle.mesh), least_edge_(least_edge)
    {
        const std::vector<EdgeUse> uses = edge_uses(mesh_.triangle);
        neighbour_ = face_neighbours(mesh_.triangles(), uses);
        const Eigen::Matrix3Xd normal = area_vectors(mesh_);
        constexpr double rounding = 1e-6;
        planes_ = plane_regions(mesh_, normal, neighbour_, rounding * bounding_diagonal(mesh_));
        beside_.assign(size_t(mesh_.vertices()), 0);
        for (const BesideLoop& loop : loops)
            for (size_t i = 0; i < loop.vertex.size(); ++i) {
                const int v = loop.vertex[i], w = loop.vertex[(i + 1) % loop.vertex.size()];
                beside_[size_t(v)] = std::max(beside_[size_t(v)], std::abs(loop.beside[2 * i]));
                edge_beside_[{v, w}] = std::abs(loop.beside[2 * i + 1]);
            }
    }

    int count() const { return int(planes_.direction.cols()); }

    /// Whether a plane is to be put onto the projection: flat sheet, none of the chords of a
    /// surface that turns, and its border beside that of the solid.
    bool is_off(int plane, const std::vector<StatedSurface>& under) const
    {
        constexpr double least = 1e-3; // of the area
        if (beside(plane) == 0)
            return false;
        double size = 0, whole = 0;
        bool turns = false;
        const Eigen::Matrix3Xd vectors = area_vectors(mesh_);
        for (int f = 0; f < mesh_.triangles(); ++f) {
            whole += vectors.col(f).norm();
            if (planes_.of[size_t(f)] != plane)
                continue;
            size += vectors.col(f).norm();
            turns |=
                !under.empty() && under[size_t(middle_.source_face[size_t(f)])].kind == StatedSurface::Kind::cylinder;
        }
        return !turns && size > least * whole;
    }

    /// mm, how far its border is beside that of the solid, in all.
    double beside(int plane) const
    {
        double sum = 0;
        for_each_side(plane, [&](int v, int w, int next) {
            if (next < 0)
                sum += beside_[size_t(v)] + beside_[size_t(w)] + at(v, w);
        });
        return sum;
    }

    FlatChart chart(int plane) const
    {
        const Eigen::Vector3d n = planes_.direction.col(plane), x = n.unitOrthogonal();
        return {planes_.level[plane] * n, x, n.cross(x), n};
    }

    /// Its outline, corners of the middle surface alone; nothing where it touches itself.
    std::optional<std::vector<Ring>> outline(int plane, const FlatChart& chart) const
    {
        std::map<int, int> next;
        bool alone = true;
        for_each_side(plane, [&](int v, int w, int) { alone &= next.insert({v, w}).second; });
        std::vector<Ring> rings;
        while (alone && !next.empty()) {
            Ring ring;
            int v = next.begin()->first;
            for (auto at = next.begin(); at != next.end(); at = next.find(v)) {
                ring.push_back({at->first, chart.flat(mesh_.position.col(at->first))});
                v = at->second;
                next.erase(at);
            }
            alone = v == ring.front().vertex && ring.size() >= 3;
            rings.push_back(std::move(ring));
        }
        return alone ? std::optional(rings) : std::nullopt;
    }

    /// Whether an edge of the outline is of the border and one of its ends or its middle is beside
    /// that of the solid.
    bool moves(int v, int w) const
    {
        return edge_beside_.contains({v, w}) && (mesh_.position.col(w) - mesh_.position.col(v)).norm() >= least_edge_ &&
               (beside_[size_t(v)] > 0 || beside_[size_t(w)] > 0 || at(v, w) > 0);
    }
    bool is_long(int v, int w) const { return (mesh_.position.col(w) - mesh_.position.col(v)).norm() >= least_edge_; }
    bool beside_at(int vertex) const { return beside_[size_t(vertex)] > 0; }

    /// The surface with other triangles on a plane.
    std::optional<SkinMesh> with(int plane, const FlatChart& chart, const std::vector<Ring>& rings) const
    {
        std::vector<Eigen::Matrix2Xd> points;
        std::vector<Corner> corners;
        for (const Ring& ring : rings) {
            points.emplace_back(2, ring.size());
            for (size_t i = 0; i < ring.size(); ++i) {
                points.back().col(Eigen::Index(i)) = ring[i].at;
                corners.push_back(ring[i]);
            }
        }
        const PlanarMesh flat = triangulate_polygon(points);
        if (flat.triangle.cols() == 0)
            return std::nullopt;
        std::vector<Eigen::Vector3d> position;
        std::vector<int> source_vertex = middle_.source_vertex;
        for (const auto& p : mesh_.position.colwise())
            position.emplace_back(p);
        const std::vector<std::pair<Point, int>> named = places(plane, chart);
        for (Corner& corner : corners) {
            if (corner.vertex >= 0) {
                position[size_t(corner.vertex)] = chart.in_space(corner.at);
                continue;
            }
            corner.vertex = int(position.size());
            position.push_back(chart.in_space(corner.at));
            source_vertex.push_back(nearest(named, corner.at));
        }
        struct Named {
            Triangle corner;
            int source;
        };
        std::vector<Named> triangle;
        for (int f = 0; f < mesh_.triangles(); ++f)
            if (planes_.of[size_t(f)] != plane)
                triangle.push_back({{mesh_.triangle(0, f), mesh_.triangle(1, f), mesh_.triangle(2, f)},
                                    middle_.source_face[size_t(f)]});
        const std::vector<std::pair<Point, int>> faces = middles(plane, chart);
        for (const auto& t : flat.triangle.colwise()) {
            const Point middle = (flat.position.col(t[0]) + flat.position.col(t[1]) + flat.position.col(t[2])) / 3;
            triangle.push_back(
                {{corners[size_t(t[0])].vertex, corners[size_t(t[1])].vertex, corners[size_t(t[2])].vertex},
                 nearest(faces, middle)});
        }
        std::ranges::stable_sort(triangle, {}, &Named::source);
        SkinMesh result = middle_;
        std::vector<char> used(position.size(), 0);
        for (const Named& t : triangle)
            for (const int v : t.corner)
                used[size_t(v)] = 1;
        std::vector<int> order;
        for (int v = 0; v < int(position.size()); ++v)
            if (used[size_t(v)])
                order.push_back(v);
        std::ranges::stable_sort(order, {}, [&](int v) { return source_vertex[size_t(v)]; });
        std::vector<int> number(position.size(), -1);
        result.mesh.position.resize(3, Eigen::Index(order.size()));
        result.source_vertex.clear();
        for (size_t i = 0; i < order.size(); ++i) {
            number[size_t(order[i])] = int(i);
            result.mesh.position.col(Eigen::Index(i)) = position[size_t(order[i])];
            result.source_vertex.push_back(source_vertex[size_t(order[i])]);
        }
        result.mesh.triangle.resize(3, Eigen::Index(triangle.size()));
        result.source_face.clear();
        for (size_t f = 0; f < triangle.size(); ++f) {
            for (int k = 0; k < 3; ++k)
                result.mesh.triangle(k, Eigen::Index(f)) = number[size_t(triangle[f].corner[size_t(k)])];
            result.source_face.push_back(triangle[f].source);
        }
        return result;
    }

private:
    const SkinMesh& middle_;
    const TriMesh& mesh_;
    double least_edge_;
    Eigen::Matrix3Xi neighbour_;
    PlaneRegions planes_;
    std::vector<double> beside_;                        ///< mm, per vertex
    std::map<std::pair<int, int>, double> edge_beside_; ///< mm, per edge of the border, along it

    double at(int v, int w) const
    {
        const auto found = edge_beside_.find({v, w});
        return found == edge_beside_.end() ? 0 : found->second;
    }

    /// Calls visit(from, to, face beyond) for the edges around a plane, with it on their left.
    void for_each_side(int plane, const auto& visit) const
    {
        for (int f = 0; f < mesh_.triangles(); ++f)
            for (int k = 0; planes_.of[size_t(f)] == plane && k < 3; ++k)
                if (const int next = neighbour_(k, f); next < 0 || planes_.of[size_t(next)] != plane)
                    visit(mesh_.triangle(k, f), mesh_.triangle((k + 1) % 3, f), next);
    }

    static int nearest(const std::vector<std::pair<Point, int>>& named, const Point& to)
    {
        return std::ranges::min_element(named, {}, [&](const auto& each) { return (each.first - to).squaredNorm(); })
            ->second;
    }
    /// Of its vertices, with their numbers of the solid.
    std::vector<std::pair<Point, int>> places(int plane, const FlatChart& chart) const
    {
        std::vector<std::pair<Point, int>> result;
        for_each_side(plane, [&](int v, int, int) {
            result.emplace_back(chart.flat(mesh_.position.col(v)), middle_.source_vertex[size_t(v)]);
        });
        return result;
    }
    std::vector<std::pair<Point, int>> middles(int plane, const FlatChart& chart) const
    {
        std::vector<std::pair<Point, int>> result;
        for (int f = 0; f < mesh_.triangles(); ++f)
            if (planes_.of[size_t(f)] == plane)
                result.emplace_back(chart.flat(mesh_.position(Eigen::all, mesh_.triangle.col(f)).rowwise().mean()),
                                    middle_.source_face[size_t(f)]);
        return result;
    }
};

Eigen::Matrix2Xd points_of(const Ring& ring)
{
    Eigen::Matrix2Xd result(2, ring.size());
    for (size_t i = 0; i < ring.size(); ++i)
        result.col(Eigen::Index(i)) = ring[i].at;
    return result;
}

double signed_area(const Eigen::Matrix2Xd& ring)
{
    double sum = 0;
    for (Eigen::Index i = 0; i < ring.cols(); ++i)
        sum += cross(ring.col(i) - ring.col(0), ring.col((i + 1) % ring.cols()) - ring.col(0)) / 2;
    return sum;
}

bool overlap(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b)
{
    const auto box = [](const Eigen::Matrix2Xd& m) {
        return Eigen::AlignedBox2d(Point(m.rowwise().minCoeff()), Point(m.rowwise().maxCoeff()));
    };
    return box(a).intersects(box(b));
}

/// Puts a flat's outline onto that of the projection.
class Mover {
public:
    Mover(const Flats& flats, const SlabProjection& projection, double reach)
        : flats_(flats), projection_(projection), reach_(reach)
    {
    }

    /// Nothing if it is not known where to.
    std::optional<std::vector<Ring>> moved(const std::vector<Ring>& outline)
    {
        std::vector<Ring> result;
        for (const Ring& ring : outline) {
            const auto on_it = moved(ring);
            if (!on_it)
                return std::nullopt;
            if (on_it->size() >= 3)
                result.push_back(*on_it);
        }
        add_holes(result);
        std::ranges::stable_sort(result, std::greater(), [](const Ring& r) { return signed_area(points_of(r)); });
        const bool one = !result.empty() && signed_area(points_of(result.front())) > 0 &&
                         (result.size() == 1 || signed_area(points_of(result[1])) < 0);
        return one ? std::optional(result) : std::nullopt;
    }

private:
    const Flats& flats_;
    const SlabProjection& projection_;
    double reach_; ///< mm, what is on the projection's outline

    /// Long ones that are to be moved, and those that hang together with them.
    std::vector<char> moving_edges(const Ring& ring) const
    {
        const size_t n = ring.size();
        std::vector<char> off(n), result(n);
        for (size_t i = 0; i < n; ++i) {
            const int v = ring[i].vertex, w = ring[(i + 1) % n].vertex;
            off[i] = flats_.moves(v, w);
            result[i] = off[i] && flats_.is_long(v, w);
        }
        for (size_t k = 0; k < 2 * n; ++k) // there and back, across the seam of the ring
            for (const auto& [from, to] :
                 {std::pair(k % n, (k + 1) % n), std::pair((2 * n - 1 - k) % n, (3 * n - 2 - k) % n)})
                if (result[from % n] && off[to % n])
                    result[to % n] = 1;
        return result;
    }

    std::optional<Ring> moved(const Ring& ring) const
    {
        const size_t n = ring.size();
        const std::vector<char> moving = moving_edges(ring);
        const auto moves = [&](size_t i) { return moving[i % n] != 0; };
        size_t start = 0;
        while (start < n && (moves(start) || !moves(start + n - 1)))
            ++start; // the first edge that stays after one that moves
        if (start == n)
            return moves(0) ? whole(ring) : ring;
        Ring result;
        for (size_t k = 0; k < n;) {
            const size_t i = start + k;
            if (!moves(i)) {
                result.push_back(ring[i % n]);
                ++k;
                continue;
            }
            size_t end = i;
            while (moves(end))
                ++end;
            const Corner &from = ring[i % n], &to = ring[end % n];
            if (flats_.beside_at(from.vertex) || flats_.beside_at(to.vertex))
                return std::nullopt; // the end of a bend
            const AlongRing a = projection_.nearest(from.at), b = projection_.nearest(to.at);
            if (a.distance > reach_ || b.distance > reach_ || a.ring != b.ring)
                return std::nullopt;
            result.push_back(from);
            for (const Point& p : projection_.between(a, b))
                if ((p - from.at).norm() > reach_ && (p - to.at).norm() > reach_)
                    result.push_back({-1, p});
            k += end - i;
        }
        return result;
    }

    /// Instead of a ring all of which is elsewhere; without corners: there is none.
    Ring whole(const Ring& ring) const
    {
        const Eigen::Matrix2Xd points = points_of(ring);
        const bool hole = signed_area(points) < 0;
        const Point middle = points.rowwise().mean();
        Ring result;
        double nearest = std::numeric_limits<double>::infinity();
        for (size_t r = 0; r < projection_.rings().size(); ++r) {
            const Eigen::Matrix2Xd& other = projection_.rings()[r];
            const double distance = (other.rowwise().mean() - middle).norm();
            if ((signed_area(other) < 0) != hole || !overlap(points, other) || distance >= nearest)
                continue;
            nearest = distance;
            result.clear();
            for (const Point& p : projection_.whole(r))
                result.push_back({-1, p});
        }
        return result;
    }

    /// Those that lie in the outline and beside its holes.
    void add_holes(std::vector<Ring>& outline) const
    {
        std::vector<Ring> added;
        for (size_t r = 0; r < projection_.rings().size(); ++r) {
            const Eigen::Matrix2Xd& hole = projection_.rings()[r];
            if (signed_area(hole) >= 0)
                continue;
            const bool beside = std::ranges::all_of(outline, [&](const Ring& ring) {
                const Eigen::Matrix2Xd points = points_of(ring);
                const bool outside = signed_area(points) > 0;
                for (const auto& p : hole.colwise())
                    if (inside_polygon(points, p) != outside || distance_from(points, p) <= reach_)
                        return false;
                for (const auto& p : points.colwise())
                    if (!outside && inside_polygon(hole, p))
                        return false;
                return true;
            });
            if (!beside)
                continue;
            added.emplace_back();
            for (const Point& p : projection_.whole(r))
                added.back().push_back({-1, p});
        }
        std::ranges::move(added, std::back_inserter(outline));
    }

    static double distance_from(const Eigen::Matrix2Xd& ring, const Point& place)
    {
        double least = std::numeric_limits<double>::infinity();
        for (Eigen::Index i = 0; i < ring.cols(); ++i) {
            const Point a = ring.col(i), way = ring.col((i + 1) % ring.cols()) - a;
            const double share = nearest_share(place, a, way);
            least = std::min(least, (a + share * way - place).norm());
        }
        return least;
    }
};

/// A middle surface and how far its border is beside that of the solid.
struct Held {
    std::vector<BesideLoop> loops;
    double sum; ///< mm
};

Held held(const TriMesh& middle, const GivenSolid& solid, double tolerance)
{
    Held result{beside_loops(middle, solid.mesh, solid.thickness, tolerance, solid.deflection), 0};
    for (const BesideLoop& loop : result.loops)
        for (const double each : loop.beside)
            result.sum += std::abs(each);
    return result;
}

/// Puts flats onto the projection one by one.
void flats_onto_projection(SkinMesh& middle, const std::vector<StatedSurface>& under, Held& now,
                           const GivenSolid& solid, double tolerance, double least_edge)
{
    for (int plane = 0; now.sum > 0;) {
        const Flats flats(middle, now.loops, least_edge);
        while (plane < flats.count() && !flats.is_off(plane, under))
            ++plane;
        if (plane == flats.count())
            return;
        const FlatChart chart = flats.chart(plane);
        const auto outline = flats.outline(plane, chart);
        ++plane;
        if (!outline)
            continue;
        const SlabProjection projection(solid, chart);
        const auto moved = Mover(flats, projection, tolerance).moved(*outline);
        std::optional<SkinMesh> better = moved ? flats.with(plane - 1, chart, *moved) : std::nullopt;
        if (!better)
            continue;
        if (Held then = held(better->mesh, solid, tolerance); then.sum + tolerance < now.sum) {
            middle = std::move(*better);
            now = std::move(then);
            plane = 0; // they are counted by their size
        }
    }
}

} // namespace

void onto_projection(SkinMesh& middle, const std::vector<StatedSurface>& under, const GivenSolid& solid,
                     double tolerance, double least_edge)
{
    Held now = held(middle.mesh, solid, tolerance);
    if (now.sum > 0 && !under.empty()) {
        TriMesh moved = along_rulings(middle, now.loops, under, solid, tolerance);
        if (Held then = held(moved, solid, tolerance); then.sum < now.sum) {
            middle.mesh = std::move(moved);
            now = std::move(then);
        }
    }
    flats_onto_projection(middle, under, now, solid, tolerance, least_edge);
}

} // namespace spia
