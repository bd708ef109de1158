#pragma once
#include <Eigen/Core>

namespace spia {

/// How far vertices may lie off their places because of the few digits that a file has of them: by
/// half a step along each axis. A step is the largest of those that all coordinates agree with: the
/// greatest power of ten of which they are multiples, the last of the fewest significant digits
/// that they have, and the spacing of single precision, in which they may have been kept before
/// they were written.
/// @param position  mm
/// @param unit  mm, of the file
/// @returns mm; 0 where the coordinates have more digits than single precision
double coordinate_rounding(const Eigen::Matrix3Xd& position, double unit);

} // namespace spia
