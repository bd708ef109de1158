#pragma once
#include <array>
#include <string>

namespace spia {

/// A number with so many decimals; what is nothing when rounded is "0", without a sign.
std::string figure_text(double value, int decimals, bool sign = false);

/// Three significant digits at least and no exponent within 1e-4 to 1e6: 0.0123, 12.3, 1380.
std::string plain_number(double value);

/// Of two shares in percent: "-25.1 to 23.6 %", "0 to 1.2 %", "0 %".
std::string percent_range(const std::array<double, 2>& share);

} // namespace spia
