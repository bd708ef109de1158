#pragma once
#include <array>
#include <vector>

namespace spia {

/// A largest set of pairs in a graph: per node its partner or -1. Pairs are taken in the order of
/// the edges as far as they do not exclude each other, then alternating paths make them more.
/// [Edmonds 1965, blossoms]
/// @param edges  pairs of nodes, the dearest first
std::vector<int> largest_matching(int nodes, const std::vector<std::array<int, 2>>& edges);

} // namespace spia
