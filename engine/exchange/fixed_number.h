#pragma once
#include <cstdint>
#include <string>

namespace spia {

/// A number for a column of a solver deck, set to its right: all digits where they fit, else as many as fit. Has a decimal point,
/// for Fortran and Nastran take "12" for something else than "12.".
/// Significant digits that always fit, with sign and an exponent of two digits: width - 6; the relative error is at most half of
/// 10^(7 - width): 5e-10 in 16 columns, 5e-14 in 20, 5e-4 in 10.
/// @param width  9 columns at least
/// @throws InputError if it is not finite
std::string fixed_number(double value, int width);

/// A whole number for a column. @throws InputError if it does not fit
std::string fixed_number(std::int64_t value, int width);
inline std::string fixed_number(int value, int width) { return fixed_number(std::int64_t(value), width); }

} // namespace spia
