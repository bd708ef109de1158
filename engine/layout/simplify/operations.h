#pragma once
#include <optional>
#include <vector>

#include "engine/layout/simplify/layout_mesh.h"

namespace spia {

/// Operations of quad meshes [Daniels et al. 2008; Tarini et al. 2010] that take faces away or turn
/// them. Each edits the mesh within begin() and returns whether it was possible; where it was not,
/// the mesh may be half edited and has to be undone. Whether what comes out is sound() is the
/// caller's question, too.

/// Makes corners k and k + 2 of a face one: two patches fewer at a vertex each, one fewer in all.
bool collapse_diagonal(LayoutMesh& mesh, int face, int k);

/// Takes a free vertex with two faces away: these become one.
bool remove_doublet(LayoutMesh& mesh, int vertex);

/// A row of faces that share opposite sides, its rungs, from border to border or around.
struct QuadStrip {
    std::vector<int> face;
    std::vector<std::array<int, 2>> rung; ///< vertices: [0] on one rail, [1] on the other
};

/// The strip that passes side k of a face.
QuadStrip strip_of(const LayoutMesh& mesh, int face, int k);

/// All strips, each once, the longest first.
std::vector<QuadStrip> strips_of(const LayoutMesh& mesh);

/// Shrinks all rungs of a strip to a vertex each: its faces go.
bool collapse_strip(LayoutMesh& mesh, const QuadStrip& strip);

/// Turns side k of a face within the hexagon of the two faces at it.
/// @param forward  to the next pair of opposite vertices, else to the one before
bool rotate_side(LayoutMesh& mesh, int face, int k, bool forward);

} // namespace spia
