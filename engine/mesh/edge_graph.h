#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// The edges of a mesh as a graph of its vertices, with their lengths and the faces on both sides.
struct EdgeGraph {
    struct Edge {
        int low, high;  ///< vertices, low < high
        int face, twin; ///< the faces beside it; twin is -1 at the boundary
        double length;  ///< mm

        int other(int v) const { return v == low ? high : low; }
        bool boundary() const { return twin < 0; }
    };
    std::vector<Edge> edge;
    std::vector<int> first;   ///< #V + 1: the edges of vertex v are at[first[v]] .. at[first[v + 1]
                              ///< - 1]
    std::vector<int> at;      ///< edges, vertex by vertex
    std::vector<char> on_rim; ///< #V, 1 at the boundary

    int vertices() const { return int(on_rim.size()); }
    int find(int a, int b) const; ///< the edge between two vertices, -1 if there is none
};

/// @param mesh manifold: an edge has one face or two
EdgeGraph edge_graph(const TriMesh& mesh);

/// Shortest ways along the edges from the nearest of several vertices.
struct EdgePaths {
    std::vector<double> distance; ///< #V, mm; infinity where no way leads or the search had ended
    std::vector<int> edge;        ///< #V, the last edge of the way; -1 at the sources and where no
                                  ///< way leads
    int reached = -1;             ///< the target that ended the search
};

/// How long an edge is for the way along it.
enum class RimCost { as_long_as_it_is, none }; ///< none: along the boundary nothing has to be cut

/// Dijkstra 1959. Of several shortest ways the one that was found first, in the order of the
/// vertices.
/// @param target ends the search at the first vertex for which it is 1 (not a source); empty: goes
/// everywhere
EdgePaths shortest_paths(const EdgeGraph& graph, const std::vector<int>& sources, RimCost rim,
                         const std::vector<char>& target = {});

/// The vertices of the way to v, from its source on.
std::vector<int> path_to(const EdgeGraph& graph, const EdgePaths& paths, int v);

} // namespace spia
