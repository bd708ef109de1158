#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/soup.h"

namespace spia {

/// Which vertices are one and the same point.
struct Weld {
    std::vector<int> same_as; ///< #V, the first vertex of its place; same_as[v] <= v and
                              ///< same_as[same_as[v]] == same_as[v]
    int exact = 0;            ///< vertices joined because all three coordinates are equal
    int near = 0;             ///< vertices joined across a gap
    double widest = 0;        ///< mm, the widest gap that was closed
};

/// Finds vertices with equal coordinates and, among those on open edges, vertices closer than the
/// tolerance, the closest first. Two corners of one polygon are never joined across a gap, so no
/// edge collapses however short it is.
/// @param tolerance  mm; 0 joins equal coordinates only
/// The soup's indices must be in range and its coordinates finite.
Weld weld(const PolygonSoup& soup, double tolerance);

/// Open edges that lie so close to others that they seem to be the same: of a sheet in two pieces
/// with rounded coordinates, say.
struct Cracks {
    std::vector<int> vertex; ///< along them, in increasing order
    double widest = 0;       ///< mm
    double tolerance = 0;    ///< mm, that closes them all: `widest`, rounded up to two digits
};

/// Looks for gaps narrower than 2 % of the shortest open edge at both of their ends, between
/// vertices or from a vertex to the inside of an edge (with_corners()); those that would join no
/// edges do not count.
/// @param same_as  as weld() gave it, or all themselves
/// @returns nothing where there are none
std::optional<Cracks> find_cracks(const PolygonSoup& soup, const std::vector<int>& same_as);

} // namespace spia
