#pragma once
#include <Eigen/Core>

namespace spia {

/// Radians from direction a to direction b, counter-clockwise: 0 to 2 pi.
double turn_to(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// From a point to the nearest one of a segment.
double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Whether two closed segments have a point in common. Exact (orient2d.h).
bool segments_meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   const Eigen::Vector2d& d);

/// Whether the direction from v to q runs into the inside of a corner whose border comes from
/// `before` and goes on to `after` with the inside on its left; along the border itself is not
/// inside. Exact.
bool leads_inside(const Eigen::Vector2d& before, const Eigen::Vector2d& v, const Eigen::Vector2d& after,
                  const Eigen::Vector2d& q);

} // namespace spia
