#pragma once
#include <Eigen/Core>

namespace spia {

/// Whether a point is in a closed polygon, 2 by n (even-odd; on the border either). Exact
/// (orient2d.h).
bool inside_polygon(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& point);

} // namespace spia
