#include "engine/mesh/solid/sides/sheet_conditions.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/solid/marks/thin_floors.h"
#include "engine/mesh/solid/sides/piece_shares.h"

namespace spia {
namespace {

constexpr double block = 0.36;  // of that with half of the area: a square plate half as thick as it
                                // is wide
constexpr double speck = 0.005; // of the surface: what is smaller is no piece of a side

/// Of pieces that stand off their side: "; they reach ... ", and what would be let pass.
template <class Counts>
std::string how_deep(const SolidInPieces& solid, PieceSide side, double thickness, const Counts& counts)
{
    std::vector<char> chosen(size_t(solid.pieces.count()));
    for (int p = 0; p < solid.pieces.count(); ++p)
        chosen[size_t(p)] = counts(p);
    const double depth = depth_of(solid.mesh, solid.pieces, solid.sides.side, chosen, side, thickness);
    return depth > 0 ? fmt::format(", {:.4g} mm off the level of that side; marks of up to {:.4g} mm, {:.2g} of the "
                                   "thickness, would be passed over",
                                   depth, deepest_mark * thickness, deepest_mark)
                     : "";
}

/// Of a mesh slivers along an arc stand upright on their skin, where they have no area to speak of:
/// what has no vertex of its own between those of one skin is part of it.
void give_slivers_to_their_skin(SolidInPieces& solid)
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

/// Pieces of one side that touch each other, and their area, mm2, by the root.
struct Groups {
    DisjointSets together;
    std::vector<double> size;
};

Groups groups_of_a_side(const SolidInPieces& solid)
{
    const SurfacePieces& pieces = solid.pieces;
    Groups groups{DisjointSets(size_t(pieces.count())), std::vector<double>(size_t(pieces.count()), 0)};
    for (const PieceContact& c : pieces.contact)
        if (solid.sides.side[size_t(c.a)] == solid.sides.side[size_t(c.b)])
            groups.together.join(c.a, c.b);
    for (int p = 0; p < pieces.count(); ++p)
        groups.size[size_t(groups.together.root(p))] += pieces.area[size_t(p)];
    return groups;
}

/// What is not connected to the largest piece of a side becomes rim, unless it is too large for
/// that.
/// @param surely  the rest is sheet, were it not for this
void require_in_one_piece(SolidInPieces& solid, PieceSide side, double thickness, double area, bool surely)
{
    Groups groups = groups_of_a_side(solid);
    const auto size = [&](int p) { return groups.size[size_t(p)]; };
    int largest = -1, second = -1;
    for (int p = 0; p < solid.pieces.count(); ++p)
        if (groups.together.root(p) == p && solid.sides.side[size_t(p)] == side) {
            if (largest < 0 || size(p) > size(largest))
                second = std::exchange(largest, p);
            else if (second < 0 || size(p) > size(second))
                second = p;
        }
    if (largest < 0)
        solid.refuse("it has one side only: nothing lies opposite to it", solid.largest([](int) { return true; }));
    const auto of_second = [&](int p) { return groups.together.root(p) == second; };
    if (second >= 0 && size(second) > speck * area)
        solid.refuse(fmt::format("one of its sides is in several pieces that only faces across the {:.4g} mm of "
                                 "thickness join: it has more than two sides, or a step; the second piece has "
                                 "{:.4g} mm2{}",
                                 thickness, size(second), how_deep(solid, side, thickness, of_second)),
                     solid.largest(of_second), surely);
    for (int p = 0; p < solid.pieces.count(); ++p)
        if (solid.sides.side[size_t(p)] == side && groups.together.root(p) != largest)
            solid.sides.side[size_t(p)] = PieceSide::rim;
}

/// Of the faces across the thickness those that one side alone has are a step, a pocket or a boss:
/// with its floor, which was taken from its side before.
void require_through(const SolidInPieces& solid, double thickness, bool surely)
{
    Groups groups = groups_of_a_side(solid);
    std::vector<char> touches(groups.size.size(), 0);
    for (const PieceContact& c : solid.pieces.contact)
        for (const auto& [rim, skin] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            if (solid.sides.side[size_t(rim)] == PieceSide::rim && solid.sides.side[size_t(skin)] != PieceSide::rim)
                touches[size_t(groups.together.root(rim))] |= solid.sides.side[size_t(skin)] == PieceSide::one ? 1 : 2;
    for (int p = 0; p < solid.pieces.count(); ++p) {
        const double size = groups.size[size_t(p)];
        if (groups.together.root(p) != p || solid.sides.side[size_t(p)] != PieceSide::rim || touches[size_t(p)] == 3 ||
            size <= 4 * thickness * thickness)
            continue;
        const auto of_it = [&](int q) { return groups.together.root(q) == p; };
        const PieceSide side = touches[size_t(p)] == 1 ? PieceSide::one : PieceSide::other;
        solid.refuse(fmt::format("one of its sides has a step, a pocket or a boss: faces of {:.4g} mm2 across the "
                                 "{:.4g} mm thick sheet do not reach its other side{}",
                                 size, thickness, how_deep(solid, side, thickness, of_it)),
                     solid.largest(of_it), surely);
    }
}

} // namespace

void require_thin(const SolidInPieces& solid, double thickness, double area)
{
    const double width = std::sqrt(area / 2);
    const auto all = [](int) { return true; };
    if (thickness <= 0)
        solid.refuse("it is not a sheet: no two of its faces lie opposite to each other", solid.largest(all));
    if (thickness > block * width)
        solid.refuse(fmt::format("it is not a thin sheet but a block: most of it is {:.4g} mm thick, at a surface like "
                                 "that of a plate {:.4g} mm wide",
                                 thickness, width),
                     solid.largest(all));
}

void require_two_sides(const SolidInPieces& solid, double thickness, double area)
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
        solid.refuse(fmt::format("its thickness is not uniform: {:.4g} mm is the most frequent, but only {:.0f} % of "
                                 "its surface can be split into two skins that far apart{}",
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

void require_connected(SolidInPieces& solid, double thickness, double area)
{
    constexpr double plate = 0.15; // of the width: beyond that a plain one may be a closed box
                                   // (sheet_or_hollow())
    const bool surely = thickness < plate * std::sqrt(area / 2);
    for (const PieceSide side : {PieceSide::one, PieceSide::other})
        require_in_one_piece(solid, side, thickness, area, surely);
    if (solid.closed) {
        give_slivers_to_their_skin(solid);
        require_through(solid, thickness, surely);
    }
}

void require_no_thin_floor(const SolidInPieces& solid, double thickness, double area, const std::vector<char>& of_hole)
{
    const std::optional<ThinFloor> floor = thin_floor(solid.pieces, solid.places, solid.sides.side, thickness, of_hole);
    if (!floor || floor->area < speck * area)
        return;
    const auto of_it = [&](int p) { return floor->piece[size_t(p)] != 0; };
    solid.refuse(fmt::format("one of its sides has a pocket or a step, which is not a countersink or counterbore of a "
                             "round hole: over {:.4g} mm2 it is {:.4g} mm thick, and {:.4g} mm elsewhere{}",
                             floor->area, floor->thickness, thickness, how_deep(solid, floor->skin, thickness, of_it)),
                 solid.largest(of_it));
}

/// With faces missing, most of the outline of the skins must still be where faces cross the
/// thickness.
void require_rim(const SolidInPieces& solid)
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

/// Coined or thickened places.
void require_even(const SolidInPieces& solid, const std::vector<LocalThickness>& local,
                  const std::vector<SheetMark>& marks, double thickness)
{
    constexpr double thin = 0.75, fat = 1.5; // a bend with the same radius on both sides is 1.41
                                             // times as thick
    constexpr double most_share = 0.02;
    std::vector<char> of_mark(size_t(solid.mesh.triangles()), 0);
    for (const SheetMark& mark : marks)
        for (const int f : mark.floor)
            of_mark[size_t(f)] = 1;
    std::map<int, std::vector<std::pair<double, double>>> of_piece;
    for (const LocalThickness& at : local)
        if (!of_mark[size_t(at.face)])
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

} // namespace spia
