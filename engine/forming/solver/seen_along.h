#pragma once
#include "engine/forming/solver/stamping_direction.h"

namespace spia {

/// What a given direction is for a part, turned so that it lies on the outer side of most of its
/// area: seen from the inner side a mirrored blank would be wanted.
/// @param direction of any length above 0
StampingDirection seen_along(const TriMesh& part, const Eigen::Vector3d& direction);

} // namespace spia
