#pragma once
#include <Eigen/Core>
#include <span>
#include <string>

namespace spia {

/// "72.8335, -1.18748, 0" of a place in mm: six digits; what rounding leaves of zero, less than
/// 5e-5, is left out.
std::string place_text(const Eigen::Vector3d& place);

/// "1, 2, 3; 4, 5, 6": of eight at most, then "and 3 more".
std::string place_text(std::span<const Eigen::Vector3d> places);

} // namespace spia
