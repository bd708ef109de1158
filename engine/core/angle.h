#pragma once

#include <numbers>

namespace spia {

inline constexpr double radians_per_degree = std::numbers::pi / 180, degrees_per_radian = 180 / std::numbers::pi;
inline constexpr double full_turn = 2 * std::numbers::pi; ///< radians

} // namespace spia
