#include "engine/mesh/solid/skin.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <optional>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/core/place_text.h"
#include "engine/core/small_dense.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/border/askew_wall.h"
#include "engine/mesh/solid/flip_folds.h"
#include "engine/mesh/solid/holes/oblique_holes.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// The triangles of one side, seen from the outer side of the sheet.
SkinMesh side_of(const TriMesh& solid, const ThinSolid& sheet, SheetSide side)
{
    SkinMesh result;
    result.side = side;
    std::vector<int> number(size_t(solid.vertices()), -1);
    for (int f = 0; f < solid.triangles(); ++f)
        if (sheet.side[size_t(f)] == side) {
            result.source_face.push_back(f);
            for (int k = 0; k < 3; ++k)
                number[size_t(solid.triangle(k, f))] = 0;
        }
    for (int v = 0; v < solid.vertices(); ++v)
        if (number[size_t(v)] == 0) {
            number[size_t(v)] = int(result.source_vertex.size());
            result.source_vertex.push_back(v);
        }
    result.mesh.position = solid.position(Eigen::all, result.source_vertex);
    result.mesh.triangle.resize(3, Eigen::Index(result.source_face.size()));
    const bool turned = (side == SheetSide::inner) != (sheet.flipped < 0);
    for (size_t f = 0; f < result.source_face.size(); ++f)
        for (int k = 0; k < 3; ++k)
            result.mesh.triangle(turned ? 2 - k : k, Eigen::Index(f)) =
                number[size_t(solid.triangle(k, result.source_face[f]))];
    return result;
}

/// Faces around each vertex of a mesh.
std::vector<std::vector<int>> faces_around(const TriMesh& mesh)
{
    std::vector<std::vector<int>> around(size_t(mesh.vertices()));
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            around[size_t(mesh.triangle(k, f))].push_back(f);
    return around;
}

/// Planes that a vertex is to lie on once it is moved.
class Planes {
public:
    /// One that is nearly there is not wanted twice: the larger face counts, and comes first.
    void add(const Eigen::Vector3d& normal, double move)
    {
        constexpr double alike = 0.985; // 10 degrees
        for (size_t i = 0; i < normal_.size(); ++i)
            if (move_[i] == move && normal_[i].dot(normal) > alike)
                return;
        normal_.push_back(normal);
        move_.push_back(move);
    }
    /// The shortest move that obeys them, as well as that can be. @param first the first of them
    /// exactly, the others within it: a wall that is nearly parallel to the sheet would else take a
    /// vertex out of it
    Eigen::Vector3d move(bool first) const
    {
        const Eigen::Vector3d n = first ? normal_[0] : Eigen::Vector3d::Zero();
        Eigen::Vector3d start = n * move_[0];
        const auto rows = Eigen::Index(normal_.size()) - (first ? 1 : 0);
        if (rows == 0)
            return start;
        Eigen::MatrixX3d a(rows, 3);
        Eigen::VectorXd b(rows);
        for (Eigen::Index i = 0; i < rows; ++i) {
            const Eigen::Vector3d& own = normal_[size_t(i) + (first ? 1 : 0)];
            a.row(i) = (own - own.dot(n) * n).transpose();
            b[i] = move_[size_t(i) + (first ? 1 : 0)] - own.dot(start);
        }
        constexpr double nearly_parallel = 0.2;
        return start + shortest_least_squares(a, b, nearly_parallel);
    }

private:
    std::vector<Eigen::Vector3d> normal_;
    std::vector<double> move_;
};

struct MiddleSurface {
    const TriMesh& solid;
    const ThinSolid& sheet;
    const ThinSolidOptions& options;
    Eigen::Matrix3Xd normal;              ///< of the solid's faces, outwards, unit length
    Eigen::VectorXd size;                 ///< of them, mm2
    std::vector<std::vector<int>> around; ///< faces of the solid at each of its vertices
    Eigen::Matrix3Xi neighbour;           ///< of the solid, as face_neighbours() says
    TriMesh inner;                        ///< the inner skin
    ClosestPointSearch nearest_inner;
    std::vector<ObliqueHole> oblique;              ///< whose rims go along their walls
    TriMesh rim;                                   ///< the faces across the thickness
    std::optional<ClosestPointSearch> nearest_rim; ///< none: there are none

