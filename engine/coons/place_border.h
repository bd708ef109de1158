#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/coons/quad_grid.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/locate.h"

namespace spia {

/// Per side, counter-clockwise, the chord-length parameters of its border nodes: from 0 to 1,
/// rising.
using BorderParameters = std::array<Eigen::VectorXd, 4>;

/// Nodes that divide each side into cells of equal length.
BorderParameters even_border(int columns, int rows);

/// Nodes that slide along their sides until their polygon turns as little as a compromise with even
/// spacing allows: it then skips notches and spikes that are smaller than `reach`, in which even
/// nodes would make it loop. The least of tan^2(turn / 2) + (length / cell - 1)^2 over 31 places
/// per node, by dynamic programming.
/// @param reach how far a node may slide either way, in cells
BorderParameters slid_border(const FilledMesh& filled, const BlankBoundary& boundary, int columns, int rows,
                             double reach);

/// Puts the border nodes of a grid on the four sides and says where they lie: a corner on its
/// vertex, the others on boundary edges (one barycentric coordinate is exactly 0). Inner nodes are
/// left alone.
/// @param place one entry per node
void place_border(const FilledMesh& filled, const BlankBoundary& boundary, const BorderParameters& parameters,
                  QuadGrid& grid, std::vector<MeshPoint>& place);

} // namespace spia
