#pragma once
#include "engine/mesh/solid/stated_surface.h"

namespace spia {

/// mm, to a place from the axis of a cylinder, square to it.
inline Eigen::Vector3d off_axis(const StatedSurface& cylinder, const Eigen::Vector3d& place)
{
    const Eigen::Vector3d from = place - cylinder.point;
    return from - from.dot(cylinder.direction) * cylinder.direction;
}

} // namespace spia