    /// Of the thickness, how far a way has to end beside the rim to be none along it: more than
    /// chords are.
    static constexpr double beside = 0.1;

    /// Where a vertex of the outer skin goes. @param to_rim at the rim along its faces; else as if
    /// there were none
    Eigen::Vector3d move(int v, bool to_rim = true) const
    {
        if (const ObliqueHole* hole = to_rim ? oblique_at(v) : nullptr)
            return hole->way;
        std::vector<int> skin, others;
        for (const int f : around[size_t(v)])
            (sheet.side[size_t(f)] == SheetSide::outer ? skin : others).push_back(f);
        const auto larger = [&](int a, int b) { return size[a] != size[b] ? size[a] > size[b] : a < b; };
        std::sort(skin.begin(), skin.end(), larger);
        std::sort(others.begin(), others.end(), larger);
        // Of the surfaces at the vertex itself where they are known: triangles of a bend are its
        // chords.
        const auto normal_of = [&](int f) {
            const Eigen::Vector3d own = normal.col(f);
            if (!options.surface.empty() && options.surface[size_t(f)].kind != StatedSurface::Kind::other)
                return normal_at(options.surface[size_t(f)], solid.position.col(v), own);
            return options.normal_at ? options.normal_at(f, solid.position.col(v), own) : own;
        };
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (const int f : skin)
            mean += size[f] * normal_of(f);
        mean.normalize();
        const auto farthest_from = [&](const Eigen::Vector3d& direction) {
            return *std::min_element(skin.begin(), skin.end(), [&](int a, int b) {
                return normal_of(a).dot(direction) < normal_of(b).dot(direction);
            });
        };
        const Eigen::Vector3d first = normal_of(farthest_from(mean));
        // Above 50 degrees it is an edge, above 40 degrees an edge or a coarse bend, where the
        // inner skin may tell.
        constexpr double edge = 0.643, smooth = 0.766;
        const Eigen::Vector3d second = normal_of(farthest_from(first));
        const double turn = first.dot(second);
        const std::optional<Opposite> told = turn < edge ? std::nullopt : from_inner(v, mean, first, second);
        const bool sharp = turn < smooth && !told;

        const double half = sheet.thickness / 2;
        Planes planes;
        if (sharp)
            for (const int f : skin)
                planes.add(normal_of(f), -half);
        else
            planes.add(told ? told->outwards : mean, told ? -told->distance / 2 : -half);
        constexpr double slanted = 0.8; // a face that goes on from the skin more than down from it
                                        // gives no direction, unless it ends at the other one
        bool at_rim = false, rounded = false, steep = false;
        for (const int f : others) {
            if (!to_rim || sheet.side[size_t(f)] != SheetSide::rim)
                continue;
            const bool crosses =
                std::abs(normal.col(f).dot(mean)) >= slanted &&
                askew_wall(solid, neighbour, f, {solid.position.col(v) - half * mean, mean, half}).crosses_plane();
            if (crosses || std::abs(normal.col(f).dot(mean)) < slanted) {
                planes.add(normal_of(f), 0);
                at_rim = true;
            } else
                rounded = true;
            steep |= crosses;
        }
        const Eigen::Vector3d moved = planes.move(!sharp);
        if (at_rim && !sharp)
            if (const auto along = along_border(v, moved, mean, others))
                return *along;
        if (rounded && !sharp)
            if (const auto place = beyond_chamfer(v, mean, others))
                return *place;
        if (at_rim && nearest_rim->nearest(solid.position.col(v) + moved, beside * sheet.thickness).face < 0)
            if (const auto place = beyond_chamfer(v, mean, others))
                return *place;
        // Where the planes leave the surface, or are too alike to say where to, straight in.
        constexpr double far = 3, far_along_steep = 6; // a wall at 80 degrees leads 5.8 away
        return (at_rim || sharp) && moved.norm() > (steep ? far_along_steep : far) * half
                   ? Eigen::Vector3d(-half * mean)
                   : moved;
    }

