#pragma once
#include <string>
#include <string_view>

#include "engine/core/length_unit.h"

/// Lengths on the screen. Inside the program, in projects, scripts and reports of the state they
/// are mm throughout; what people read and type is in the unit of their preferences, mm or inch,
/// and comes from here. Files that are exported have units of their own.
namespace spia {

/// "mm" or "in".
std::string_view length_word(LengthUnit unit);
double shown_length(double mm, LengthUnit unit);
double kept_length(double shown, LengthUnit unit); ///< mm of what was typed

/// A quantity with the unit behind it, e.g. "mm", "mm²", "1/mm", "1/mm²"; those without a length in
/// them stay as they are.
struct ShownUnit {
    double factor = 1; ///< shown value = factor * value
    std::string unit;
};
ShownUnit as_shown(std::string_view unit, LengthUnit lengths);

/// So many decimals more has a length in inch, to be as fine as in mm.
int more_decimals(LengthUnit unit);

/// "12.34 mm", "0.4858 in".
/// @param digits  significant ones
std::string length_text(double mm, LengthUnit unit, int digits = 4);
/// @param decimals  of mm; see more_decimals()
std::string fixed_length(double mm, LengthUnit unit, int decimals, bool sign = false);
/// Of a sheet, so fine that gauges stay apart: "0.8 mm", "0.0315 in".
std::string thickness_text(double mm, LengthUnit unit);
/// Three significant digits at least, no exponent; see plain_number().
std::string plain_length(double mm, LengthUnit unit);
/// "12.3 x 45.6 mm"
std::string size_text(double mm, double other_mm, LengthUnit unit);

/// "Thickness, mm": what a field to type a length into is called.
std::string in_unit(std::string_view label, LengthUnit unit);

} // namespace spia
