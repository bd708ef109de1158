#include "engine/mesh/solid/sheet_sides.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>

#include "engine/mesh/disjoint_sets.h"

namespace spia {
namespace {

constexpr double sure = 0.8; // of a piece's area lies opposite to another: it belongs to a skin
constexpr double likely = 0.5;
constexpr double least_facing = 0.72;                       // 44 degrees: not chamfers
constexpr double steepest = 0.5;                            // 60 degrees: a countersink, if it is
                                                            // askew all over
constexpr double least_distance = 0.6, most_distance = 1.7; // of the thickness
constexpr double parallel = 0.94;                           // 20 degrees: chords of one bend on
                                                            // both sides are askew by less
constexpr double mostly_sloped = 0.75;                      // of a piece; of sharp bends' outer
                                                            // sides a half

/// Two pieces that are on the same skin or on different ones.
struct Relation {
    double weight; ///< mm2
    int a, b;
    bool differ;
    bool weak; ///< comes after all others
};

/// Groups of things of two kinds, of which pairs are known to be the same or to differ.
class TwoColours {
public:
    explicit TwoColours(int n) : parent_(size_t(n)), differs_(size_t(n), 0)
    {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    std::pair<int, bool> root(int i) const ///< and whether i differs from it
    {
        bool differs = false;
        for (; parent_[size_t(i)] != i; i = parent_[size_t(i)])
            differs ^= bool(differs_[size_t(i)]);
        return {i, differs};
    }
    void relate(int a, int b, bool differ)
    {
        const auto [p, from_p] = root(a);
        const auto [q, from_q] = root(b);
        if (p == q)
            return;
        const bool turned = differ ^ from_p ^ from_q;
        // Joined by size, so that the ways to the root stay short.
        parent_[size_t(size_[size_t(p)] < size_[size_t(q)] ? p : q)] = size_[size_t(p)] < size_[size_t(q)] ? q : p;
        const int child = parent_[size_t(p)] == q ? p : q, other = child == p ? q : p;
        differs_[size_t(child)] = turned;
        size_[size_t(other)] += size_[size_t(child)];
    }

private:
    std::vector<int> parent_;
    std::vector<char> differs_;
    std::vector<int> size_ = std::vector<int>(parent_.size(), 1);
};

std::vector<double> opposite_shares(const SurfacePieces& pieces, const std::vector<Opposite>& places, double thickness)
{
    std::vector<double> share(size_t(pieces.count()), 0);
    for (const Opposite& at : places)
        if (across(at, thickness)) {
            const auto p = size_t(pieces.piece[size_t(at.face)]);
            share[p] += at.area / pieces.area[p];
        }
    // Low walls around raised marks lie opposite to each other, too; strips of bends go on smoothly
    // at their sides. Of a wall along a curve each chord may be a piece, not longer than it is
    // high: its sharp edges alone tell its height.
    constexpr double low = 0.25; // of the thickness, for twice the area over the outline: the
                                 // height of a wall
    std::vector<double> around(size_t(pieces.count()), 0), smooth(size_t(pieces.count()), 0);
    for (const PieceContact& c : pieces.contact)
        for (const int p : {c.a, c.b}) {
            around[size_t(p)] += c.length();
            smooth[size_t(p)] += c.smooth;
        }
    for (size_t p = 0; p < share.size(); ++p) {
        const bool wall = smooth[p] < around[p] / 2 && 2 * pieces.area[p] < low * thickness * around[p],
                   chord = 2 * pieces.area[p] < low * thickness * (around[p] - smooth[p]);
        if (wall || chord)
            share[p] = 0;
    }
    return share;
}

/// Of each piece the share of its area that lies askew to the other side, as of countersinks and
/// wide chamfers.
/// @param least  the cosine of the steepest slope
std::vector<double> sloped_shares(const SurfacePieces& pieces, const std::vector<Opposite>& places, double thickness,
                                  double least)
{
    std::vector<double> share(size_t(pieces.count()), 0);
    for (const Opposite& at : places)
        if (at.hit >= 0 && at.facing > least && at.facing < parallel && at.distance < most_distance * thickness) {
            const auto p = size_t(pieces.piece[size_t(at.face)]);
            share[p] += at.area / pieces.area[p];
        }
    return share;
}

/// The outer sides of sharp bends are askew to the inner ones as well; but they go on smoothly at
/// most of their outline, whereas a countersink ends at its hole.
void keep_bends(const SurfacePieces& pieces, std::vector<double>& sloped)
{
    constexpr double ends = 0.25;         // of what goes on smoothly; of a hole half as wide as its
                                          // countersink 0.5
    DisjointSets together(sloped.size()); // a countersink may be in several pieces
    const auto steep = [&](int p) { return sloped[size_t(p)] > mostly_sloped; };
    for (const PieceContact& c : pieces.contact)
        if (c.smooth > 0 && steep(c.a) && steep(c.b))
            together.join(c.a, c.b);
    std::vector<double> smooth(sloped.size(), 0), sharp(sloped.size(), 0);
    for (const PieceContact& c : pieces.contact) {
        if (steep(c.a) && steep(c.b) && together.root(c.a) == together.root(c.b))
            continue;
        for (const int p : {c.a, c.b}) {
            smooth[size_t(together.root(p))] += c.smooth;
            sharp[size_t(together.root(p))] += c.concave + c.convex;
        }
    }
    for (int p = 0; p < pieces.count(); ++p)
        if (const auto group = size_t(together.root(p)); sharp[group] < ends * smooth[group])
            sloped[size_t(p)] = 0;
}

/// Between pieces that are surely skin.
std::vector<Relation> relations(const SurfacePieces& pieces, const std::vector<Opposite>& places,
                                const std::vector<double>& share, double thickness)
{
    const auto skin = [&](int p) { return share[size_t(p)] >= sure; };
    std::map<std::pair<int, int>, double> facing;
    for (const Opposite& at : places)
        if (across(at, thickness)) {
            const int p = pieces.piece[size_t(at.face)], q = pieces.piece[size_t(at.hit)];
            if (p != q && skin(p) && skin(q))
                facing[std::minmax(p, q)] += at.area;
        }
    std::vector<Relation> result;
    result.reserve(facing.size());
    for (const auto& [pair, area] : facing)
        result.push_back({area, pair.first, pair.second, true, false});
    for (const PieceContact& contact : pieces.contact)
        if (skin(contact.a) && skin(contact.b)) {
            if (contact.smooth > 0)
                result.push_back({contact.smooth * thickness, contact.a, contact.b, false, false});
            else if (contact.concave > 0)
                result.push_back({contact.concave * thickness, contact.a, contact.b, false, true});
        }
    std::stable_sort(result.begin(), result.end(), [](const Relation& a, const Relation& b) {
        return a.weak != b.weak ? b.weak : a.weight > b.weight;
    });
    return result;
}

using Side = std::vector<int>; // per piece: 0 one, 1 other, -1 not known, `none` that of the faces
                               // across the thickness
constexpr int none = -2;

/// The largest group of pieces that relations join.
Side sure_sides(const SurfacePieces& pieces, const std::vector<Relation>& relations, const std::vector<double>& share)
{
    TwoColours colours(pieces.count());
    for (const Relation& relation : relations)
        colours.relate(relation.a, relation.b, relation.differ);
    std::vector<double> area(size_t(pieces.count()), 0);
    for (int p = 0; p < pieces.count(); ++p)
        if (share[size_t(p)] >= sure)
            area[size_t(colours.root(p).first)] += pieces.area[size_t(p)];
    const int largest = int(std::max_element(area.begin(), area.end()) - area.begin());
    Side side(size_t(pieces.count()), -1);
    for (int p = 0; p < pieces.count(); ++p)
        if (const auto [root, differs] = colours.root(p); root == largest && share[size_t(p)] >= sure)
            side[size_t(p)] = differs;
    return side;
}

/// Pieces that are not sure, in groups across which the surface goes on smoothly: settled by what a
/// group touches.
/// @returns whether one was
bool settle_groups(const SurfacePieces& pieces, const std::vector<double>& share, const std::vector<double>& sloped,
                   Side& side)
{
    DisjointSets group(size_t(pieces.count()));
    for (const PieceContact& c : pieces.contact)
        if (c.smooth > 0 && side[size_t(c.a)] == -1 && side[size_t(c.b)] == -1)
            group.join(c.a, c.b);
    struct Touch {
        std::array<double, 2> smooth{}, sharp{};
        double area = 0, across = 0, sloped = 0;
    };
    std::map<int, Touch> touches;
    for (int p = 0; p < pieces.count(); ++p)
        if (side[size_t(p)] == -1) {
            Touch& touch = touches[group.root(p)];
            touch.area += pieces.area[size_t(p)];
            touch.across += pieces.area[size_t(p)] * share[size_t(p)];
            touch.sloped += pieces.area[size_t(p)] * sloped[size_t(p)];
        }
    for (const PieceContact& c : pieces.contact)
        for (const auto& [unsure, known] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            if (side[size_t(unsure)] == -1 && side[size_t(known)] >= 0) {
                Touch& touch = touches[group.root(unsure)];
                touch.smooth[size_t(side[size_t(known)])] += c.smooth;
                touch.sharp[size_t(side[size_t(known)])] += c.concave + c.convex;
            }
    bool settled = false;
    for (int p = 0; p < pieces.count(); ++p) {
        if (side[size_t(p)] != -1)
            continue;
        const Touch& touch = touches[group.root(p)];
        if (touch.sloped > mostly_sloped * touch.area)
            continue;
        for (const size_t s : {size_t(0), size_t(1)}) {
            const bool only = touch.smooth[1 - s] + touch.sharp[1 - s] == 0;
            if (only && (touch.smooth[s] > 0 || (touch.sharp[s] > 0 && touch.across >= likely * touch.area))) {
                side[size_t(p)] = int(s) + 2; // known from the next round on
                settled = true;
                break;
            }
        }
    }
    for (int& s : side)
        s = s >= 2 ? s - 2 : s;
    return settled;
}

/// Pieces that are not sure, by what looks at them from behind: the outer faces of thick sheet lie
/// opposite to the inner ones with the part that is not in a corner only, those of a thick tube
/// with the share of the inner radius in the outer one. What touches the side that looks at it is
/// none, and what goes over into the faces across smoothly is a rounding of the border.
/// @returns whether one was
bool settle_faced(const SurfacePieces& pieces, const std::vector<Opposite>& places, const std::vector<double>& share,
                  const std::vector<double>& sloped, double thickness, Side& side)
{
    constexpr double least = 0.1; // of its area
    std::vector<std::array<double, 2>> looked(size_t(pieces.count()), {0, 0});
    for (const Opposite& at : places)
        if (across(at, thickness))
            if (const int s = side[size_t(pieces.piece[size_t(at.face)])]; s >= 0)
                looked[size_t(pieces.piece[size_t(at.hit)])][size_t(s)] += at.area;
    std::vector<char> touches(size_t(pieces.count()), 0); // 1 one, 2 other
    std::vector<double> around(size_t(pieces.count()), 0), into_rim(size_t(pieces.count()), 0);
    for (const PieceContact& c : pieces.contact)
        for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)}) {
            touches[size_t(p)] |= side[size_t(q)] >= 0 ? side[size_t(q)] + 1 : 0;
            around[size_t(p)] += c.length();
            into_rim[size_t(p)] += side[size_t(q)] < 0 && share[size_t(q)] < least ? c.smooth : 0;
        }
    constexpr double rounding = 0.25; // of its outline; of one along a straight border about half
    bool settled = false;
    for (int p = 0; p < pieces.count(); ++p) {
        const auto [one, other] = looked[size_t(p)];
        if (side[size_t(p)] != -1 || sloped[size_t(p)] > mostly_sloped ||
            into_rim[size_t(p)] > rounding * around[size_t(p)] ||
            std::max(one, other) < least * pieces.area[size_t(p)] ||
            std::min(one, other) > least * std::max(one, other) || (touches[size_t(p)] & (one > other ? 1 : 2)))
            continue;
        side[size_t(p)] = one > other ? 1 : 0;
        settled = true;
    }
    return settled;
}

} // namespace

