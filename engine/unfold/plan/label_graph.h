#pragma once
#include <map>
#include <set>
#include <vector>

#include "engine/unfold/plan/bends.h"

namespace spia {

/// Which labels touch, by edges and by vertices.
struct LabelGraph {
    std::vector<std::map<int, double>> edge; ///< per label: its neighbours and the length of the
                                             ///< common border, mm
    std::vector<std::set<int>> vertex;       ///< per label: those with a vertex in common
};

/// #V: the labels of the faces around each vertex, ascending.
std::vector<std::vector<int>> labels_of_vertices(const TriMesh& part, const BendMap& map);

/// @param of_vertex labels_of_vertices()
LabelGraph label_graph(const TriMesh& part, const BendMap& map, const std::vector<std::vector<int>>& of_vertex);

/// How many regions away from the root each label is. Regions: by breadth first, bends cost
/// nothing. Bends: as the outer region beside them; a curled rim is one further out. @throws
/// InputError if the part is in several pieces
std::vector<int> depths(const BendMap& map, const LabelGraph& graph, int root);

/// Labels of at least this depth that touch each other, each group ascending.
std::vector<std::vector<int>> clusters(const LabelGraph& graph, const std::vector<int>& depth, int least);

} // namespace spia
