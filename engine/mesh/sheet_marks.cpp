#include "engine/mesh/sheet_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <map>
#include <optional>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/flat_triangles.h"
#include "engine/mesh/thin_solid.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double chords = 0.005; // of the thickness: what triangles of bends are off their surface, about

PieceSide other_of(PieceSide side) { return side == PieceSide::one ? PieceSide::other : PieceSide::one; }

/// Of each side the pieces that hang together with its largest ones.
std::vector<char> main_parts(const SurfacePieces& pieces, const std::vector<PieceSide>& side)
{
    DisjointSets together(size_t(pieces.count()));
    for (const PieceContact& c : pieces.contact)
        if (side[size_t(c.a)] == side[size_t(c.b)])
            together.join(c.a, c.b);
    std::vector<double> size(size_t(pieces.count()), 0);
    for (int p = 0; p < pieces.count(); ++p)
        size[size_t(together.root(p))] += pieces.area[size_t(p)];
    std::vector<char> main(size_t(pieces.count()), 0);
    for (const PieceSide s : {PieceSide::one, PieceSide::other}) {
        int largest = -1;
        for (int p = 0; p < pieces.count(); ++p)
            if (side[size_t(p)] == s && (largest < 0 || size[size_t(together.root(p))] > size[size_t(largest)]))
                largest = together.root(p);
        for (int p = 0; p < pieces.count(); ++p)
            main[size_t(p)] |= largest >= 0 && side[size_t(p)] == s && together.root(p) == largest;
    }
    return main;
}

/// The triangles for which `counts`.
template <class Counts> TriMesh part_of(const TriMesh& mesh, const Counts& counts)
{
    std::vector<int> faces;
    for (int f = 0; f < mesh.triangles(); ++f)
        if (counts(f))
            faces.push_back(f);
    return {mesh.position, mesh.triangle(Eigen::all, faces)};
}

/// How far off the other skin: asked for few of the vertices, and for some twice.
class Heights {
public:
    template <class Counts>
    Heights(const TriMesh& mesh, const Counts& other_skin, double within)
        : position_(mesh.position), search_(part_of(mesh, other_skin)), within_(within),
          known_(size_t(mesh.vertices()), -1)
    {
    }
    ClosestPoint nearest(int v) const { return search_.nearest(position_.col(v), within_); }
    double operator()(int v)
    {
        if (known_[size_t(v)] < 0)
            known_[size_t(v)] = std::min(nearest(v).distance, within_);
        return known_[size_t(v)];
    }

private:
    const Eigen::Matrix3Xd& position_;
    ClosestPointSearch search_;
    double within_; ///< mm
    std::vector<double> known_;
};

bool has_triangles(const SurfacePieces& pieces, const std::vector<char>& main, const std::vector<PieceSide>& side,
                   PieceSide of)
{
    for (int p = 0; p < pieces.count(); ++p)
        if (main[size_t(p)] && side[size_t(p)] == of)
            return true;
    return false;
}

/// Pieces that may be of a mark: off the main parts of both skins, and not from one to the other.
std::vector<char> candidates(const SurfacePieces& pieces, const std::vector<PieceSide>& side,
                             const std::vector<char>& main)
{
    std::vector<char> touches(size_t(pieces.count()), 0), result;
    for (const PieceContact& c : pieces.contact)
        for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            if (main[size_t(q)])
                touches[size_t(p)] |= side[size_t(q)] == PieceSide::one ? 1 : 2;
    for (int p = 0; p < pieces.count(); ++p)
        result.push_back(!main[size_t(p)] && touches[size_t(p)] != 3);
    return result;
}

/// The most at the feet of its walls. Where a wall goes up to the skin from there it is the way up, which chords of bends do not change.
/// @param on_skin  per vertex
double depth_of_mark(const TriMesh& mesh, const SheetMark& mark, const std::vector<char>& on_skin, Heights& height,
                     double thickness)
{
    std::map<int, double> up;
    double most = 0;
    for (const std::vector<int>* faces : {&mark.wall, &mark.floor}) {
        if (most > 0)
            break; // the floor alone says less
        for (const int f : *faces)
            for (int k = 0; k < 3; ++k) {
                const int v = mesh.triangle(k, f);
                if (on_skin[size_t(v)])
                    continue;
                double& way = up.try_emplace(v, std::numeric_limits<double>::infinity()).first->second;
                for (const int w : mesh.triangle.col(f))
                    if (on_skin[size_t(w)])
                        way = std::min(way, (mesh.position.col(v) - mesh.position.col(w)).norm());
            }
        for (const auto& [v, way] : up) {
            const double off = std::abs(height(v) - thickness);
            const bool straight = std::abs(way - off) < 0.25 * off + 4 * chords * thickness;
            most = std::max(most, straight ? way : off);
        }
    }
    return most;
}

