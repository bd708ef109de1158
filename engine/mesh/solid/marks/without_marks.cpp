#include "engine/mesh/solid/marks/without_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/flat_triangles.h"
#include "engine/mesh/solid/marks/refilled_mark.h"
#include "engine/mesh/solid/marks/sheet_heights.h"
#include "engine/mesh/solid/marks/sheet_marks.h"
#include "engine/mesh/solid/off_axis.h"
#include "engine/mesh/solid/thin_solid.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Takes the marks out of a solid.
class Flattening {
public:
    Flattening(const TriMesh& solid, const ThinSolid& sheet, const std::vector<StatedSurface>& surface)
        : solid_(solid), sheet_(sheet), surface_(surface), normal_(sheet.flipped * area_vectors(solid)),
          mark_(size_t(solid.triangles()), -1), wall_(size_t(solid.triangles()), 0), floors_(size_t(solid.triangles())),
          around_(size_t(solid.vertices())), level_(size_t(solid.vertices()), 0),
          refilled_(size_t(solid.triangles()), 0), position_(solid.position)
    {
        for (int v = 0; v < solid.vertices(); ++v)
            target_.push_back(v);
        for (size_t m = 0; m < sheet.marks.size(); ++m) {
            for (const int f : sheet.marks[m].floor)
                mark_[size_t(f)] = int(m);
            for (const int f : sheet.marks[m].wall) {
                mark_[size_t(f)] = int(m);
                wall_[size_t(f)] = 1;
            }
        }
        for (int f = 0; f < solid.triangles(); ++f)
            for (int k = 0; k < 3; ++k)
                around_[size_t(solid.triangle(k, f))].push_back(f);
    }

    PlainSolid plain()
    {
        refill();
        for (const SheetSide skin : {SheetSide::outer, SheetSide::inner})
            flatten(skin);
        return closed_again();
    }

private:
    const TriMesh& solid_;
    const ThinSolid& sheet_;
    const std::vector<StatedSurface>& surface_; ///< per triangle; empty: nothing is stated
    Eigen::Matrix3Xd normal_;                   ///< area vectors, outwards
    std::vector<int> mark_;                     ///< per triangle, -1: none
    std::vector<char> wall_;                    ///< per triangle
    DisjointSets floors_;                       ///< triangles of floors that hang together
    std::vector<std::vector<int>> around_;
    std::vector<char> level_;            ///< per vertex: on the skin already
    std::vector<int> target_;            ///< per vertex the one that it becomes
    std::vector<char> refilled_;         ///< per triangle: of a mark that was cut out
    std::multimap<int, Triangle> fill_;  ///< what closes the skin there, by a triangle of the skin
                                         ///< beside it
    std::vector<Eigen::Vector3d> added_; ///< vertices of that, numbered from #V on
    std::vector<int> added_at_;          ///< vertices of the solid by which they are called
    Eigen::Matrix3Xd position_;

    /// Marks on plane skin and on bends are cut out, and the skin is closed over them; at the rim,
    /// and on other skin, their floors are put back.
    void refill()
    {
        constexpr double flat = 1e-3; // of the thickness
        std::map<SheetSide, std::vector<char>> skin;
        for (const SheetSide side : {SheetSide::outer, SheetSide::inner})
            for (int f = 0; f < solid_.triangles(); ++f)
                skin[side].push_back(mark_[size_t(f)] < 0 && sheet_.side[size_t(f)] == side);
        std::vector<char> of_mark(size_t(solid_.triangles()), 0);
        for (size_t m = 0; m < sheet_.marks.size(); ++m) {
            const SheetMark& mark = sheet_.marks[m];
            std::vector<int> faces = mark.floor;
            faces.insert(faces.end(), mark.wall.begin(), mark.wall.end());
            std::sort(faces.begin(), faces.end());
            for (const int f : faces)
                of_mark[size_t(f)] = 1;
            const std::optional<RefilledMark> fill =
                refilled_mark({solid_, normal_, around_, skin.at(sheet_.side[size_t(mark.face)]), of_mark, surface_,
                               flat * sheet_.thickness},
                              faces);
            for (const int f : faces)
                of_mark[size_t(f)] = 0;
            if (!fill)
                continue;
            for (const int f : faces)
                refilled_[size_t(f)] = 1;
            take(*fill);
        }
    }

    void take(const RefilledMark& fill)
    {
        const int first = solid_.vertices() + int(added_.size()), before = solid_.vertices();
        for (size_t i = 0; i < fill.triangle.size(); ++i) {
            Triangle t = fill.triangle[i];
            for (int& v : t)
                v += v < before ? 0 : first - before;
            fill_.emplace(fill.beside[i], t);
        }
        added_.insert(added_.end(), fill.added.begin(), fill.added.end());
        added_at_.resize(added_.size(), fill.vertex);
    }

