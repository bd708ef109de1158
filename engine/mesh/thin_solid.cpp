#include "engine/mesh/thin_solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <optional>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/counterbores.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/pick.h"
#include "engine/mesh/sheet_sides.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double thick =
    0.25; // of the side of a square with the area of one skin: what is open and thicker is no sheet
constexpr double block = 0.36; // of that with half of the area: a square plate half as thick as it is wide

double signed_volume(const TriMesh& mesh)
{
    const Eigen::Vector3d apex = mesh.position.rowwise().mean();
    double volume = 0; // by the divergence theorem
    for (int f = 0; f < mesh.triangles(); ++f) {
        const auto t = mesh.triangle.col(f);
        volume += (mesh.position.col(t[0]) - apex)
                      .dot((mesh.position.col(t[1]) - apex).cross(mesh.position.col(t[2]) - apex)) /
                  6;
    }
    return volume;
}

/// All that is known of a solid on the way.
struct Solid {
    const TriMesh& mesh;
    const ThinSolidOptions& options;
    Eigen::Matrix3Xd normal = {}; ///< area vectors, outwards
    SurfacePieces pieces = {};
    std::vector<Opposite> places = {};
    SheetSides sides = {};
    bool closed = false;

    int piece(int face) const { return pieces.piece[size_t(face)]; }
    PieceSide side(int face) const { return sides.side[size_t(piece(face))]; }
    Eigen::Vector3d middle(int face) const
    {
        const auto t = mesh.triangle.col(face);
        return (mesh.position.col(t[0]) + mesh.position.col(t[1]) + mesh.position.col(t[2])) / 3;
    }
    /// "CAD face 7 at 1, 2, 3"
    std::string at(int face, const Eigen::Vector3d& place) const
    {
        return fmt::format("{} at {:.6g}, {:.6g}, {:.6g}",
                           options.face_name ? options.face_name(face) : fmt::format("face {}", face), place.x(),
                           place.y(), place.z());
    }
    [[noreturn]] void refuse(const std::string& what, int face, bool sheet_but_for_it = false) const
    {
        throw NotASheet(fmt::format("{} ({})", what, at(face, middle(face))), face, middle(face), sheet_but_for_it);
    }
    /// The largest triangle of the pieces for which `counts`.
    template <class Counts> int largest(const Counts& counts) const
    {
        int best = -1;
        for (int f = 0; f < mesh.triangles(); ++f)
            if (counts(piece(f)) && (best < 0 || normal.col(f).norm() > normal.col(best).norm()))
                best = f;
        return best;
    }
};

void require_thin(const Solid& solid, double thickness, double area)
{
    const double width = std::sqrt(area / 2);
    const auto all = [](int) { return true; };
    if (thickness <= 0)
        solid.refuse("it is no sheet: no two of its faces lie opposite to each other", solid.largest(all));
    if (thickness > block * width)
        solid.refuse(fmt::format("it is no thin sheet but a block: most of it is {:.4g} mm thick, at a surface like "
                                 "that of a plate {:.4g} mm wide",
                                 thickness, width),
                     solid.largest(all));
}

void require_two_sides(const Solid& solid, double thickness, double area)
{
    double skins = 0;
    for (int p = 0; p < solid.pieces.count(); ++p)
        skins += solid.sides.side[size_t(p)] == PieceSide::rim ? 0 : solid.pieces.area[size_t(p)];
    constexpr double least = 0.5;
    if (skins < least * area) {
        // The piece that is most of another thickness, if there is one.
        std::map<int, std::vector<std::pair<double, double>>> otherwise;
        for (const Opposite& at : solid.places)
            if (at.hit >= 0 && at.facing > 0.72 && !across(at, thickness))
                otherwise[solid.piece(at.face)].emplace_back(at.distance, at.area);
        int worst = -1;
        double most = 0;
        for (const auto& [p, values] : otherwise) {
            double sum = 0;
            for (const auto& [distance, part] : values)
                sum += part;
            if (sum > most) {
                most = sum;
                worst = p;
            }
        }
        const auto rim = [&](int p) { return solid.sides.side[size_t(p)] == PieceSide::rim; };
        solid.refuse(fmt::format("it has not one thickness: {:.4g} mm is the one found most, but only {:.0f} % of its "
                                 "surface can be taken into two skins so far apart{}",
                                 thickness, 100 * skins / area,
                                 worst < 0 ? "; the largest face elsewhere is named"
                                           : fmt::format("; elsewhere it is {:.4g} mm thick",
                                                         quantile(otherwise.at(worst), 0.5))),
                     solid.largest([&](int p) { return worst < 0 ? rim(p) : p == worst; }));
    }
    constexpr double most_contradicted = 0.05;
    if (solid.sides.contradicted > most_contradicted) {
        const Opposite& at = solid.places[size_t(solid.sides.where)];
        throw NotASheet(
            fmt::format("it has no two separate sides: its surface runs from one side of the {:.4g} mm thick wall to "
                        "the other without faces across the thickness, or walls branch off ({})",
                        thickness, solid.at(at.face, at.place)),
            at.face, at.place);
    }
}

