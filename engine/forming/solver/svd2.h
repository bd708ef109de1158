#pragma once
#include <Eigen/Core>

namespace spia {

/// G = U diag(s) V^T with rotations U and V, s_1 >= s_2; s_2 has the sign of det G. Of an inverse
/// deformation gradient: the logarithmic strains of forming are -ln s, so s_2 belongs to the major
/// strain.
struct Svd2 {
    Eigen::Matrix2d U, V;
    Eigen::Vector2d s;
};
Svd2 svd(const Eigen::Matrix2d& G);

} // namespace spia