    bool is_floor(int f) const { return mark_[size_t(f)] >= 0 && !wall_[size_t(f)]; }
    bool is_wall(int f) const { return mark_[size_t(f)] >= 0 && wall_[size_t(f)]; }
    int corner(int k, int f) const { return solid_.triangle(k, f); }

    /// What is to be known of a vertex of a floor.
    struct FloorVertex {
        int v, floor; ///< floor: root of floors_
        Eigen::Vector3d normal;
        double size;   ///< mm2, of its triangles there
        double height; ///< mm, to the level of the skin
        int over = -1; ///< the vertex of the skin straight over it
    };

    void flatten(SheetSide skin)
    {
        std::vector<int> faces;
        for (int f = 0; f < solid_.triangles(); ++f)
            if (mark_[size_t(f)] >= 0 && !refilled_[size_t(f)] && sheet_.side[size_t(f)] == skin)
                faces.push_back(f);
        if (faces.empty())
            return;
        const auto is_of = [&](int f, bool own) {
            const SheetSide side = sheet_.side[size_t(f)];
            return side != SheetSide::rim && (side == skin) == own && mark_[size_t(f)] < 0;
        };
        HeightAboveSkin above(
            solid_, [&](int f) { return is_of(f, true); }, [&](int f) { return is_of(f, false); }, sheet_.thickness,
            sheet_.flipped);
        for (const int f : faces)
            for (int k = 0; k < 3; ++k)
                for (const int g : around_[size_t(corner(k, f))]) {
                    level_[size_t(corner(k, f))] |= mark_[size_t(g)] < 0 && sheet_.side[size_t(g)] == skin;
                    const auto shared = (solid_.triangle.col(g).array() == corner((k + 1) % 3, f)).any();
                    if (is_floor(f) && is_floor(g) && shared)
                        floors_.join(f, g);
                }
        std::vector<FloorVertex> floor = floor_vertices(faces, above);
        const std::map<int, double> step = steps(floor);
        for (const FloorVertex& at : floor)
            if (!level_[size_t(at.v)])
                put_back(at, step.at(at.floor));
        for (const int f : faces)
            for (int k = 0; k < 3; ++k)
                if (const int v = corner(k, f);
                    is_wall(f) && !level_[size_t(v)] && !on_floor(v) && position_.col(v) == solid_.position.col(v)) {
                    const ClosestPoint near = above.over_other().nearest(v);
                    if (near.face >= 0 && near.distance > 0)
                        position_.col(v) =
                            near.position + sheet_.thickness / near.distance * (solid_.position.col(v) - near.position);
                }
    }

    bool on_floor(int v) const
    {
        return std::any_of(around_[size_t(v)].begin(), around_[size_t(v)].end(), [&](int f) { return is_floor(f); });
    }

    std::vector<FloorVertex> floor_vertices(const std::vector<int>& faces, HeightAboveSkin& above)
    {
        std::map<int, FloorVertex> found;
        std::map<int, std::vector<double>> heights; // of floors
        for (const int f : faces)
            for (int k = 0; k < 3 && is_floor(f); ++k) {
                const int v = corner(k, f);
                FloorVertex& at =
                    found.try_emplace(v, FloorVertex{v, floors_.root(f), Eigen::Vector3d::Zero(), 0, -above(v)})
                        .first->second;
                const double size = normal_.col(f).norm();
                const Eigen::Vector3d own = normal_.col(f) / size;
                at.normal +=
                    size * (surface_.empty() ? own : normal_at(surface_[size_t(f)], solid_.position.col(v), own));
                at.size += size;
                heights[floors_.root(f)].push_back(at.height);
            }
        // Islands are on the skin already, and what lies around them ends there.
        constexpr double same_level = 1e-3; // of the thickness
        for (auto& [floor, values] : heights) {
            std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
            if (std::abs(values[values.size() / 2]) <= same_level * sheet_.thickness)
                for (const auto& [v, at] : found)
                    if (at.floor == floor)
                        level_[size_t(v)] = 1;
        }
        std::vector<FloorVertex> result;
        for (auto& [v, at] : found) {
            constexpr double rounding = 1e-9;
            const bool plane = at.normal.norm() > (1 - rounding) * at.size;
            at.normal.normalize();
            if (!level_[size_t(v)]) {
                at.over = straight_over(at);
                // Of a bend triangles are chords; a vertex opposite to another one looks straight
                // at it.
                constexpr double exact = 1e-4, alike = 0.94;
                const ClosestPoint near = above.over_other().nearest(v);
                const Eigen::Vector3d away = (solid_.position.col(v) - near.position).normalized();
                if (!plane && near.face >= 0 && near.barycentric.maxCoeff() > 1 - exact && away.dot(at.normal) > alike)
                    at.normal = away;
            }
            result.push_back(at);
        }
        return result;
    }

