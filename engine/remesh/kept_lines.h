#pragma once
#include <span>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Edges of a mesh that a remesh must not move across: its boundary, sharp edges, borders between
/// faces of different labels, and the ridges of bends that were divided coarsely into strips:
/// triangles across those would bend a sheet that is developable.
struct KeptLines {
    /// Rows of vertices from corner to corner; a closed line without a corner begins and ends at
    /// its smallest vertex.
    std::vector<std::vector<int>> line;
    std::vector<char> corner;  ///< #V, 1 where lines end, meet or turn: such a vertex stays
    std::vector<char> on_line; ///< #V, 1 at every vertex of a line
    std::vector<char> edge;    ///< per edge of edge_graph(), 0: not kept, 1: kept, 2: as a ridge
};

/// @param label  per face; empty: all the same
/// @param angle  radians; an edge is sharp where the normals of its faces differ by more, and a
///         line has a corner where it turns by more
/// @param ridge  radians; an edge whose faces differ by more is kept if such edges follow each
///         other without a fork and the faces beside it are at least 0.4 of the size wide
/// @param size   mm, of edges to come; a line with a loose end that is shorter than that is not
///         kept
KeptLines kept_lines(const TriMesh& mesh, std::span<const int> label, double angle, double ridge, double size);

} // namespace spia
