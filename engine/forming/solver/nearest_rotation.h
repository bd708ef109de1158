#pragma once
#include <Eigen/Core>
#include <cmath>

namespace spia {

/// Of the polar decomposition, also where det J < 0.
inline Eigen::Matrix2d nearest_rotation(const Eigen::Matrix2d& J)
{
    const double c = J(0, 0) + J(1, 1), s = J(1, 0) - J(0, 1), length = std::hypot(c, s);
    Eigen::Matrix2d R = Eigen::Matrix2d::Identity();
    if (length > 0)
        R << c / length, -s / length, s / length, c / length;
    return R;
}

} // namespace spia