    /// -1: none
    int straight_over(const FloorVertex& at) const
    {
        constexpr double straight = 0.87, half = 0.5; // 30 degrees
        int best = -1;
        double most = straight;
        for (const int f : around_[size_t(at.v)])
            for (int k = 0; k < 3 && is_wall(f); ++k) {
                const int w = corner(k, f);
                const Eigen::Vector3d way = solid_.position.col(w) - solid_.position.col(at.v);
                const double up = way.dot(at.normal) * (at.height < 0 ? -1 : 1);
                if (!level_[size_t(w)] || up <= most * way.norm() ||
                    std::abs(up - std::abs(at.height)) >
                        half * std::abs(at.height) + 2 * chords_off_bends * sheet_.thickness)
                    continue;
                most = up / way.norm();
                best = w;
            }
        return best;
    }

    /// Of each floor how far it is below its skin, as its walls say; else as the other skin does.
    std::map<int, double> steps(const std::vector<FloorVertex>& floor) const
    {
        std::map<int, std::vector<double>> by_walls, by_skin;
        for (const FloorVertex& at : floor) {
            by_skin[at.floor].push_back(at.height);
            if (at.over >= 0)
                by_walls[at.floor].push_back((solid_.position.col(at.over) - solid_.position.col(at.v)).dot(at.normal));
        }
        std::map<int, double> result;
        for (auto& [f, heights] : by_skin) {
            std::vector<double>& values = by_walls.contains(f) ? by_walls.at(f) : heights;
            std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
            result[f] = values[values.size() / 2];
        }
        return result;
    }

    void put_back(const FloorVertex& at, double step)
    {
        if (at.over >= 0) {
            target_[size_t(at.v)] = at.over;
            return;
        }
        // A floor need not be parallel to its skin.
        const bool parallel = std::abs(at.height - step) <= 4 * chords_off_bends * sheet_.thickness;
        const Eigen::Vector3d back = solid_.position.col(at.v) + (parallel ? step : at.height) * at.normal;
        position_.col(at.v) = back;
        // Beside a wall with other corners along its foot than along its top the nearest of those
        // at the top will do.
        double shortest = std::numeric_limits<double>::infinity(), nearest = shortest;
        int over = -1;
        for (const int f : around_[size_t(at.v)])
            for (int k = 0; k < 3 && is_wall(f); ++k) {
                const int w = corner(k, f);
                const double way = (solid_.position.col(w) - back).norm();
                if (level_[size_t(w)] && way < nearest) {
                    nearest = way;
                    over = w;
                } else if (!level_[size_t(w)] && w != at.v)
                    shortest = std::min(shortest, (solid_.position.col(w) - solid_.position.col(at.v)).norm());
            }
        if (over >= 0 && nearest <= shortest / 2)
            target_[size_t(at.v)] = over;
    }

    /// A triangle of the skin that lies on the surface that one of a floor is put back into;
    /// itself: none is known to. Whoever asks what it lies on, or on which face, is to be told
    /// that.
    int on_skin(int f) const
    {
        if (!is_floor(f) || surface_.empty() || surface_[size_t(f)].kind == StatedSurface::Kind::other)
            return f;
        constexpr double close = 1e-3, parallel = 1 - 1e-9; // of the thickness; cosine, 0.003 degrees
        for (int g = 0; g < solid_.triangles(); ++g) {
            const StatedSurface& skin = surface_[size_t(g)];
            if (mark_[size_t(g)] >= 0 || sheet_.side[size_t(g)] != sheet_.side[size_t(f)] ||
                skin.kind != surface_[size_t(f)].kind ||
                std::abs(skin.direction.dot(surface_[size_t(f)].direction)) < parallel)
                continue;
            const auto off = [&](int v) {
                const Eigen::Vector3d p = position_.col(target_[size_t(v)]);
                return skin.kind == StatedSurface::Kind::plane ? (p - skin.point).dot(skin.direction)
                                                               : off_axis(skin, p).norm() - skin.radius;
            };
            if (std::ranges::all_of(solid_.triangle.col(f),
                                    [&](int v) { return std::abs(off(v)) <= close * sheet_.thickness; }))
                return g;
        }
        return f;
    }

