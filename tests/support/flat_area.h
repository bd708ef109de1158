#pragma once
#include <Eigen/Core>

namespace spia::shapes {

/// mm2, of counter-clockwise triangles in the plane; turned ones count below zero. @param position
/// 2 by #V; @param triangle 3 by #F
inline double flat_area(const Eigen::Matrix2Xd& position, const Eigen::Matrix3Xi& triangle)
{
    double sum = 0;
    for (Eigen::Index f = 0; f < triangle.cols(); ++f) {
        const Eigen::Vector2d p = position.col(triangle(1, f)) - position.col(triangle(0, f)),
                              q = position.col(triangle(2, f)) - position.col(triangle(0, f));
        sum += (p[0] * q[1] - p[1] * q[0]) / 2;
    }
    return sum;
}

} // namespace spia::shapes