void find_marks_on(PieceSide skin, const TriMesh& mesh, const Eigen::Matrix3Xd& normal, const SurfacePieces& pieces,
                   const std::vector<char>& main, std::vector<PieceSide>& side, double thickness,
                   std::vector<SheetMark>& marks)
{
    std::vector<char> level = candidates(pieces, side, main);
    if (std::none_of(level.begin(), level.end(), [](char c) { return c != 0; }) ||
        !has_triangles(pieces, main, side, other_of(skin)))
        return;
    const auto piece = [&](int f) { return size_t(pieces.piece[size_t(f)]); };
    Heights height(
        mesh, [&](int f) { return main[piece(f)] && side[piece(f)] == other_of(skin); }, 2 * thickness);
    std::vector<double> off(size_t(pieces.count()), 0), raised(size_t(pieces.count()), 0);
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3 && level[piece(f)]; ++k) {
            const double above = height(mesh.triangle(k, f)) - thickness;
            off[piece(f)] = std::max(off[piece(f)], std::abs(above));
            raised[piece(f)] += above * normal.col(f).norm();
            level[piece(f)] = off[piece(f)] <= (deepest_mark + chords) * thickness;
        }

    DisjointSets together(size_t(pieces.count()));
    for (const PieceContact& c : pieces.contact)
        if (level[size_t(c.a)] && level[size_t(c.b)])
            together.join(c.a, c.b);
    struct Group {
        double along_skin = 0, along_rim = 0, smoothly = 0; ///< mm; the last one of the first
        bool floor = false, off = false; ///< off: some vertex is not one of the skin, and can be moved to it
    };
    std::map<int, Group> groups;
    for (int p = 0; p < pieces.count(); ++p)
        if (level[size_t(p)])
            groups[together.root(p)].floor |= side[size_t(p)] == skin;
    std::vector<char> on_skin(size_t(mesh.vertices()), 0);
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3 && main[piece(f)] && side[piece(f)] == skin; ++k)
            on_skin[size_t(mesh.triangle(k, f))] = 1;
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3 && level[piece(f)]; ++k)
            groups[together.root(pieces.piece[size_t(f)])].off |= !on_skin[size_t(mesh.triangle(k, f))];
    for (const PieceContact& c : pieces.contact)
        for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            if (level[size_t(p)] && !level[size_t(q)]) {
                Group& group = groups[together.root(p)];
                const bool reaches = main[size_t(q)] && side[size_t(q)] == skin;
                (reaches ? group.along_skin : group.along_rim) += c.length();
                group.smoothly += reaches ? c.smooth : 0;
            }
    constexpr double most_rim =
        0.25; // of a groove with two ends at the rim; a chamfer has about half of its outline there
    std::map<int, int> number;
    for (const auto& [root, group] : groups)
        if (const bool edge = group.smoothly < group.along_skin / 2; // else it is a bend
            edge && group.off && (group.floor || group.along_rim < most_rim * group.along_skin)) {
            number[root] = int(marks.size());
            marks.emplace_back();
        }
    for (int f = 0; f < mesh.triangles(); ++f) {
        const auto found = level[piece(f)] ? number.find(together.root(pieces.piece[size_t(f)])) : number.end();
        if (found == number.end())
            continue;
        SheetMark& mark = marks[size_t(found->second)];
        (side[piece(f)] == skin ? mark.floor : mark.wall).push_back(f);
        const double size = normal.col(f).norm();
        mark.area += size;
        mark.place += size * mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean();
        if (mark.face < 0 || size > normal.col(mark.face).norm())
            mark.face = f;
    }
    for (const auto& [root, i] : number) {
        SheetMark& mark = marks[size_t(i)];
        mark.depth = depth_of_mark(mesh, mark, on_skin, height, thickness);
        double above = 0;
        for (int p = 0; p < pieces.count(); ++p)
            if (level[size_t(p)] && together.root(p) == root) {
                above += raised[size_t(p)];
                side[size_t(p)] = skin;
            }
        mark.raised = above > 0;
        mark.place /= mark.area > 0 ? mark.area : 1;
    }
}