    /// The one whose rim has a vertex of the outer skin; null: none.
    const ObliqueHole* oblique_at(int v) const
    {
        const auto hole = std::ranges::find_if(
            oblique, [&](const ObliqueHole& each) { return std::ranges::binary_search(each.rim, v); });
        return hole == oblique.end() ? nullptr : &*hole;
    }

    bool on_wall(const Eigen::Vector3d& place) const
    {
        constexpr double close = 1e-3; // of the thickness
        return nearest_rim && nearest_rim->nearest(place, close * sheet.thickness).face >= 0;
    }

    /// Where a slanted wall meets one that is square to the sheet, a sink or a chamfer a border,
    /// and
    /// ends before the middle of the sheet, or meets it there no longer, or at so flat an angle
    /// that
    /// no move obeys both. The border stays: along it to the wall beyond a chamfer, or straight
    /// down.
    /// @returns the way then; nothing if a move stays on both walls
    std::optional<Eigen::Vector3d> along_border(int v, const Eigen::Vector3d& moved, const Eigen::Vector3d& mean,
                                                const std::vector<int>& others) const
    {
        constexpr double square = 0.02, stays = 1e-3; // sine of 1 degree; of the thickness
        const double half = sheet.thickness / 2;
        std::vector<int> border;
        double reach = 0; // mm, of slanted walls halfway through the sheet
        Planes planes;
        planes.add(mean, -half);
        for (const int f : others) {
            const double lean = std::abs(normal.col(f).dot(mean));
            if (sheet.side[size_t(f)] == SheetSide::rim && lean <= square) {
                border.push_back(f);
                planes.add(normal.col(f), 0);
            } else if (sheet.side[size_t(f)] == SheetSide::rim && slanted(normal.col(f), mean))
                reach = std::max(reach, half * lean / std::sqrt(1 - lean * lean));
        }
        if (border.empty() || reach == 0)
            return std::nullopt;
        const auto on_border = [&](const Eigen::Vector3d& way) {
            return std::ranges::all_of(
                border, [&](int f) { return std::abs(normal.col(f).dot(way)) <= stays * sheet.thickness; });
        };
        if (on_border(moved) && distance_from_slanted(solid.position.col(v) + moved, mean) <= beside * sheet.thickness)
            return std::nullopt;
        if (auto place = beyond_chamfer(v, mean, others);
            place && on_border(*place) && (*place - place->dot(mean) * mean).norm() <= reach)
            return place;
        return planes.move(true);
    }

    static bool slanted(const Eigen::Vector3d& wall, const Eigen::Vector3d& mean)
    {
        constexpr double least = 0.17, most = 0.985; // sines of 10 and of 80 degrees
        const double lean = std::abs(wall.dot(mean));
        return lean > least && lean < most;
    }

    /// mm, from the walls that are slanted against a direction.
    double distance_from_slanted(const Eigen::Vector3d& place, const Eigen::Vector3d& mean) const
    {
        double least = std::numeric_limits<double>::infinity();
        for (int f = 0; f < solid.triangles(); ++f)
            if (sheet.side[size_t(f)] == SheetSide::rim && slanted(normal.col(f), mean)) {
                const Eigen::Matrix3d corners = solid.position(Eigen::all, solid.triangle.col(f));
                least = std::min(least, (corners * closest_on_triangle(corners, place) - place).norm());
            }
        return least;
    }