    PlainSolid closed_again() const
    {
        std::vector<Triangle> triangles;
        std::vector<int> source;
        for (int f = 0; f < solid_.triangles(); ++f) {
            const auto [first, last] = fill_.equal_range(f);
            for (auto fill = first; fill != last; ++fill) {
                triangles.push_back(fill->second);
                source.push_back(f);
            }
            if (refilled_[size_t(f)])
                continue;
            const Triangle t = {target_[size_t(corner(0, f))], target_[size_t(corner(1, f))],
                                target_[size_t(corner(2, f))]};
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
                triangles.push_back(t);
                source.push_back(f);
            }
        }
        std::vector<Eigen::Vector3d> position;
        position.reserve(size_t(solid_.vertices()) + added_.size());
        for (int v = 0; v < solid_.vertices(); ++v)
            position.push_back(position_.col(v));
        position.insert(position.end(), added_.begin(), added_.end());
        require_surface(triangles, source);
        const FlatRepair repair = repair_flat_triangles(triangles, position);
        PlainSolid result;
        std::vector<int> number(position.size(), -1), kept;
        for (size_t f = 0; f < triangles.size(); ++f)
            if (!repair.removed[f]) {
                kept.push_back(int(f));
                for (const int v : triangles[f])
                    number[size_t(v)] = 0;
            }
        // New vertices come after those that they are called by.
        const auto called = [&](int v) { return v < solid_.vertices() ? v : added_at_[size_t(v - solid_.vertices())]; };
        std::vector<int> order(number.size());
        std::iota(order.begin(), order.end(), 0);
        std::erase_if(order, [&](int v) { return number[size_t(v)] < 0; });
        std::stable_sort(order.begin(), order.end(), [&](int u, int v) { return called(u) < called(v); });
        result.mesh.position.resize(3, Eigen::Index(order.size()));
        for (size_t i = 0; i < order.size(); ++i) {
            number[size_t(order[i])] = int(i);
            result.source_vertex.push_back(called(order[i]));
            result.mesh.position.col(Eigen::Index(i)) = position[size_t(order[i])];
        }
        result.mesh.triangle.resize(3, Eigen::Index(kept.size()));
        for (size_t f = 0; f < kept.size(); ++f)
            for (int k = 0; k < 3; ++k)
                result.mesh.triangle(k, Eigen::Index(f)) = number[size_t(triangles[size_t(kept[f])][size_t(k)])];
        result.source_face.reserve(kept.size());
        for (const int f : kept)
            result.source_face.push_back(source[size_t(f)]);
        require_unfolded(result);
        for (int& f : result.source_face)
            f = on_skin(f);
        return result;
    }

    [[noreturn]] void refuse(int face) const
    {
        const SheetMark& mark = sheet_.marks[size_t(std::max(0, mark_[size_t(face)]))];
        throw NotASheet(fmt::format("a mark {:.4g} mm {} on its surface cannot be put back into it (at {:.6g}, {:.6g}, "
                                    "{:.6g}); take it out in the CAD system",
                                    mark.depth, mark.raised ? "high" : "deep", mark.place.x(), mark.place.y(),
                                    mark.place.z()),
                        mark.face, mark.place);
    }

    /// What was closed stays so, with two triangles at every edge.
    void require_surface(const std::vector<Triangle>& triangles, const std::vector<int>& source) const
    {
        const std::vector<EdgeUse> uses = edge_uses(triangles);
        for_each_edge(uses, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                if (const int f = source[size_t(uses[i].face)];
                    mark_[size_t(f)] >= 0 && (end != begin + 2 || uses[begin].forward == uses[begin + 1].forward))
                    refuse(f);
        });
    }

    void require_unfolded(const PlainSolid& plain) const
    {
        const Eigen::Matrix3Xd area = sheet_.flipped * area_vectors(plain.mesh);
        std::vector<double> turned(sheet_.marks.size(), 0);
        for (int f = 0; f < plain.mesh.triangles(); ++f) {
            const int from = plain.source_face[size_t(f)];
            if (is_floor(from) && area.col(f).dot(normal_.col(from)) < 0)
                turned[size_t(mark_[size_t(from)])] += area.col(f).norm();
        }
        constexpr double speck = 1e-3;
        for (size_t m = 0; m < turned.size(); ++m)
            if (turned[m] > speck * sheet_.marks[m].area)
                refuse(sheet_.marks[m].face);
    }
};

} // namespace

PlainSolid without_marks(const TriMesh& solid, const ThinSolid& sheet) { return without_marks(solid, sheet, {}); }

PlainSolid without_marks(const TriMesh& solid, const ThinSolid& sheet, const std::vector<StatedSurface>& surface)
{
    return Flattening(solid, sheet, surface).plain();
}

} // namespace spia
