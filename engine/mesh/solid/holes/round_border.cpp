#include "engine/mesh/solid/holes/round_border.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/holes/border_walls.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using Kind = StatedSurface::Kind;

/// The place of both that is next to a given one, by the shortest steps; none where they meet at
/// less than 12 degrees, or farther away.
std::optional<Eigen::Vector3d> onto_both(const Level& a, const Level& b, const Eigen::Vector3d& from, double within)
{
    constexpr int most_steps = 20;
    constexpr double grazing = 0.2, rounding = 1e-12;
    Eigen::Vector3d p = from;
    for (int step = 0; step < most_steps; ++step) {
        Eigen::Matrix<double, 2, 3> n;
        n << a.normal(p).transpose(), b.normal(p).transpose();
        if (n.row(0).cross(n.row(1)).norm() < grazing)
            return std::nullopt;
        const Eigen::Vector2d off(a.value(p), b.value(p));
        const Eigen::Vector3d way = n.transpose() * (n * n.transpose()).inverse() * off;
        p -= way;
        if (!((p - from).norm() <= within))
            return std::nullopt;
        if (way.norm() <= rounding * (1 + p.norm()))
            return p;
    }
    return std::nullopt;
}

using Added = std::array<std::vector<int>, 3>; ///< per edge of a triangle: vertices between its
                                               ///< ends, in this order

/// Fans over a triangle with vertices along its edges.
void divide(int a, int b, int c, Added between, std::vector<Eigen::Vector3i>& into)
{
    for (int turn = 0; turn < 2 && between[0].empty(); ++turn) {
        std::swap(a, b); // a, b, c -> b, c, a
        std::swap(b, c);
        std::rotate(between.begin(), between.begin() + 1, between.end());
    }
    if (between[0].empty()) {
        into.emplace_back(a, b, c);
        return;
    }
    int from = a;
    for (const int v : between[0]) {
        divide(from, v, c, {{{}, {}, from == a ? between[2] : std::vector<int>{}}}, into);
        from = v;
    }
    divide(from, b, c, {{{}, between[1], {}}}, into);
}

class Border {
public:
    Border(SkinMesh& middle, TriMesh& outer, const TriMesh& solid, const ThinSolid& sheet,
           const std::vector<StatedSurface>& surface, const std::vector<int>& done)
        : middle_(middle), outer_(outer), half_(sheet.thickness / 2), surface_(surface),
          walls_(solid, sheet, surface, done), neighbour_(face_neighbours(outer.triangles(), edge_uses(outer.triangle)))
    {
        facing_ = area_vectors(outer);
        area_ = facing_.colwise().norm().sum();
    }

    /// Vertices where one cylinder cuts one plane or cylinder, or ends at a wall that it is tangent
    /// to.
    void place_vertices()
    {
        struct At {
            std::vector<int> rim, around;
            bool alone = true;
        };
        std::vector<At> at(size_t(outer_.vertices()));
        for (int f = 0; f < outer_.triangles(); ++f)
            for (int k = 0; k < 3; ++k) {
                At& here = at[size_t(outer_.triangle(k, f))];
                here.alone = here.alone && (here.around.empty() || same(here.around.back(), f));
                here.around.push_back(f);
                if (const int rim = rim_at(f, k); rim >= 0)
                    for (const int end : {outer_.triangle(k, f), outer_.triangle((k + 1) % 3, f)})
                        at[size_t(end)].rim.push_back(rim);
            }
        for (int v = 0; v < outer_.vertices(); ++v) {
            const At& here = at[size_t(v)];
            if (!here.alone || here.rim.empty())
                continue;
            const auto level = levels(here.around.back(), v);
            if (!level)
                continue;
            const Eigen::Vector3d up = level->second.normal(middle_.mesh.position.col(v));
            const auto cylinder = std::ranges::find_if(here.rim, [&](int rim) { return walls_.crosses(rim, up); });
            if (cylinder == here.rim.end())
                continue;
            auto place = middle_.mesh.position.col(v);
            const auto exact = onto_both(rim_level(*cylinder), level->second, start(v, *cylinder, *level), half_);
            if (!exact || !std::ranges::all_of(here.rim, [&](int rim) {
                    return walls_.tangent(*cylinder, rim, *exact, level->second.normal(*exact));
                }))
                continue;
            const Eigen::Vector3d was = place;
            place = *exact;
            if (!std::ranges::all_of(here.around, [&](int f) { return upright(f, corners(middle_.mesh, f)); }))
                place = was;
        }
    }

