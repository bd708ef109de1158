#pragma once
#include <limits>

namespace spia {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace spia
