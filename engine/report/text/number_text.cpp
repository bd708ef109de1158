#include "engine/report/text/number_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace spia {

std::string figure_text(double value, int decimals, bool sign)
{
    if (std::abs(value) < 0.5 * std::pow(10., -decimals))
        return "0";
    return sign ? fmt::format("{:+.{}f}", value, decimals) : fmt::format("{:.{}f}", value, decimals);
}

std::string plain_number(double value)
{
    constexpr double rounding = 1e-9; // 1 less a rounding error has the digits of 1
    const double size = std::abs(value);
    if (value == 0)
        return "0";
    if (size < 1e-4 || size >= 1e6)
        return fmt::format("{:.2e}", value);
    return fmt::format("{:.{}f}", value, std::clamp(2 - int(std::floor(std::log10(size) + rounding)), 0, 6));
}

std::string percent_range(const std::array<double, 2>& share)
{
    const std::string least = figure_text(100 * share[0], 1), greatest = figure_text(100 * share[1], 1);
    return least == greatest ? least + " %" : fmt::format("{} to {} %", least, greatest);
}

} // namespace spia