/// Of pieces that stand off their side: "; they reach ... ", and what would be let pass.
template <class Counts> std::string how_deep(const Solid& solid, PieceSide side, double thickness, const Counts& counts)
{
    std::vector<char> chosen;
    for (int p = 0; p < solid.pieces.count(); ++p)
        chosen.push_back(counts(p));
    const double depth = depth_of(solid.mesh, solid.pieces, solid.sides.side, chosen, side, thickness);
    return depth > 0 ? fmt::format(", {:.4g} mm off the level of that side; marks of up to {:.4g} mm, {:.2g} of the "
                                   "thickness, would be passed over",
                                   depth, deepest_mark * thickness, deepest_mark)
                     : "";
}

/// Of a mesh slivers along an arc stand upright on their skin, where they have no area to speak of: what has no vertex of its own between
/// those of one skin is part of it.
void give_slivers_to_their_skin(Solid& solid)
{
    const SurfacePieces& pieces = solid.pieces;
    const auto rim = [&](int p) { return solid.sides.side[size_t(p)] == PieceSide::rim; };
    const auto bit = [](PieceSide side) { return side == PieceSide::rim ? 0 : side == PieceSide::one ? 1 : 2; };
    DisjointSets together(size_t(pieces.count()));
    std::vector<int> touches(size_t(pieces.count()), 0), at(size_t(solid.mesh.vertices()), 0);
    for (const PieceContact& c : pieces.contact)
        if (rim(c.a) && rim(c.b))
            together.join(c.a, c.b);
    for (const PieceContact& c : pieces.contact)
        for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            if (rim(p))
                touches[size_t(together.root(p))] |= bit(solid.sides.side[size_t(q)]);
    for (int f = 0; f < solid.mesh.triangles(); ++f)
        for (const int v : solid.mesh.triangle.col(f))
            at[size_t(v)] |= bit(solid.side(f));
    std::vector<char> own(size_t(pieces.count()), 0);
    for (int f = 0; f < solid.mesh.triangles(); ++f)
        for (const int v : solid.mesh.triangle.col(f))
            if (const auto group = size_t(together.root(solid.piece(f))); rim(solid.piece(f)))
                own[group] |= (at[size_t(v)] & touches[group]) == 0;
    std::vector<PieceSide> side = solid.sides.side;
    for (int p = 0; p < pieces.count(); ++p)
        if (const auto group = size_t(together.root(p));
            rim(p) && !own[group] && (touches[group] == 1 || touches[group] == 2))
            side[size_t(p)] = touches[group] == 1 ? PieceSide::one : PieceSide::other;
    solid.sides.side = std::move(side);
}

constexpr double speck = 0.005; // of the surface: what is smaller is no piece of a side

/// Counterbores are of the outline of their holes.
void give_counterbores_to_the_rim(Solid& solid, double thickness, double area)
{
    const std::vector<char> floor =
        counterbore_floors(solid.mesh, solid.normal, solid.pieces, solid.sides.side, thickness, speck * area);
    for (size_t p = 0; p < floor.size(); ++p)
        if (floor[p])
            solid.sides.side[p] = PieceSide::rim;
}

