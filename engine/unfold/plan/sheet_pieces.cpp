#include "engine/unfold/plan/sheet_pieces.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "engine/mesh/disjoint_sets.h"

namespace spia {
namespace {

/// Facets: faces in one plane, however it was cut into triangles. A coarse flat is one, a face of a
/// fine fillet, too.
struct Facets {
    std::vector<int> of;      ///< #F, numbered in the order of their first face
    std::vector<int> faces;   ///< per facet, how many
    std::vector<double> area; ///< mm2
    std::vector<double> turn; ///< radians mm: half of what the sheet turns over the facet's edges,
                              ///< times their length
};

std::vector<int> numbered(DisjointSets& sets, int count)
{
    std::vector<int> number(static_cast<size_t>(count), -1), result(static_cast<size_t>(count));
    int next = 0;
    for (int i = 0; i < count; ++i) {
        int& n = number[size_t(sets.root(i))];
        result[size_t(i)] = n < 0 ? (n = next++) : n;
    }
    return result;
}

double lower_height(const SheetTurns& turns, const EdgeTurn& e)
{
    return std::min(turns.height(e, e.face), turns.height(e, e.twin));
}

Facets facets(const SheetTurns& turns, double most_curvature)
{
    constexpr double in_one_plane = 0.01;
    const int count = int(turns.area.size());
    DisjointSets sets(static_cast<size_t>(count));
    for (const EdgeTurn& e : turns.edge)
        if (e.turn <= in_one_plane && e.turn <= most_curvature * lower_height(turns, e))
            sets.join(e.face, e.twin);
    Facets result{numbered(sets, count), {}, {}, {}};
    const auto many = size_t(*std::max_element(result.of.begin(), result.of.end()) + 1);
    result.faces.assign(many, 0);
    result.area.assign(many, 0);
    result.turn.assign(many, 0);
    for (int f = 0; f < count; ++f) {
        ++result.faces[size_t(result.of[size_t(f)])];
        result.area[size_t(result.of[size_t(f)])] += turns.area[f];
    }
    for (const EdgeTurn& e : turns.edge) {
        const int p = result.of[size_t(e.face)], q = result.of[size_t(e.twin)];
        if (p != q && e.turn <= fold)
            for (const int facet : {p, q})
                result.turn[size_t(facet)] += e.turn * e.length / 2;
    }
    return result;
}

/// Whether a face is of a bend: by its facet; but a facet of a gently curved region that only
/// touches a bend belongs to the region, to which it turns far less than to the bend.
std::vector<char> bent_faces(const SheetTurns& turns, const Facets& facets, double most_curvature)
{
    constexpr double far_less = 0.25;
    std::vector<char> bent(facets.area.size());
    std::vector<double> most(bent.size(), 0); // turn over an edge of the facet
    for (size_t p = 0; p < bent.size(); ++p)
        bent[p] = facets.turn[p] > most_curvature * facets.area[p];
    for (const EdgeTurn& e : turns.edge)
        for (const int f : {e.face, e.twin})
            most[size_t(facets.of[size_t(f)])] = std::max(most[size_t(facets.of[size_t(f)])], e.turn);
    std::vector<char> still = bent;
    for (const EdgeTurn& e : turns.edge) {
        const auto p = size_t(facets.of[size_t(e.face)]), q = size_t(facets.of[size_t(e.twin)]);
        if (bent[p] != bent[q] && e.turn <= most_curvature * lower_height(turns, e) &&
            e.turn <= far_less * most[bent[p] ? p : q])
            still[bent[p] ? p : q] = 0;
    }
    std::vector<char> result(facets.of.size());
    for (size_t f = 0; f < result.size(); ++f)
        result[f] = still[size_t(facets.of[f])];
    return result;
}

/// Regions, split at sharp edges, and connected bends.
std::vector<int> first_pieces(const SheetTurns& turns, const Facets& facets, const std::vector<char>& bent,
                              const BendLimits& limits, double most_curvature)
{
    std::map<std::pair<int, int>, double> common; // mm, of the boundary of two facets
    const auto pair = [&](const EdgeTurn& e) {
        return std::minmax({facets.of[size_t(e.face)], facets.of[size_t(e.twin)]});
    };
    for (const EdgeTurn& e : turns.edge)
        common[pair(e)] += e.length;
    const auto width = [&](int face, double along) { // mm, of a facet beside an edge
        const auto p = size_t(facets.of[size_t(face)]);
        return (facets.faces[p] > 1 ? 1 : 2) * facets.area[p] / along;
    };
    const int count = int(bent.size());
    DisjointSets sets(static_cast<size_t>(count));
    for (const EdgeTurn& e : turns.edge) {
        if (bent[size_t(e.face)] != bent[size_t(e.twin)])
            continue;
        const double along = common[pair(e)];
        const bool together =
            bent[size_t(e.face)] ||
            (e.turn <= limits.sharp && e.turn <= most_curvature * std::min(width(e.face, along), width(e.twin, along)));
        if (together)
            sets.join(e.face, e.twin);
    }
    return numbered(sets, count);
}

/// Pieces with their areas and common boundaries, of which one after the other is given to a
/// neighbour.
class Merging {
public:
    Merging(const SheetTurns& turns, const std::vector<int>& piece, const std::vector<char>& bent)
        : piece_(piece), sets_(piece.size())
    {
        const auto count = size_t(*std::max_element(piece.begin(), piece.end()) + 1);
        area_.assign(count, 0);
        is_region_.assign(count, 0);
        border_.resize(count);
        for (size_t f = 0; f < piece.size(); ++f) {
            area_[size_t(piece[f])] += turns.area[Eigen::Index(f)];
            is_region_[size_t(piece[f])] = !bent[f];
        }
        for (const EdgeTurn& e : turns.edge) {
            const int p = piece[size_t(e.face)], q = piece[size_t(e.twin)];
            if (p == q)
                continue;
            border_[size_t(p)][q] += e.length;
            border_[size_t(q)][p] += e.length;
        }
    }

