#pragma once
#include <Eigen/Core>

namespace spia {

/// On which side of the line from a to b the point c lies: 1 to the left (a, b, c
/// counter-clockwise), -1 to the right, 0 on it, exactly, whatever the rounding. The sign of the
/// determinant is taken from its floating-point value where that exceeds the bound of its error,
/// else from its exact value as a sum of doubles that do not overlap. [Shewchuk 1997] Exact while
/// no product of two coordinates over- or underflows: sizes from 1e-140 to 1e140 are safe. 0 if a
/// coordinate is not finite.
int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

} // namespace spia