/// Each side in one piece, the faces across the thickness between both.
void require_connected(Solid& solid, double thickness, double area)
{
    const SurfacePieces& pieces = solid.pieces;
    constexpr double plate = 0.15; // of the width: beyond that a plain one may be a closed box (sheet_or_hollow())
    const bool surely = thickness < plate * std::sqrt(area / 2);
    DisjointSets together(size_t(pieces.count()));
    for (const PieceContact& c : pieces.contact)
        if (solid.sides.side[size_t(c.a)] == solid.sides.side[size_t(c.b)])
            together.join(c.a, c.b);
    std::vector<double> size(size_t(pieces.count()), 0);
    for (int p = 0; p < pieces.count(); ++p)
        size[size_t(together.root(p))] += pieces.area[size_t(p)];
    for (const PieceSide side : {PieceSide::one, PieceSide::other}) {
        int largest = -1, second = -1;
        for (int p = 0; p < pieces.count(); ++p)
            if (together.root(p) == p && solid.sides.side[size_t(p)] == side) {
                if (largest < 0 || size[size_t(p)] > size[size_t(largest)])
                    second = std::exchange(largest, p);
                else if (second < 0 || size[size_t(p)] > size[size_t(second)])
                    second = p;
            }
        if (largest < 0)
            solid.refuse("it has one side only: nothing lies opposite to it", solid.largest([](int) { return true; }));
        if (second >= 0 && size[size_t(second)] > speck * area)
            solid.refuse(
                fmt::format("one of its sides is in several pieces that only faces across the {:.4g} mm of "
                            "thickness join: it has more than two sides, or a step; the second piece has "
                            "{:.4g} mm2{}",
                            thickness, size[size_t(second)],
                            how_deep(solid, side, thickness, [&](int p) { return together.root(p) == second; })),
                solid.largest([&](int p) { return together.root(p) == second; }), surely);
        for (int p = 0; p < pieces.count(); ++p)
            if (solid.sides.side[size_t(p)] == side && together.root(p) != largest)
                solid.sides.side[size_t(p)] = PieceSide::rim;
    }
    if (solid.closed)
        give_slivers_to_their_skin(solid);
    // Of the faces across the thickness those that one side alone has are a step, a pocket or a boss: with its floor, which was taken from
    // its side above.
    together = DisjointSets(size_t(pieces.count()));
    for (const PieceContact& c : pieces.contact)
        if (solid.sides.side[size_t(c.a)] == solid.sides.side[size_t(c.b)])
            together.join(c.a, c.b);
    size.assign(size.size(), 0);
    for (int p = 0; p < pieces.count(); ++p)
        size[size_t(together.root(p))] += pieces.area[size_t(p)];
    std::vector<char> touches(size_t(pieces.count()), 0);
    for (const PieceContact& c : pieces.contact)
        for (const auto& [rim, skin] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            if (solid.sides.side[size_t(rim)] == PieceSide::rim && solid.sides.side[size_t(skin)] != PieceSide::rim)
                touches[size_t(together.root(rim))] |= solid.sides.side[size_t(skin)] == PieceSide::one ? 1 : 2;
    for (int p = 0; p < pieces.count(); ++p)
        if (solid.closed && together.root(p) == p && solid.sides.side[size_t(p)] == PieceSide::rim &&
            touches[size_t(p)] != 3 && size[size_t(p)] > 4 * thickness * thickness)
            solid.refuse(fmt::format("one of its sides has a step, a pocket or a boss: faces of {:.4g} mm2 across the "
                                     "{:.4g} mm thick sheet do not reach its other side{}",
                                     size[size_t(p)], thickness,
                                     how_deep(solid, touches[size_t(p)] == 1 ? PieceSide::one : PieceSide::other,
                                              thickness, [&](int q) { return together.root(q) == p; })),
                         solid.largest([&](int q) { return together.root(q) == p; }), surely);
}

/// With faces missing, most of the outline of the skins must still be where faces cross the thickness.
void require_rim(const Solid& solid)
{
    double rim = 0, open = 0;
    const std::vector<EdgeUse> uses = edge_uses(solid.mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const double length =
            (solid.mesh.position.col(uses[begin].high) - solid.mesh.position.col(uses[begin].low)).norm();
        const PieceSide a = solid.side(uses[begin].face);
        if (end == begin + 1)
            open += a == PieceSide::rim ? 0 : length;
        else if (end == begin + 2)
            rim += (a == PieceSide::rim) != (solid.side(uses[begin + 1].face) == PieceSide::rim) ? length : 0;
    });
    constexpr double least = 0.6;
    if (rim < least * (rim + open))
        solid.refuse("it is open, and faces across the thickness are missing along most of its outline",
                     solid.largest([&](int p) { return solid.sides.side[size_t(p)] != PieceSide::rim; }));
}