    /// A chamfer ends before the middle of the sheet; the edge of that is at the wall, or where the
    /// walls meet, between those of both skins.
    /// @param others  faces at the vertex that are not of the outer skin
    /// @returns the way there; nothing if no wall is square to the sheet
    std::optional<Eigen::Vector3d> beyond_chamfer(int v, const Eigen::Vector3d& mean,
                                                  const std::vector<int>& others) const
    {
        const Eigen::Vector3d here = solid.position.col(v);
        const double half = sheet.thickness / 2;
        Planes planes;
        planes.add(mean, -half);
        std::vector<Eigen::Vector3d> ways; // out of the sheet
        constexpr double level = 0.01;     // sine of 0.6 degrees; roundings begin with more
        for (const int f : others) {
            const Eigen::Vector3d own = normal.col(f), out = own - own.dot(mean) * mean;
            if (sheet.side[size_t(f)] == SheetSide::rim && out.norm() >= level)
                ways.push_back(out.normalized());
        }
        for (const Eigen::Vector3d& out : ways) {
            // At a corner of the border both walls would be as near: a little beside it one is.
            constexpr double another = 0.7, little = 0.05;
            Eigen::Vector3d inside = Eigen::Vector3d::Zero();
            for (const Eigen::Vector3d& other : ways)
                if (other.dot(out) < another)
                    inside = -little * half * (other - other.dot(out) * out).normalized();
            const Eigen::Vector3d outside = here - half * mean + half * out + inside;
            const ClosestPoint wall = nearest_rim->nearest(outside, sheet.thickness);
            if (wall.face < 0)
                return std::nullopt;
            const auto corner = [&](int k) { return Eigen::Vector3d(rim.position.col(rim.triangle(k, wall.face))); };
            const Eigen::Vector3d across = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
            constexpr double square = 0.05; // of the cosine; elsewhere the way along the faces is
                                            // right
            if (std::abs(across.dot(mean)) > square)
                return std::nullopt;
            planes.add(across, across.dot(wall.position - here));
        }
        return planes.move(true);
    }

    /// The place of the inner skin that is opposite to a vertex of the outer one.
    struct Opposite {
        Eigen::Vector3d outwards; ///< unit, from there to the vertex
        double distance;          ///< mm
    };

    /// Where the inner skin is the thickness away at its nearest place or a vertex there, that is
    /// where it is not. Flats that are folded without a radius are mitred: their corners are
    /// farther apart.
    /// @param first, second  normals of the faces at the vertex that turn most from each other
    std::optional<Opposite> from_inner(int v, const Eigen::Vector3d& mean, const Eigen::Vector3d& first,
                                       const Eigen::Vector3d& second) const
    {
        constexpr double equal = 1e-4, aside = 0.8, straight = 0.999,
                         farthest = 1.15; // beyond it turns by 50 degrees and more
        const Eigen::Vector3d here = solid.position.col(v);
        const ClosestPoint near = nearest_inner.nearest(here, farthest * sheet.thickness);
        if (near.face < 0)
            return std::nullopt;
        const auto at = [&](const Eigen::Vector3d& place) {
            const double distance = (here - place).norm();
            return Opposite{(here - place) / distance, distance};
        };
        std::vector<Opposite> opposite{at(near.position)};
        for (int k = 0; k < 3; ++k)
            opposite.push_back(at(inner.position.col(inner.triangle(k, near.face))));
        const Eigen::Vector3d between = (first + second).normalized();
        const double mitred = sheet.thickness / between.dot(first);
        for (size_t k = 1; k < opposite.size() && mitred > (1 + 2 * equal) * sheet.thickness; ++k)
            if (std::abs(opposite[k].distance - mitred) < equal * sheet.thickness &&
                opposite[k].outwards.dot(between) > straight)
                return opposite[k];
        std::optional<Opposite> best;
        double off = equal * sheet.thickness;
        for (const Opposite& place : opposite)
            if (const double from = std::abs(place.distance - sheet.thickness);
                from <= off && place.outwards.dot(mean) > aside) {
                off = from;
                best = {place.outwards, sheet.thickness};
            }
        return best;
    }
};