    int divide_chords()
    {
        int divided = 0;
        std::vector<Eigen::Vector3i> triangle;
        std::vector<int> source_face;
        for (int f = 0; f < facing_.cols(); ++f) {
            const size_t before = new_outer_.size(), first = triangle.size();
            Added between;
            int here = 0;
            for (int k = 0; k < 3; ++k) {
                between[size_t(k)] = between_ends(f, k);
                here += !between[size_t(k)].empty();
            }
            const auto corner = outer_.triangle.col(f);
            divide(corner[0], corner[1], corner[2], between, triangle);
            if (here > 0 && !std::all_of(triangle.begin() + long(first), triangle.end(),
                                         [&](const Eigen::Vector3i& t) { return both_upright(f, t); })) {
                triangle.resize(first); // the chord stays
                triangle.emplace_back(corner);
                new_outer_.resize(before);
                new_middle_.resize(before);
                new_source_.resize(before);
                here = 0;
            }
            divided += here;
            source_face.resize(triangle.size(), middle_.source_face[size_t(f)]);
        }
        if (divided > 0)
            take(triangle, std::move(source_face));
        return divided;
    }

private:
    SkinMesh& middle_;
    TriMesh& outer_;
    double half_;
    const std::vector<StatedSurface>& surface_;
    BorderWalls walls_;
    Eigen::Matrix3Xi neighbour_;
    Eigen::Matrix3Xd facing_;
    double area_; ///< mm2
    std::vector<Eigen::Vector3d> new_outer_, new_middle_;
    std::vector<int> new_source_;

    const StatedSurface& under(int f) const { return surface_[size_t(middle_.source_face[size_t(f)])]; }
    bool same(int f, int g) const
    {
        const StatedSurface &a = under(f), &b = under(g);
        if (a.kind == Kind::plane && b.kind == Kind::plane)
            return a.direction == b.direction && a.point == b.point;
        return same_cylinder(a, b);
    }
    /// The triangle of the solid across the edge; -1: it is none of the border.
    int rim_at(int f, int k) const
    {
        if (neighbour_(k, f) >= 0) // its ends may be called by two of the border
            return -1;
        const int a = middle_.source_vertex[size_t(outer_.triangle(k, f))],
                  b = middle_.source_vertex[size_t(outer_.triangle((k + 1) % 3, f))];
        return walls_.beyond(a, b);
    }
    Level rim_level(int rim) const { return {surface_[size_t(rim)], surface_[size_t(rim)].radius}; }

    /// Where to look for a vertex's place: where it is; of a chamfered border at the skin, square
    /// to the wall from its place, since there it ends where the wall does.
    Eigen::Vector3d start(int v, int wall, const std::pair<Level, Level>& level) const
    {
        const Eigen::Vector3d at_skin = outer_.position.col(v), here = middle_.mesh.position.col(v);
        const bool chamfered = std::abs(rim_level(wall).value(at_skin)) > walls_.gap();
        return chamfered ? at_skin - level.second.value(at_skin) * level.second.normal(at_skin) : here;
    }
    /// Of the outer skin and of the middle surface at a vertex; none where it is not on what CAD
    /// states.
    std::optional<std::pair<Level, Level>> levels(int f, int v) const
    {
        const StatedSurface& s = under(f);
        if (s.kind == Kind::other)
            return std::nullopt;
        Level outer{s, s.kind == Kind::plane ? 0 : s.radius};
        if (std::abs(outer.value(outer_.position.col(v))) > walls_.gap())
            return std::nullopt;
        const double side = outer.value(middle_.mesh.position.col(v)) > 0 ? 1 : -1;
        Level middle{s, outer.at + side * half_};
        if (s.kind == Kind::cylinder && !(middle.at > 0))
            return std::nullopt;
        return std::pair(outer, middle);
    }

    static Eigen::Matrix3d corners(const TriMesh& mesh, int f)
    {
        return mesh.position(Eigen::all, mesh.triangle.col(f));
    }

