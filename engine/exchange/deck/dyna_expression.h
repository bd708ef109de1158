#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace spia {

/// What an algebraic expression of *PARAMETER_EXPRESSION comes to: numbers, names of parameters
/// ("a" or "&a"), + - * / ** and parentheses, and the functions of FORTRAN that LS-DYNA knows. All
/// in floating point: 3/2 is 1.5.
/// @param value  the text that a name stands for, in small letters; nothing: it is not known
/// @returns nothing if it is no such expression, a name in it has no number, or it is not finite
std::optional<double> dyna_expression(std::string_view text,
                                      const std::function<std::optional<std::string>(const std::string&)>& value);

} // namespace spia
