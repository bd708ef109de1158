#pragma once
#include <vector>

#include "engine/mesh/solid/skin.h"

namespace spia {

/// Where a vertex of a surface goes within the flat that it is on.
struct FlatMove {
    int vertex;
    Eigen::Vector3d to;     ///< mm
    Eigen::Vector3d normal; ///< unit, of the flat
};

/// Moves vertices within their flats. Where triangles would turn over, diagonals of the flat are
/// turned; if some turn over all the same, its vertices stay.
/// @returns the moves that were not made
std::vector<FlatMove> move_in_flats(SkinMesh& surface, const std::vector<FlatMove>& moves);

/// Moves straightened vertices that are still where they went to where they are wanted, if that is
/// certain and within their flat. What stays in `straightened` could not be moved.
void settle_in_flats(SkinMesh& middle);

} // namespace spia
