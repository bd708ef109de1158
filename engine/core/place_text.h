#pragma once
#include <Eigen/Core>
#include <string>

namespace spia {

/// "72.8335, -1.18748, 0" of a place in mm: six digits; what rounding leaves of zero, less than
/// 5e-5, is left out.
std::string place_text(const Eigen::Vector3d& place);

} // namespace spia
