#pragma once
#include <Eigen/Geometry>
#include <cmath>

namespace spia {

/// Of two vectors of the plane: the area of the parallelogram that they span, positive if b is to
/// the left of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Radians between two vectors of space, 0 to pi.
inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace spia
