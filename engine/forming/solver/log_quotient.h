#pragma once
#include <cmath>

namespace spia {

/// ln(x/y) / (x - y) for x >= y > 0, exact also where both are equal.
inline double log_difference_quotient(double x, double y)
{
    const double relative = (x - y) / y;
    return relative < 1e-12 ? 1 / y : std::log1p(relative) / (relative * y);
}

} // namespace spia
