#pragma once
#include <cstdint>
#include <string>

namespace spia {

/// A number for a column of a solver deck, set to its right: all digits where they fit, else as
/// many as fit. Has a decimal point, for Fortran and Nastran take "12" for something else than
/// "12.".
/// The first column stays blank, for programs that cut at blanks. Significant digits that always
/// fit, with sign and an exponent of two digits: width - 7; so the relative error is at most half
/// of 10^(8 - width): 5e-9 in 16 columns, 5e-13 in 20. Numbers from 1 to 9999 have 10^4 times less.
/// @param width  10 columns at least
/// @throws InputError if it is not finite
std::string fixed_number(double value, int width);

/// A whole number for a column. @throws InputError if it does not fit
std::string fixed_number(std::int64_t value, int width);
inline std::string fixed_number(int value, int width) { return fixed_number(std::int64_t(value), width); }

} // namespace spia