/// Where triangles still turn over, vertices of slanted edges go straight in, those of an oblique
/// hole together.
void straighten_folds(const TriMesh& before, const MiddleSurface& middle, SkinMesh& result)
{
    constexpr int rounds = 100; // each may bare a triangle beside it, as far as the rim of a hole
    if (turned_over(before, result, middle.options).empty())
        return;
    std::vector<char> straight(result.source_vertex.size(), 0);
    const auto straighten = [&](int i) {
        if (std::exchange(straight[size_t(i)], char(1)))
            return false;
        const int v = result.source_vertex[size_t(i)];
        const Eigen::Vector3d was = result.mesh.position.col(i);
        result.mesh.position.col(i) = before.position.col(i) + middle.move(v, false);
        const Eigen::Vector3d place = result.mesh.position.col(i);
        if (!middle.on_wall(place))
            result.straightened.push_back({v, place, was, middle.oblique_at(v) || middle.on_wall(was)});
        return true;
    };
    for (int round = 0; round < rounds; ++round) {
        bool any = false;
        for (const int f : turned_over(before, result, middle.options))
            for (const int i : before.triangle.col(f)) {
                any |= straighten(i);
                if (const ObliqueHole* hole = middle.oblique_at(result.source_vertex[size_t(i)]))
                    for (const int source : hole->rim)
                        any |= straighten(
                            int(std::ranges::lower_bound(result.source_vertex, source) - result.source_vertex.begin()));
            }
        if (!any)
            break;
    }
}

/// @throws NotASheet if triangles turned over that have more than a speck of the area
void require_unfolded(const TriMesh& before, const SkinMesh& middle, const ThinSolidOptions& options)
{
    const Eigen::Matrix3Xd was = area_vectors(before);
    double turned = 0;
    int worst = -1;
    for (const int f : turned_over(before, middle, options)) {
        turned += was.col(f).norm();
        if (worst < 0 || was.col(f).norm() > was.col(worst).norm())
            worst = f;
    }
    constexpr double speck = 1e-4;
    if (turned <= speck * was.colwise().norm().sum())
        return;
    const int face = middle.source_face[size_t(worst)];
    const Eigen::Vector3d place = before.position.col(before.triangle(0, worst));
    throw NotASheet(fmt::format("its middle surface folds over where the outer skin is bent more tightly than half the "
                                "thickness ({} at {} mm); take the outer or the inner skin",
                                options.face_name ? options.face_name(face) : fmt::format("face {}", face),
                                place_text(place)),
                    face, place);
}

} // namespace

const char* name(Skin skin) { return skin == Skin::outer ? "outer" : skin == Skin::inner ? "inner" : "middle"; }

Skin skin_by_name(const std::string& name)
{
    for (const Skin skin : {Skin::outer, Skin::inner, Skin::middle})
        if (name == spia::name(skin))
            return skin;
    throw InputError(fmt::format("'{}' is no skin of a sheet; there are outer, inner and middle", name));
}

SkinMesh skin_of(const TriMesh& solid, const ThinSolid& sheet, Skin skin, const ThinSolidOptions& options)
{
    if (skin == Skin::inner)
        return side_of(solid, sheet, SheetSide::inner);
    SkinMesh result = side_of(solid, sheet, SheetSide::outer);
    if (skin == Skin::outer)
        return result;
    const Eigen::Matrix3Xd vectors = sheet.flipped * area_vectors(solid);
    TriMesh inner = side_of(solid, sheet, SheetSide::inner).mesh;
    ClosestPointSearch nearest_inner(inner);
    TriMesh rim = side_of(solid, sheet, SheetSide::rim).mesh;
    std::optional<ClosestPointSearch> nearest_rim;
    if (rim.triangles() > 0)
        nearest_rim.emplace(rim);
    const MiddleSurface middle{solid,
                               sheet,
                               options,
                               vectors.colwise().normalized(),
                               vectors.colwise().norm().transpose(),
                               faces_around(solid),
                               face_neighbours(solid.triangles(), edge_uses(solid.triangle)),
                               std::move(inner),
                               std::move(nearest_inner),
                               oblique_holes(solid, sheet, options.surface),
                               std::move(rim),
                               std::move(nearest_rim)};
    TriMesh before = result.mesh;
    parallel_for(int(result.source_vertex.size()),
                 [&](int i) { result.mesh.position.col(i) += middle.move(result.source_vertex[size_t(i)]); });
    flip_folds(before, result, options);
    straighten_folds(before, middle, result);
    require_unfolded(before, result, options);
    for (const ObliqueHole& hole : middle.oblique)
        result.oblique.push_back(hole.way + solid.position(Eigen::all, hole.rim).rowwise().mean());
    return result;
}

} // namespace spia