/// The triangles of one side alone.
TriMesh only(const Solid& solid, PieceSide side)
{
    TriMesh mesh;
    std::vector<int> faces;
    for (int f = 0; f < solid.mesh.triangles(); ++f)
        if (solid.side(f) == side)
            faces.push_back(f);
    mesh.position = solid.mesh.position;
    mesh.triangle = solid.mesh.triangle(Eigen::all, faces);
    return mesh;
}

/// The least that an eighth of the distances are, to single precision of a part a hundred times as large: vertices that do not lie quite opposite
/// are farther away. @param sorted  at least one
std::optional<double> agreed(const std::vector<double>& sorted)
{
    constexpr double equal = 1 + 1e-5;
    for (size_t i = 0, j = 0; i < sorted.size(); ++i) {
        while (j < sorted.size() && sorted[j] <= equal * sorted[i])
            ++j;
        if (8 * (j - i) >= sorted.size())
            return sorted[(i + j) / 2];
    }
    return std::nullopt;
}

/// Vertices at which a skin turns: they lie on its surface, while those within a chord of a bend lie below it.
std::vector<char> turning_vertices(const Solid& solid)
{
    constexpr double turn = 0.99985; // 1 degree
    std::vector<int> first(size_t(solid.mesh.vertices()), -1);
    std::vector<char> turns(size_t(solid.mesh.vertices()), 0);
    for (int f = 0; f < solid.mesh.triangles(); ++f)
        for (int k = 0; k < 3 && solid.side(f) != PieceSide::rim; ++k) {
            const auto v = size_t(solid.mesh.triangle(k, f));
            if (first[v] < 0)
                first[v] = f;
            const auto n = solid.normal.col(first[v]), m = solid.normal.col(f);
            turns[v] |= m.dot(n) < turn * m.norm() * n.norm();
        }
    return turns;
}

/// Vertices at which the border of a skin turns, as at both ends of a free edge; where a section is cut into chords it does not.
std::vector<char> border_corners(const Solid& solid)
{
    constexpr double turn = 0.5; // the sine of 30 degrees
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> way(size_t(solid.mesh.vertices()), none);
    std::vector<char> corner(way.size(), 0);
    const std::vector<EdgeUse> uses = edge_uses(solid.mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin != 2 || solid.side(uses[begin].face) == solid.side(uses[begin + 1].face))
            return;
        const int a = uses[begin].low, b = uses[begin].high;
        const Eigen::Vector3d along = (solid.mesh.position.col(b) - solid.mesh.position.col(a)).normalized();
        for (const int v : {a, b}) {
            corner[size_t(v)] |= way[size_t(v)].cross(along).norm() > turn;
            way[size_t(v)] = along;
        }
    });
    return corner;
}