    size_t pieces() const { return area_.size(); }
    bool there(int p) { return sets_.root(p) == p; }
    double area(int p) const { return area_[size_t(p)]; }
    bool is_region(int p) const { return is_region_[size_t(p)]; }
    void make_region(int p) { is_region_[size_t(p)] = 1; }
    const std::map<int, double>& border(int p) const { return border_[size_t(p)]; }

    /// The neighbour with the longest common boundary; of equally long ones the larger.
    int likeliest(int p) const
    {
        int best = -1;
        double longest = 0;
        for (const auto& [q, length] : border(p))
            if (best < 0 || length > longest * (1 + 1e-9) || (length > longest * (1 - 1e-9) && area(q) > area(best))) {
                best = q;
                longest = length;
            }
        return best;
    }

    void give(int from, int to)
    {
        const bool region = is_region(to);
        const double sum = area(from) + area(to);
        sets_.join(from, to);
        const int kept = sets_.root(from), gone = kept == from ? to : from;
        for (const auto& [q, length] : border_[size_t(gone)]) {
            border_[size_t(q)].erase(gone);
            if (q == kept)
                continue;
            border_[size_t(kept)][q] += length;
            border_[size_t(q)][kept] = border_[size_t(kept)][q];
        }
        border_[size_t(gone)].clear();
        area_[size_t(kept)] = sum;
        is_region_[size_t(kept)] = region;
    }

    SheetPieces result()
    {
        DisjointSets faces(piece_.size());
        std::vector<int> first(pieces(), -1);
        for (size_t f = 0; f < piece_.size(); ++f) {
            int& one = first[size_t(sets_.root(piece_[f]))];
            if (one < 0)
                one = int(f);
            faces.join(one, int(f));
        }
        SheetPieces result{numbered(faces, int(piece_.size())), {}};
        result.is_region.resize(size_t(*std::max_element(result.piece.begin(), result.piece.end()) + 1));
        for (size_t f = 0; f < piece_.size(); ++f)
            result.is_region[size_t(result.piece[f])] = is_region_[size_t(sets_.root(piece_[f]))];
        return result;
    }

private:
    std::vector<int> piece_; ///< #F, as at first
    DisjointSets sets_;      ///< of pieces
    std::vector<double> area_;
    std::vector<char> is_region_;
    std::vector<std::map<int, double>> border_; ///< mm to each neighbour
};

/// Gives away, the smallest first, what is small and may be.
template <class May> void give_small(Merging& pieces, double least, const May& may)
{
    std::set<std::pair<double, int>> queue;
    const auto enqueue = [&](int p) {
        if (pieces.area(p) < least && !pieces.border(p).empty())
            queue.emplace(pieces.area(p), p);
    };
    for (size_t p = 0; p < pieces.pieces(); ++p)
        if (pieces.there(int(p)))
            enqueue(int(p));
    while (!queue.empty()) {
        const auto [area, p] = *queue.begin();
        queue.erase(queue.begin());
        if (!pieces.there(p) || pieces.area(p) != area || pieces.border(p).empty() || !may(p))
            continue;
        const int to = pieces.likeliest(p);
        pieces.give(p, to);
        enqueue(pieces.there(p) ? p : to);
    }
}

/// Neighbouring bends whose separation was given away are one network.
void join_bends(Merging& pieces)
{
    for (size_t p = 0; p < pieces.pieces(); ++p)
        for (bool again = true; again;) {
            again = false;
            if (!pieces.there(int(p)) || pieces.is_region(int(p)))
                break;
            for (const auto& [q, length] : pieces.border(int(p)))
                if (!pieces.is_region(q)) {
                    pieces.give(std::max(q, int(p)), std::min(q, int(p)));
                    again = true;
                    break;
                }
        }
}

} // namespace

SheetPieces sheet_pieces(const SheetTurns& turns, double side, const BendLimits& limits)
{
    constexpr double speck = 0.1; // even if it lies between two regions, which a sharp edge or
                                  // another bend separates
    const double most_curvature = limits.curvature / side,
                 least = limits.least_area * side * side * (turns.smoothed ? 5 : 1);
    const Facets flat = facets(turns, most_curvature);
    const std::vector<char> bent = bent_faces(turns, flat, most_curvature);
    Merging pieces(turns, first_pieces(turns, flat, bent, limits, most_curvature), bent);
    give_small(pieces, least, [&](int p) { return pieces.is_region(p); });
    join_bends(pieces);
    const auto regions_beside = [&](int p) {
        return std::count_if(pieces.border(p).begin(), pieces.border(p).end(),
                             [&](const auto& each) { return pieces.is_region(each.first); });
    };
    give_small(pieces, least, [&](int p) {
        return !pieces.is_region(p) && (regions_beside(p) < 2 || pieces.area(p) < speck * least);
    });
    for (size_t p = 0; p < pieces.pieces(); ++p) { // a long trough of one small radius is no bend
                                                   // of its borders
        if (!pieces.there(int(p)) || pieces.is_region(int(p)))
            continue;
        double beside = 0;
        for (const auto& [q, length] : pieces.border(int(p)))
            beside += pieces.is_region(q) ? pieces.area(q) : 0;
        if (pieces.area(int(p)) > beside)
            pieces.make_region(int(p));
    }
    return pieces.result();
}

} // namespace spia
