#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/doctor/surface_triangles.h"

namespace spia {

/// Which piece of sheet each triangle belongs to.
struct Pieces {
    std::vector<int> of; ///< per triangle; pieces count from 0 in the order of their first triangle
    int count = 0;
    int largest = -1; ///< by area
};

/// Pieces that hang together by edges. At an edge of more than two faces the sheet goes on only
/// between the two that continue each other most smoothly, so that a rib or a second layer is a
/// piece of its own.
Pieces smooth_pieces(const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& position);

} // namespace spia