bool across(const Opposite& place, double thickness)
{
    return place.hit >= 0 && place.facing > least_facing && place.distance > least_distance * thickness &&
           place.distance < most_distance * thickness;
}

SheetSides sheet_sides(const SurfacePieces& pieces, const std::vector<Opposite>& places, double thickness,
                       const std::vector<char>& across_it)
{
    SheetSides result;
    result.opposite_area = opposite_shares(pieces, places, thickness);
    std::vector<double> sloped = sloped_shares(pieces, places, thickness, least_facing);
    keep_bends(pieces, sloped);
    // Chords of a countersink of 90 degrees are on both sides of that: the bit of it that faces the
    // other side says nothing.
    std::vector<double> steep = sloped_shares(pieces, places, thickness, steepest);
    keep_bends(pieces, steep);
    for (size_t p = 0; p < sloped.size(); ++p)
        if (sloped[p] > mostly_sloped || across_it[p])
            result.opposite_area[p] = 0;
    const std::vector<double>& share = result.opposite_area;
    Side side = sure_sides(pieces, relations(pieces, places, share, thickness), share);
    for (size_t p = 0; p < side.size(); ++p)
        side[p] = across_it[p] ? none : side[p];
    while (settle_faced(pieces, places, share, steep, thickness, side) || settle_groups(pieces, share, sloped, side)) {
    }

    double whole = 0, same = 0, most = 0;
    std::map<int, double> same_of;
    for (const Opposite& at : places)
        if (const int s = side[size_t(pieces.piece[size_t(at.face)])]; s >= 0) {
            whole += at.area;
            if (across(at, thickness) && side[size_t(pieces.piece[size_t(at.hit)])] == s) {
                same += at.area;
                same_of[pieces.piece[size_t(at.face)]] += at.area;
            }
        }
    result.contradicted = whole > 0 ? same / whole : 0;
    int worst = -1;
    for (const auto& [p, area] : same_of)
        if (area > most) {
            most = area;
            worst = p;
        }
    for (size_t i = 0; i < places.size() && result.where < 0; ++i) {
        const int p = pieces.piece[size_t(places[i].face)];
        if (p == worst && across(places[i], thickness) &&
            side[size_t(pieces.piece[size_t(places[i].hit)])] == side[size_t(p)])
            result.where = int(i);
    }
    for (const int s : side)
        result.side.push_back(s < 0 ? PieceSide::rim : s == 0 ? PieceSide::one : PieceSide::other);
    return result;
}

} // namespace spia
