#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Turned so that the box around the blank is the smallest with a side along an edge of the outline; the longer side is x.
/// @param outline vertices of the outer loop in order
Eigen::Matrix2Xd upright(const std::vector<int>& outline, const Eigen::Matrix2Xd& flat);

} // namespace spia