/// The thickness between curved skins. Rays meet chords there, not the surfaces; vertices lie on them, so the thickness is
/// the distance of vertices that lie straight opposite to each other: of those where the skins turn, if there are enough. Of flats that
/// are folded without a radius those lie on the mitre, farther apart than the flats are: there rays are right, as the ends of free edges say.
/// @param by_rays mm, and what is returned where too few vertices lie so
/// @param marks  do not count
double between_vertices(const Solid& solid, double by_rays, const std::vector<SheetMark>& marks)
{
    std::vector<char> marked(size_t(solid.mesh.triangles()), 0);
    for (const SheetMark& mark : marks)
        for (const std::vector<int>* faces : {&mark.floor, &mark.wall})
            for (const int f : *faces)
                marked[size_t(f)] = 1;
    constexpr double exact = 1e-4, alike = 1e-3;
    constexpr double nearer = 0.02, farther = 0.1; // chords of 50 degrees are nearer to each other by that
    std::vector<double> distance, turning, ends;
    const std::vector<char> turns = turning_vertices(solid), corners = border_corners(solid);
    int asked = 0;
    for (const PieceSide side : {PieceSide::one, PieceSide::other}) {
        const ClosestPointSearch opposite(only(solid, side == PieceSide::one ? PieceSide::other : PieceSide::one));
        std::vector<char> seen(size_t(solid.mesh.vertices()), 0);
        for (int f = 0; f < solid.mesh.triangles(); ++f)
            for (int k = 0; k < 3 && solid.side(f) == side && !marked[size_t(f)]; ++k) {
                const int v = solid.mesh.triangle(k, f);
                if (std::exchange(seen[size_t(v)], char(1)))
                    continue;
                ++asked;
                const ClosestPoint near = opposite.nearest(solid.mesh.position.col(v), 2 * by_rays);
                if (near.face < 0 || near.barycentric.maxCoeff() <= 1 - exact ||
                    near.distance < (1 - nearer) * by_rays || near.distance > (1 + farther) * by_rays)
                    continue;
                distance.push_back(near.distance);
                if (turns[size_t(v)])
                    turning.push_back(near.distance);
                else if (corners[size_t(v)])
                    ends.push_back(near.distance);
            }
    }
    constexpr size_t enough = 8, one_edge = 4; // has so many ends on both skins
    std::sort(turning.begin(), turning.end());
    if (turning.size() >= enough)
        if (const std::optional<double> same = agreed(turning)) {
            const auto by_rays_too = [&](double d) { return std::abs(d - by_rays) < exact * by_rays; };
            const bool mitred = *same > (1 + alike) * by_rays && ends.size() >= one_edge &&
                                std::all_of(ends.begin(), ends.end(), by_rays_too);
            return mitred ? by_rays : *same;
        }
    if (distance.size() < std::max(enough, size_t(asked / 50)))
        return by_rays;
    std::sort(distance.begin(), distance.end());
    if (const std::optional<double> same = agreed(distance))
        return *same;
    std::erase_if(distance, [&](double d) { return d > (1 + nearer) * by_rays; });
    if (distance.size() < std::max(enough, size_t(asked / 50)))
        return by_rays;
    // Those that do not lie quite opposite are farther away.
    const double low = distance[distance.size() / 10], median = distance[distance.size() / 2];
    return median - low <= alike * low ? low : median;
}

/// A skin's place and how far away the other skin is.
struct Local {
    int face;
    double thickness, area;
};

std::vector<Local> local_thickness(const Solid& solid, double thickness, const Progress& progress)
{
    constexpr size_t enough = 60'000;
    const size_t stride = (solid.places.size() + enough - 1) / enough;
    std::vector<const Opposite*> chosen;
    for (size_t i = 0; i < solid.places.size(); i += stride)
        if (solid.side(solid.places[i].face) != PieceSide::rim)
            chosen.push_back(&solid.places[i]);
    const ClosestPointSearch one(only(solid, PieceSide::one)), other(only(solid, PieceSide::other));
    std::vector<Local> result(chosen.size());
    progress.checkpoint(0, "measuring the thickness");
    parallel_for(int(chosen.size()), [&](int i) {
        const Opposite& at = *chosen[size_t(i)];
        const double most = 10 * thickness;
        const ClosestPoint near = (solid.side(at.face) == PieceSide::one ? other : one).nearest(at.place, most);
        result[size_t(i)] = {at.face, std::min(near.distance, most), at.area};
    });
    return result;
}

