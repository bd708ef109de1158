#pragma once
#include <vector>

#include "engine/mesh/edge_graph.h"

namespace spia {

/// Edges along which a part with handles is cut so that it has none: a short cut graph. From one
/// base the greedy system of loops is the shortest there is [Erickson and Whittlesey 2005]: tree of
/// shortest paths, longest cotree, and two edges per handle that are in neither. Bases are the
/// boundary loops and vertices spread over the part, the shortest graph is taken. Going along a
/// boundary costs nothing: there the part is open already.
/// @param loops of the part; none: it is closed
/// @param triangles number of faces @param genus number of handles, at least 1
/// @returns edges of the graph, rising
std::vector<int> handle_cut(const EdgeGraph& graph, const std::vector<std::vector<int>>& loops, int triangles,
                            int genus);

} // namespace spia
