#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace spia {

std::string_view trimmed(std::string_view text);           ///< without blanks and tabs at both ends
bool same_letters(std::string_view a, std::string_view b); ///< equal but for the case of ASCII
                                                           ///< letters

/// A number as Fortran programs write it: also 1.5D-3, and 1.5-3 and 1.+5 without a letter. In any
/// locale; blanks around it are skipped. Nothing if it is no number, or not finite.
std::optional<double> read_number(std::string_view field);

/// A whole number; "12." and "12.0" are whole as well. Nothing if it is none or does not fit.
std::optional<std::int64_t> read_whole_number(std::string_view field);

/// Exactly the first if all are the same, which a sum divided by their number is not. @param values
/// at least one
double mean(std::span<const double> values);

} // namespace spia