/// Coined or thickened places.
void require_even(const Solid& solid, const std::vector<Local>& local, double thickness)
{
    constexpr double thin = 0.75, fat = 1.5; // a bend with the same radius on both sides is 1.41 times as thick
    constexpr double most_share = 0.02;
    std::map<int, std::vector<std::pair<double, double>>> of_piece;
    for (const Local& at : local)
        of_piece[solid.piece(at.face)].emplace_back(at.thickness, at.area);
    double whole = 0, off = 0, worst_area = 0, worst_thickness = 0;
    int worst = -1;
    for (const auto& [p, values] : of_piece) {
        const double median = quantile(values, 0.5), area = solid.pieces.area[size_t(p)];
        whole += area;
        if (median >= thin * thickness && median <= fat * thickness)
            continue;
        off += area;
        if (area > worst_area) {
            worst_area = area;
            worst_thickness = median;
            worst = p;
        }
    }
    if (off > most_share * whole)
        solid.refuse(fmt::format("its thickness varies too much: most of it is {:.4g} mm thick, but {:.3g} % of the "
                                 "skins are not, the largest face of them {:.4g} mm",
                                 thickness, 100 * off / whole, worst_thickness),
                     solid.largest([&](int p) { return p == worst; }));
}

/// How many outlines there are, whether they are rounded, and whether the skins are plane.
void describe_outline(const Solid& solid, ThinSolid& result)
{
    const SurfacePieces& pieces = solid.pieces;
    const auto rim = [&](int p) { return solid.sides.side[size_t(p)] == PieceSide::rim; };
    DisjointSets together(size_t(pieces.count()));
    for (const PieceContact& c : pieces.contact)
        if (rim(c.a) && rim(c.b))
            together.join(c.a, c.b);
    double smooth = 0, whole = 0;
    std::vector<char> touches(size_t(pieces.count()), 0);
    for (const PieceContact& c : pieces.contact)
        if (rim(c.a) != rim(c.b)) {
            smooth += c.smooth;
            whole += c.length();
            const auto [outline, skin] = rim(c.a) ? std::pair(c.a, c.b) : std::pair(c.b, c.a);
            touches[size_t(together.root(outline))] |= solid.sides.side[size_t(skin)] == PieceSide::one ? 1 : 2;
        }
    result.outlines = int(std::count(touches.begin(), touches.end(), 3));
    result.rounded = whole > 0 ? smooth / whole : 0;
    constexpr double flat = 1e-4; // of the area: the whole plane but for a degree
    for (const PieceSide side : {PieceSide::one, PieceSide::other}) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double size = 0;
        for (int f = 0; f < solid.mesh.triangles(); ++f)
            if (solid.side(f) == side) {
                sum += solid.normal.col(f);
                size += solid.normal.col(f).norm();
            }
        result.bent |= sum.norm() < (1 - flat) * size;
    }
}

ThinSolid result_of(const Solid& solid, double volume, double flipped)
{
    ThinSolid result;
    result.volume = volume;
    result.flipped = flipped;
    double one = 0, other = 0;
    int first = -1;
    for (int f = 0; f < solid.mesh.triangles(); ++f) {
        const double size = solid.normal.col(f).norm();
        const PieceSide side = solid.side(f);
        (side == PieceSide::one ? one : side == PieceSide::other ? other : result.rim) += size;
        if (first < 0 && side != PieceSide::rim)
            first = f;
    }
    constexpr double rounding = 1e-9;
    const PieceSide outer = std::abs(one - other) <= rounding * (one + other) ? solid.side(first)
                            : one > other                                     ? PieceSide::one
                                                                              : PieceSide::other;
    result.outer = outer == PieceSide::one ? one : other;
    result.inner = outer == PieceSide::one ? other : one;
    for (int f = 0; f < solid.mesh.triangles(); ++f) {
        const PieceSide side = solid.side(f);
        result.side.push_back(side == PieceSide::rim ? SheetSide::rim
                              : side == outer        ? SheetSide::outer
                                                     : SheetSide::inner);
    }
    return result;
}

} // namespace