/// Takes the marks out of a solid.
class Flattening {
public:
    Flattening(const TriMesh& solid, const ThinSolid& sheet)
        : solid_(solid), sheet_(sheet), normal_(sheet.flipped * area_vectors(solid)),
          mark_(size_t(solid.triangles()), -1), wall_(size_t(solid.triangles()), 0), floors_(size_t(solid.triangles())),
          around_(size_t(solid.vertices())), level_(size_t(solid.vertices()), 0), position_(solid.position)
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
        for (const SheetSide skin : {SheetSide::outer, SheetSide::inner})
            flatten(skin);
        return closed_again();
    }

private:
    const TriMesh& solid_;
    const ThinSolid& sheet_;
    Eigen::Matrix3Xd normal_; ///< area vectors, outwards
    std::vector<int> mark_;   ///< per triangle, -1: none
    std::vector<char> wall_;  ///< per triangle
    DisjointSets floors_;     ///< triangles of floors that hang together
    std::vector<std::vector<int>> around_;
    std::vector<char> level_; ///< per vertex: on the skin already
    std::vector<int> target_; ///< per vertex the one that it becomes
    Eigen::Matrix3Xd position_;

    bool is_floor(int f) const { return mark_[size_t(f)] >= 0 && !wall_[size_t(f)]; }
    bool is_wall(int f) const { return mark_[size_t(f)] >= 0 && wall_[size_t(f)]; }
    int corner(int k, int f) const { return solid_.triangle(k, f); }

    /// What is to be known of a vertex of a floor.
    struct FloorVertex {
        int v, floor; ///< floor: root of floors_
        Eigen::Vector3d normal;
        double height; ///< mm, to the level of the skin, by the distance of the other one
        int over = -1; ///< the vertex of the skin straight over it
    };

    void flatten(SheetSide skin)
    {
        std::vector<int> faces;
        for (int f = 0; f < solid_.triangles(); ++f)
            if (mark_[size_t(f)] >= 0 && sheet_.side[size_t(f)] == skin)
                faces.push_back(f);
        if (faces.empty())
            return;
        Heights height(
            solid_,
            [&](int f) {
                return sheet_.side[size_t(f)] != SheetSide::rim && sheet_.side[size_t(f)] != skin &&
                       mark_[size_t(f)] < 0;
            },
            2 * sheet_.thickness);
        for (const int f : faces)
            for (int k = 0; k < 3; ++k)
                for (const int g : around_[size_t(corner(k, f))]) {
                    level_[size_t(corner(k, f))] |= mark_[size_t(g)] < 0 && sheet_.side[size_t(g)] == skin;
                    const auto shared = (solid_.triangle.col(g).array() == corner((k + 1) % 3, f)).any();
                    if (is_floor(f) && is_floor(g) && shared)
                        floors_.join(f, g);
                }
        std::vector<FloorVertex> floor = floor_vertices(faces, height);
        const std::map<int, double> step = steps(floor);
        for (const FloorVertex& at : floor)
            if (!level_[size_t(at.v)])
                put_back(at, step.at(at.floor));
        for (const int f : faces)
            for (int k = 0; k < 3; ++k)
                if (const int v = corner(k, f);
                    is_wall(f) && !level_[size_t(v)] && !on_floor(v) && position_.col(v) == solid_.position.col(v)) {
                    const ClosestPoint near = height.nearest(v);
                    if (near.face >= 0 && near.distance > 0)
                        position_.col(v) =
                            near.position + sheet_.thickness / near.distance * (solid_.position.col(v) - near.position);
                }
    }

    bool on_floor(int v) const
    {
        return std::any_of(around_[size_t(v)].begin(), around_[size_t(v)].end(), [&](int f) { return is_floor(f); });
    }

    std::vector<FloorVertex> floor_vertices(const std::vector<int>& faces, Heights& height)
    {
        std::map<int, FloorVertex> found;
        std::map<int, std::vector<double>> heights; // of floors
        for (const int f : faces)
            for (int k = 0; k < 3 && is_floor(f); ++k) {
                const int v = corner(k, f);
                FloorVertex& at = found
                                      .try_emplace(v, FloorVertex{v, floors_.root(f), Eigen::Vector3d::Zero(),
                                                                  sheet_.thickness - height(v)})
                                      .first->second;
                at.normal += normal_.col(f);
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
            at.normal.normalize();
            if (!level_[size_t(v)]) {
                at.over = straight_over(at);
                // Of a bend triangles are chords; a vertex opposite to another one looks straight at it.
                constexpr double exact = 1e-4, alike = 0.94;
                const ClosestPoint near = height.nearest(v);
                const Eigen::Vector3d away = (solid_.position.col(v) - near.position).normalized();
                if (near.face >= 0 && near.barycentric.maxCoeff() > 1 - exact && away.dot(at.normal) > alike)
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
                    std::abs(up - std::abs(at.height)) > half * std::abs(at.height) + 2 * chords * sheet_.thickness)
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
        const bool parallel = std::abs(at.height - step) <= 4 * chords * sheet_.thickness;
        const Eigen::Vector3d back = solid_.position.col(at.v) + (parallel ? step : at.height) * at.normal;
        position_.col(at.v) = back;
        // Beside a wall with other corners along its foot than along its top the nearest of those at the top will do.
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

    PlainSolid closed_again() const
    {
        std::vector<Triangle> triangles;
        std::vector<int> source;
        for (int f = 0; f < solid_.triangles(); ++f) {
            const Triangle t = {target_[size_t(corner(0, f))], target_[size_t(corner(1, f))],
                                target_[size_t(corner(2, f))]};
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
                triangles.push_back(t);
                source.push_back(f);
            }
        }
        std::vector<Eigen::Vector3d> position;
        for (int v = 0; v < solid_.vertices(); ++v)
            position.push_back(position_.col(v));
        require_surface(triangles, source);
        const FlatRepair repair = repair_flat_triangles(triangles, position);
        PlainSolid result;
        std::vector<int> number(position.size(), -1), kept;
        for (size_t f = 0; f < triangles.size(); ++f)
            if (!repair.removed[f]) {
                kept.push_back(int(f));
                result.source_face.push_back(source[f]);
                for (const int v : triangles[f])
                    number[size_t(v)] = 0;
            }
        for (size_t v = 0; v < number.size(); ++v)
            if (number[v] == 0) {
                number[v] = int(result.source_vertex.size());
                result.source_vertex.push_back(int(v));
            }
        result.mesh.position = position_(Eigen::all, result.source_vertex);
        result.mesh.triangle.resize(3, Eigen::Index(kept.size()));
        for (size_t f = 0; f < kept.size(); ++f)
            for (int k = 0; k < 3; ++k)
                result.mesh.triangle(k, Eigen::Index(f)) = number[size_t(triangles[size_t(kept[f])][size_t(k)])];
        require_unfolded(result);
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

std::vector<SheetMark> find_marks(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, const SurfacePieces& pieces,
                                  std::vector<PieceSide>& side, double thickness)
{
    std::vector<SheetMark> marks;
    const std::vector<char> main = main_parts(pieces, side);
    for (const PieceSide skin : {PieceSide::one, PieceSide::other})
        find_marks_on(skin, mesh, normal, pieces, main, side, thickness, marks);
    return marks;
}

double depth_of(const TriMesh& mesh, const SurfacePieces& pieces, const std::vector<PieceSide>& side,
                const std::vector<char>& chosen, PieceSide skin, double thickness)
{
    const std::vector<char> main = main_parts(pieces, side);
    if (!has_triangles(pieces, main, side, other_of(skin)))
        return 0;
    const auto piece = [&](int f) { return size_t(pieces.piece[size_t(f)]); };
    Heights height(
        mesh, [&](int f) { return main[piece(f)] && side[piece(f)] == other_of(skin); }, 10 * thickness);
    double most = 0;
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3 && chosen[piece(f)]; ++k)
            most = std::max(most, std::abs(height(mesh.triangle(k, f)) - thickness));
    return most;
}

PlainSolid without_marks(const TriMesh& solid, const ThinSolid& sheet) { return Flattening(solid, sheet).plain(); }

} // namespace spia
