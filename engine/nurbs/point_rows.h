#pragma once
#include <Eigen/Core>

namespace spia {

/// A tensor grid of points (i, j), i fastest, with i and j exchanged. @param count_u number of
/// values of i
inline Eigen::Matrix3Xd transposed(const Eigen::Matrix3Xd& points, int count_u)
{
    const int count_v = int(points.cols()) / count_u;
    Eigen::Matrix3Xd result(3, points.cols());
    for (int j = 0; j < count_v; ++j)
        for (int i = 0; i < count_u; ++i)
            result.col(j + Eigen::Index(i) * count_v) = points.col(i + Eigen::Index(j) * count_u);
    return result;
}

} // namespace spia