ThinSolid thin_solid(const TriMesh& mesh, const ThinSolidOptions& options, const Progress& progress)
{
    if (!options.unit.empty() && int(options.unit.size()) != mesh.triangles())
        throw InputError(
            fmt::format("{} triangles have {} CAD faces given; each needs one", mesh.triangles(), options.unit.size()));
    if (mesh.triangles() == 0)
        throw NotASheet("it has no face", -1, Eigen::Vector3d::Zero());
    const double volume = signed_volume(mesh), flipped = volume < 0 ? -1 : 1;
    Solid solid{mesh, options};
    solid.normal = flipped * area_vectors(mesh);
    solid.closed = boundary_loops(mesh).empty();
    const double area = solid.normal.colwise().norm().sum();
    progress.checkpoint(0, "looking for pieces of surface");
    solid.pieces = surface_pieces(mesh, solid.normal, options.unit);

    const double about = 2 * std::abs(volume) / area; // thickness of a closed sheet, less for its rim
    solid.places =
        opposites(mesh, solid.normal, std::max(3 * about, 1e-3 * bounding_diagonal(mesh)), progress.part(0.1, 0.6));
    double thickness = main_distance(solid.places, std::vector<char>(solid.places.size(), 1));
    require_thin(solid, thickness, area);

    progress.checkpoint(0.6, "taking the sides apart");
    solid.sides = sheet_sides(solid.pieces, solid.places, thickness);
    require_two_sides(solid, thickness, area);
    std::vector<SheetMark> marks;
    if (solid.closed)
        marks = find_marks(mesh, solid.normal, solid.pieces, solid.sides.side, thickness);
    give_counterbores_to_the_rim(solid, thickness, area);
    require_connected(solid, thickness, area);
    if (!solid.closed)
        require_rim(solid);

    std::vector<char> from_skin_to_skin;
    for (const Opposite& at : solid.places)
        from_skin_to_skin.push_back(at.hit >= 0 && solid.side(at.face) != PieceSide::rim &&
                                    solid.side(at.hit) != PieceSide::rim);
    thickness = between_vertices(solid, main_distance(solid.places, from_skin_to_skin), marks);
    const std::vector<Local> local = local_thickness(solid, thickness, progress.part(0.7, 1));
    require_even(solid, local, thickness);

    ThinSolid result = result_of(solid, std::abs(volume), flipped);
    result.thickness = thickness;
    result.marks = std::move(marks);
    std::vector<std::pair<double, double>> spread;
    for (const Local& at : local)
        spread.emplace_back(at.thickness, at.area);
    result.least = std::min(thickness, quantile(spread, 0.01));
    result.most = std::max(thickness, quantile(spread, 0.99));
    describe_outline(solid, result);
    const double filled = volume * flipped / (thickness * (result.outer + result.inner) / 2);
    if (solid.closed && (filled < 0.8 || filled > 1.25))
        solid.refuse(fmt::format("its volume of {:.6g} mm3 is {:.3g} times that of a sheet {:.4g} mm thick with these "
                                 "skins",
                                 std::abs(volume), filled, thickness),
                     solid.largest([](int) { return true; }));
    progress.checkpoint(1, "measuring the thickness");
    return result;
}

bool seems_thin_solid(const TriMesh& mesh)
{
    constexpr int rays = 400;
    constexpr double most = 0.7;
    if (mesh.triangles() < 4)
        return false;
    const Eigen::Matrix3Xd normal = area_vectors(mesh);
    const double whole = normal.colwise().norm().sum(), off = 1e-7 * bounding_diagonal(mesh);
    if (!(whole > 0))
        return false;
    const RayPicker picker(mesh);
    std::array<int, 2> found{};
    double passed = 0;
    int next = 0;
    for (int f = 0; f < mesh.triangles(); ++f) {
        passed += normal.col(f).norm();
        for (; next < rays && passed >= (next + 0.5) / rays * whole; ++next) {
            const Eigen::Vector3d n = normal.col(f).normalized(), middle = (mesh.position.col(mesh.triangle(0, f)) +
                                                                            mesh.position.col(mesh.triangle(1, f)) +
                                                                            mesh.position.col(mesh.triangle(2, f))) /
                                                                           3;
            for (const size_t k : {size_t(0), size_t(1)}) {
                const Eigen::Vector3d along = k == 0 ? Eigen::Vector3d(-n) : n;
                const RayHit hit = picker.first(middle + off * along, along);
                found[k] += hit.face >= 0 && hit.face != f && hit.distance < thick * std::sqrt(whole / 2) &&
                            normal.col(hit.face).normalized().dot(n) < -0.72;
            }
        }
    }
    return std::max(found[0], found[1]) > most * rays;
}

} // namespace spia
