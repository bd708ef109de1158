#pragma once
#include <Eigen/Core>
#include <vector>

namespace spia {

/// Weights of the first (last) `count` points of a curve whose sum is the derivative at its first
/// (last) parameter: that of the polynomial through them, of order count - 1. Entry k belongs to
/// point k (to point size - 1 - k).
/// @param parameters  strictly rising; at least `count` of them, count >= 2 [Fornberg 1988, Math.
/// Comp. 51]
Eigen::VectorXd end_derivative_weights(const std::vector<double>& parameters, int count, bool at_start);

} // namespace spia
