#pragma once
#include <Eigen/Geometry>
#include <algorithm>

namespace spia {

/// The smallest rotation that takes unit vector `from` to unit vector `to`, applied to v. Where
/// they are opposite (a sheet folded flat on itself) the turn is not unique; the guarded divisor
/// then picks none in particular.
inline Eigen::Vector3d smallest_turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& v)
{
    const Eigen::Vector3d w = from.cross(to);
    const double divisor = std::max(1 + from.dot(to), 1e-6);
    return v + w.cross(v) + w.cross(w.cross(v)) / divisor;
}

} // namespace spia
