#pragma once
#include <vector>

#include "engine/layout/simplify/layout_mesh.h"

namespace spia {

/// Moves vertices, one after the other, to where the faces around them cost least: free ones in the
/// plane, sliding ones along their arc between their neighbours [pattern search].
/// @param sweeps  over all of them
/// @param guard   quality below which no face comes, nor gets worse
void relax(LayoutMesh& mesh, const std::vector<int>& vertices, int sweeps, double guard);

/// All vertices.
void relax_all(LayoutMesh& mesh, int sweeps, double guard);

} // namespace spia
