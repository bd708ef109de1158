#pragma once
#include <Eigen/Core>

namespace spia {

/// Where lines lie that are close together where a weight is large: a share of them is dealt out by
/// the weight, the others evenly, and the spacing of neighbours differs by a factor of at most
/// `growth`.
/// @param weight  over intervals of equal length, not negative; of no one: evenly
/// @param share   of the lines that the weight deals out, 0 to 1
/// @param growth  above 1
/// @return intervals + 1 places rising from 0 to 1
Eigen::VectorXd graded_lines(const Eigen::VectorXd& weight, int intervals, double share, double growth = 1.5);

} // namespace spia