    /// Whether corners that take the place of the triangle's look the way it did.
    bool upright(int f, const Eigen::Matrix3d& corner) const
    {
        if (under(f).kind == Kind::cylinder)
            return unrolled_area(under(f), corner) * unrolled_area(under(f), corners(outer_, f)) > 0;
        return (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0)).dot(facing_.col(f)) > 0;
    }
    bool both_upright(int f, const Eigen::Vector3i& t) const
    {
        Eigen::Matrix3d outer, middle;
        for (int k = 0; k < 3; ++k) {
            const int v = t[k], added = v - outer_.vertices();
            outer.col(k) = added < 0 ? Eigen::Vector3d(outer_.position.col(v)) : new_outer_[size_t(added)];
            middle.col(k) = added < 0 ? Eigen::Vector3d(middle_.mesh.position.col(v)) : new_middle_[size_t(added)];
        }
        return upright(f, outer) && upright(f, middle);
    }

    /// How far the border turns along the chord, radians: around the cylinder that cuts it, and
    /// itself.
    double turn(const Level& rim, const Level& middle, const Eigen::Vector3d& a, const Eigen::Vector3d& b) const
    {
        const auto angle = [](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
            return std::atan2(u.cross(v).norm(), u.dot(v));
        };
        const Eigen::Vector3d along_a = rim.normal(a).cross(middle.normal(a)),
                              along_b = rim.normal(b).cross(middle.normal(b));
        return std::max(angle(rim.normal(a), rim.normal(b)), angle(along_a, along_b));
    }

    /// Vertices to come, along the edge of the triangle.
    std::vector<int> between_ends(int f, int k)
    {
        const int rim = rim_at(f, k);
        if (rim < 0 || surface_[size_t(rim)].kind != Kind::cylinder)
            return {};
        const int a = outer_.triangle(k, f), b = outer_.triangle((k + 1) % 3, f);
        const auto at_a = levels(f, a), at_b = levels(f, b);
        if (!at_a || !at_b || at_a->second.at != at_b->second.at)
            return {};
        const auto &outer = outer_.position, &middle = middle_.mesh.position;
        const Level cut = rim_level(rim);
        const auto cut_outer = walls_.around(cut.of, outer.col(a), outer.col(b)); // wider where it is chamfered
        if (!cut_outer)
            return {};
        constexpr double most = std::numbers::pi / 2;
        const double finest = fine_turn(surface_[size_t(rim)].radius, area_);
        const double angle = turn(cut, at_a->second, middle.col(a), middle.col(b));
        const int pieces = int(std::ceil(angle / finest - 1e-6));
        if (pieces < 2 || angle > most)
            return {};
        std::vector<int> result;
        std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> places;
        for (int i = 1; i < pieces; ++i) {
            const double share = double(i) / pieces;
            const auto within = [&](const auto& p) { return (p.col(a) - p.col(b)).norm() / 2; };
            const auto exact_outer =
                onto_both(*cut_outer, at_a->first, (1 - share) * outer.col(a) + share * outer.col(b), within(outer));
            const auto exact_middle =
                onto_both(cut, at_a->second, (1 - share) * middle.col(a) + share * middle.col(b), within(middle));
            if (!exact_outer || !exact_middle)
                return {};
            places.emplace_back(*exact_outer, *exact_middle);
        }
        for (const auto& [on_outer, on_middle] : places) {
            result.push_back(outer_.vertices() + int(new_outer_.size()));
            new_outer_.push_back(on_outer);
            new_middle_.push_back(on_middle);
            new_source_.push_back(middle_.source_vertex[size_t(a)]);
        }
        return result;
    }

    /// Sorts the vertices by their numbers of the solid: new ones come after those that they are
    /// called by.
    void take(const std::vector<Eigen::Vector3i>& triangle, std::vector<int> source_face)
    {
        std::vector<int> source = middle_.source_vertex;
        source.insert(source.end(), new_source_.begin(), new_source_.end());
        std::vector<int> order(source.size()), place(source.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(),
                         [&](int u, int v) { return source[size_t(u)] < source[size_t(v)]; });
        const int before = outer_.vertices();
        const Eigen::Matrix3Xd outer = std::move(outer_.position), middle = std::move(middle_.mesh.position);
        outer_.position.resize(3, Eigen::Index(order.size()));
        middle_.mesh.position.resize(3, Eigen::Index(order.size()));
        middle_.source_vertex.clear();
        for (size_t i = 0; i < order.size(); ++i) {
            const int v = order[i], added = v - before;
            place[size_t(v)] = int(i);
            outer_.position.col(Eigen::Index(i)) =
                added < 0 ? Eigen::Vector3d(outer.col(v)) : new_outer_[size_t(added)];
            middle_.mesh.position.col(Eigen::Index(i)) =
                added < 0 ? Eigen::Vector3d(middle.col(v)) : new_middle_[size_t(added)];
            middle_.source_vertex.push_back(source[size_t(v)]);
        }
        outer_.triangle.resize(3, Eigen::Index(triangle.size()));
        for (size_t f = 0; f < triangle.size(); ++f)
            for (int k = 0; k < 3; ++k)
                outer_.triangle(k, Eigen::Index(f)) = place[size_t(triangle[f][k])];
        middle_.mesh.triangle = outer_.triangle;
        middle_.source_face = std::move(source_face);
    }
};

/// The outer skin below a middle surface. What has been added to that is on no vertex of the solid,
/// and lies half a thickness outside.
TriMesh outer_below(const SkinMesh& middle, const TriMesh& solid, double thickness)
{
    TriMesh outer{solid.position(Eigen::all, middle.source_vertex), middle.mesh.triangle};
    const Eigen::Matrix3Xd facing = area_vectors(middle.mesh);
    Eigen::Matrix3Xd outwards = Eigen::Matrix3Xd::Zero(3, outer.vertices());
    for (int f = 0; f < outer.triangles(); ++f)
        for (const int v : outer.triangle.col(f))
            outwards.col(v) += facing.col(f);
    for (int v = 1; v < outer.vertices(); ++v)
        if (middle.source_vertex[size_t(v)] == middle.source_vertex[size_t(v - 1)]) // called by it
            outer.position.col(v) = middle.mesh.position.col(v) + thickness / 2 * outwards.col(v).normalized();
    return outer;
}

} // namespace

double fine_turn(double radius, double area)
{
    constexpr double most = 3 * std::numbers::pi / 180, least = most / 6, nothing = 5e-5;
    return std::clamp(std::sqrt(6 * nothing * area / std::numbers::pi) / radius, least, most);
}

int round_border(SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet,
                 const std::vector<StatedSurface>& surface, const std::vector<int>& done)
{
    TriMesh outer = outer_below(middle, solid, sheet.thickness);
    Border border(middle, outer, solid, sheet, surface, done);
    border.place_vertices();
    return border.divide_chords();
}

} // namespace spia
