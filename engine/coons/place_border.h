#pragma once
#include <vector>

#include "engine/coons/quad_grid.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/locate.h"

namespace spia
{

/// Puts the border nodes of a columns x rows grid on the four sides, evenly by length, and says where they
/// lie: a corner on its vertex, the others on boundary edges (one barycentric coordinate is exactly 0). Inner
/// nodes are left alone.
/// @param place one entry per node
void place_border(const FilledMesh& filled, const BlankBoundary& boundary, QuadGrid& grid,
                  std::vector<MeshPoint>& place);

} // namespace spia
