#include "engine/mesh/solid/sides/sheet_sides.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/solid/sides/piece_shares.h"

namespace spia {
namespace {

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

/// Of pieces that a low wall parts, as a step and its skin.
std::vector<Relation> over_low_walls(const SurfacePieces& pieces, const std::vector<char>& low, const auto& skin)
{
    std::map<int, std::vector<const PieceContact*>> beside;
    for (const PieceContact& c : pieces.contact)
        for (const auto& [wall, other] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            if (low[size_t(wall)] && skin(other))
                beside[wall].push_back(&c);
    std::vector<Relation> result;
    for (const auto& [wall, contacts] : beside) {
        const PieceContact& longest = **std::ranges::max_element(contacts, {}, &PieceContact::length);
        for (const PieceContact* c : contacts) {
            constexpr double most_of_it = 0.5; // the rest is a corner
            const int one = longest.a == wall ? longest.b : longest.a, other = c->a == wall ? c->b : c->a;
            if (c != &longest && c->length() > most_of_it * longest.length())
                result.push_back({c->length(), one, other, false, true});
        }
    }
    return result;
}

/// Between pieces that are surely skin.
std::vector<Relation> relations(const SurfacePieces& pieces, const std::vector<Opposite>& places,
                                const PieceShares& share, double thickness)
{
    const auto skin = [&](int p) { return share.opposite[size_t(p)] >= surely_skin; };
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
    std::ranges::move(over_low_walls(pieces, share.low_wall, skin), std::back_inserter(result));
    std::stable_sort(result.begin(), result.end(), [](const Relation& a, const Relation& b) {
        return a.weak != b.weak ? b.weak : a.weight > b.weight;
    });
    return result;
}

using PieceSides = std::vector<int>; // per piece: 0 one, 1 other, -1 not known, `none` that of the faces
                                     // across the thickness
constexpr int none = -2;

/// The largest group of pieces that relations join.
PieceSides sure_sides(const SurfacePieces& pieces, const std::vector<Relation>& relations,
                      const std::vector<double>& opposite)
{
    TwoColours colours(pieces.count());
    for (const Relation& relation : relations)
        colours.relate(relation.a, relation.b, relation.differ);
    std::vector<double> area(size_t(pieces.count()), 0);
    for (int p = 0; p < pieces.count(); ++p)
        if (opposite[size_t(p)] >= surely_skin)
            area[size_t(colours.root(p).first)] += pieces.area[size_t(p)];
    const int largest = int(std::max_element(area.begin(), area.end()) - area.begin());
    PieceSides side(size_t(pieces.count()), -1);
    for (int p = 0; p < pieces.count(); ++p)
        if (const auto [root, differs] = colours.root(p); root == largest && opposite[size_t(p)] >= surely_skin)
            side[size_t(p)] = differs;
    return side;
}

/// Per piece the sides that it touches, 1 one, 2 other; across an edge of any kind.
std::vector<int> touched_sides(const SurfacePieces& pieces, const PieceSides& side)
{
    std::vector<int> touched(size_t(pieces.count()), 0);
    for (const PieceContact& c : pieces.contact)
        for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            touched[size_t(p)] |= side[size_t(q)] >= 0 ? side[size_t(q)] + 1 : 0;
    return touched;
}

/// Pieces that are not sure, in groups across which the surface goes on smoothly: settled by what a
/// group touches. A chamfer hands on which skin it is at: the rounding of one skin and the wall
/// that ends at a chamfer of the other are the border's.
/// @returns whether one was
bool settle_groups(const SurfacePieces& pieces, const PieceShares& share, PieceSides& side)
{
    const auto unsure = [&](int p) { return side[size_t(p)] == -1 && !share.border[size_t(p)]; };
    DisjointSets group(size_t(pieces.count()));
    for (const PieceContact& c : pieces.contact)
        if (c.smooth > 0 && unsure(c.a) && unsure(c.b))
            group.join(c.a, c.b);
    struct Touch {
        std::array<double, 2> smooth{}, sharp{};
        double area = 0, across = 0, sloped = 0, into_border = 0; ///< mm, the last one
    };
    std::map<int, Touch> touches;
    for (int p = 0; p < pieces.count(); ++p)
        if (unsure(p)) {
            Touch& touch = touches[group.root(p)];
            touch.area += pieces.area[size_t(p)];
            touch.across += pieces.area[size_t(p)] * share.opposite[size_t(p)];
            touch.sloped += pieces.area[size_t(p)] * share.sloped[size_t(p)];
        }
    const std::vector<int> touched = touched_sides(pieces, side);
    for (const PieceContact& c : pieces.contact)
        for (const auto& [one, known] : {std::pair(c.a, c.b), std::pair(c.b, c.a)}) {
            if (!unsure(one))
                continue;
            Touch& touch = touches[group.root(one)];
            touch.into_border += share.border[size_t(known)] ? c.smooth : 0;
            if (side[size_t(known)] >= 0) {
                touch.smooth[size_t(side[size_t(known)])] += c.smooth;
                touch.sharp[size_t(side[size_t(known)])] += c.concave + c.convex;
            } else if (share.steep[size_t(known)] > mostly_sloped)
                for (const size_t s : {size_t(0), size_t(1)})
                    touch.sharp[s] += touched[size_t(known)] & (s + 1) ? c.concave + c.convex : 0;
        }
    bool settled = false;
    for (int p = 0; p < pieces.count(); ++p) {
        if (!unsure(p))
            continue;
        const Touch& touch = touches[group.root(p)];
        constexpr double rounding = 0.25; // of what goes on smoothly
        if (touch.sloped > mostly_sloped * touch.area ||
            touch.into_border > rounding * (touch.into_border + touch.smooth[0] + touch.smooth[1]))
            continue;
        for (const size_t s : {size_t(0), size_t(1)}) {
            constexpr double least = 0.1; // a bit of a sink is level with what was put back beside it
            const bool only = touch.smooth[1 - s] + touch.sharp[1 - s] == 0;
            if (only && (touch.smooth[s] > least * (touch.smooth[s] + touch.sharp[s]) ||
                         (touch.sharp[s] > 0 && touch.across >= touch.area / 2))) {
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
bool settle_faced(const SurfacePieces& pieces, const std::vector<Opposite>& places, const PieceShares& share,
                  double thickness, PieceSides& side)
{
    constexpr double least = 0.1; // of its area
    std::vector<std::array<double, 2>> looked(size_t(pieces.count()), {0, 0});
    for (const Opposite& at : places)
        if (across(at, thickness))
            if (const int s = side[size_t(pieces.piece[size_t(at.face)])]; s >= 0)
                looked[size_t(pieces.piece[size_t(at.hit)])][size_t(s)] += at.area;
    const std::vector<int> touched = touched_sides(pieces, side);
    std::vector<double> around(size_t(pieces.count()), 0), into_rim(size_t(pieces.count()), 0);
    for (const PieceContact& c : pieces.contact)
        for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)}) {
            around[size_t(p)] += c.length();
            into_rim[size_t(p)] += side[size_t(q)] < 0 && share.opposite[size_t(q)] < least ? c.smooth : 0;
        }
    constexpr double rounding = 0.25; // of its outline; of one along a straight border about half
    bool settled = false;
    for (int p = 0; p < pieces.count(); ++p) {
        const auto [one, other] = looked[size_t(p)];
        if (side[size_t(p)] != -1 || share.steep[size_t(p)] > mostly_sloped ||
            into_rim[size_t(p)] > rounding * around[size_t(p)] ||
            std::max(one, other) < least * pieces.area[size_t(p)] ||
            std::min(one, other) > least * std::max(one, other) || (touched[size_t(p)] & (one > other ? 1 : 2)))
            continue;
        side[size_t(p)] = one > other ? 1 : 0;
        settled = true;
    }
    return settled;
}

} // namespace

SheetSides sheet_sides(const SurfacePieces& pieces, const std::vector<Opposite>& places, double thickness,
                       const std::vector<char>& across_it)
{
    SheetSides result;
    const PieceShares share = piece_shares(pieces, places, thickness, across_it);
    result.opposite_area = share.opposite;
    PieceSides side = sure_sides(pieces, relations(pieces, places, share, thickness), share.opposite);
    for (size_t p = 0; p < side.size(); ++p)
        side[p] = across_it[p] ? none : side[p];
    while (settle_faced(pieces, places, share, thickness, side) || settle_groups(pieces, share, side)) {
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
