#pragma once
#include <vector>

#include "engine/mesh/soup.h"

namespace spia {

/// Which vertices are one and the same point.
struct Weld {
    std::vector<int>
        same_as;       ///< #V, the first vertex of its place; same_as[v] <= v and same_as[same_as[v]] == same_as[v]
    int exact = 0;     ///< vertices joined because all three coordinates are equal
    int near = 0;      ///< vertices joined across a gap
    double widest = 0; ///< mm, the widest gap that was closed
};

/// Finds vertices with equal coordinates and, among those on open edges, vertices closer than the tolerance,
/// the closest first. Two corners of one polygon are never joined across a gap, so no edge collapses however
/// short it is.
/// @param tolerance  mm; 0 joins equal coordinates only
/// The soup's indices must be in range and its coordinates finite.
Weld weld(const PolygonSoup& soup, double tolerance);

} // namespace spia
