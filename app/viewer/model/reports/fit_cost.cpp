#include "app/viewer/model/reports/fit_cost.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace spia::viewer {

std::string fit_cost(int triangles)
{
    // The slowest of 0.5, 0.1 and 0.02 mm on a core of a server of 2024
    // (tests/bench/cancel_gaps.cpp): 25 s of panel, fender and channel of 2,000 to 5,000 triangles,
    // 57 s of a panel of 100,000. A smooth part takes a tenth of it.
    constexpr double seconds_at_5000 = 25, growth = 0.28;
    const double seconds = seconds_at_5000 * std::pow(std::max(triangles, 1000) / 5000., growth);
    const std::string time = seconds < 55 ? fmt::format("{:.0f} s", 10 * std::ceil(seconds / 10))
                                          : fmt::format("{:.0f} min", std::ceil(seconds / 60));
    return fmt::format("Takes seconds on a smooth part, up to about {} on a part with many details. Esc cancels.",
                       time);
}

} // namespace spia::viewer
