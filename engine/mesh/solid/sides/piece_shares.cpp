#include "engine/mesh/solid/sides/piece_shares.h"

#include <utility>

#include "engine/mesh/disjoint_sets.h"

namespace spia {
namespace {

constexpr double least_facing = 0.72;    // 44 degrees: not chamfers
constexpr double steepest = 0.5;         // 60 degrees: a countersink, if it is askew all over
constexpr double chords_parallel = 0.94; // 20 degrees: chords of one bend on both sides are askew by less
// of the thickness: between the deepest marks of both sides 0.6
constexpr double least_distance = 0.55, most_distance = 1.7;

/// Low walls, as around marks and steps. Strips of bends go on smoothly at their sides. Of a wall
/// along a curve each chord may be a piece, not longer than it is high: its sharp edges alone tell
/// its height.
std::vector<char> low_walls(const SurfacePieces& pieces, double thickness)
{
    constexpr double low = 0.25; // of the thickness, for twice the area over the outline: the height
    std::vector<double> around(size_t(pieces.count()), 0), smooth(size_t(pieces.count()), 0);
    for (const PieceContact& c : pieces.contact)
        for (const int p : {c.a, c.b}) {
            around[size_t(p)] += c.length();
            smooth[size_t(p)] += c.smooth;
        }
    std::vector<char> result;
    for (size_t p = 0; p < around.size(); ++p) {
        const bool wall = smooth[p] < around[p] / 2 && 2 * pieces.area[p] < low * thickness * around[p],
                   chord = 2 * pieces.area[p] < low * thickness * (around[p] - smooth[p]);
        result.push_back(wall || chord);
    }
    return result;
}

/// @param low  walls that lie opposite to each other, too, around raised marks
std::vector<double> opposite_shares(const SurfacePieces& pieces, const std::vector<Opposite>& places,
                                    const std::vector<char>& low, double thickness)
{
    std::vector<double> share(size_t(pieces.count()), 0);
    for (const Opposite& at : places)
        if (const auto p = size_t(pieces.piece[size_t(at.face)]); !low[p] && across(at, thickness))
            share[p] += at.area / pieces.area[p];
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
        if (at.hit >= 0 && at.facing > least && at.facing < chords_parallel &&
            at.distance < most_distance * thickness) {
            const auto p = size_t(pieces.piece[size_t(at.face)]);
            share[p] += at.area / pieces.area[p];
        }
    return share;
}

/// Walls, and strips of roundings that go over into them: in a mesh each chord is a piece.
std::vector<char> rounded_into_walls(const SurfacePieces& pieces, const std::vector<Opposite>& places, double thickness)
{
    constexpr double most = 0.25;     // of what goes on smoothly; along a straight strip a half
    constexpr double surely = 0.4;    // of it, for first chords: strips of narrow bends end there by a third
    constexpr double turned = 0.9998; // 1 degree: not the skin that a rounding comes from
    const auto n = size_t(pieces.count());
    std::vector<double> along_sheet(n, 0), askew(n, 0), little(n, 0), smooth(n, 0);
    for (const Opposite& at : places) {
        const auto p = size_t(pieces.piece[size_t(at.face)]);
        const bool far = at.hit < 0 || at.distance > most_distance * thickness;
        along_sheet[p] += far ? at.area : 0;
        askew[p] += far || at.facing < chords_parallel ? at.area : 0;
        little[p] += far || at.facing < turned ? at.area : 0;
    }
    for (const PieceContact& c : pieces.contact)
        for (const int p : {c.a, c.b})
            smooth[size_t(p)] += c.smooth;
    std::vector<char> found(n, 0);
    for (size_t p = 0; p < n; ++p)
        found[p] = along_sheet[p] > surely_skin * pieces.area[p];
    for (bool more = true; more;) {
        more = false;
        std::vector<double> into(n, 0);
        for (const PieceContact& c : pieces.contact)
            for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
                into[size_t(p)] += found[size_t(q)] ? c.smooth : 0;
        for (size_t p = 0; p < n; ++p)
            if (const double enough = mostly_sloped * pieces.area[p];
                !found[p] && ((askew[p] > enough && into[p] > most * smooth[p]) ||
                              (little[p] > enough && into[p] > surely * smooth[p]))) {
                found[p] = 1;
                more = true;
            }
    }
    return found;
}

/// What goes on level from a skin is of that skin: in the outer corner of a sharp bend nothing is
/// opposite to it.
void keep_corners(const SurfacePieces& pieces, std::vector<char>& border)
{
    constexpr double enough = 0.25; // of its outline; a wall in two faces goes on over their short ends
    const auto n = size_t(pieces.count());
    std::vector<double> level(n, 0), around(n, 0);
    for (const PieceContact& c : pieces.contact)
        for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)}) {
            around[size_t(p)] += c.length();
            level[size_t(p)] += border[size_t(q)] ? 0 : c.level;
        }
    for (size_t p = 0; p < n; ++p)
        if (level[p] > enough * around[p])
            border[p] = 0;
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

} // namespace

PieceShares piece_shares(const SurfacePieces& pieces, const std::vector<Opposite>& places, double thickness,
                         const std::vector<char>& across_it)
{
    PieceShares result;
    result.low_wall = low_walls(pieces, thickness);
    result.opposite = opposite_shares(pieces, places, result.low_wall, thickness);
    result.sloped = sloped_shares(pieces, places, thickness, least_facing);
    keep_bends(pieces, result.sloped);
    // Chords of a countersink of 90 degrees are on both sides of that: the bit of it that faces the
    // other side says nothing.
    result.steep = sloped_shares(pieces, places, thickness, steepest);
    keep_bends(pieces, result.steep);
    result.border = rounded_into_walls(pieces, places, thickness);
    for (size_t p = 0; p < result.opposite.size(); ++p)
        if (result.sloped[p] > mostly_sloped || result.border[p] || across_it[p])
            result.opposite[p] = 0;
    keep_corners(pieces, result.border);
    return result;
}

bool across(const Opposite& place, double thickness)
{
    return place.hit >= 0 && place.facing > least_facing && place.distance > least_distance * thickness &&
           place.distance < most_distance * thickness;
}

} // namespace spia
