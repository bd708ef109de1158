#pragma once
#include <array>
#include <string>
#include <string_view>

#include "app/viewer/model/document.h"
#include "app/viewer/model/scene.h"

namespace spia::viewer {

/// A range with round ends, cut into intervals of one round length (1, 2, 2.5 or 5 times a power of ten) each.
struct RoundRange {
    double least = 0, greatest = 1;
    int intervals = 1;
};

/// The tightest such range that holds both values.
/// @param intervals  that many; 0: four to ten
/// @param about_zero  as far below 0 as above
RoundRange round_range(double least, double greatest, int intervals = 0, bool about_zero = false);

/// How a field is coloured on the part: the range, map and bands the user asked for; else a round range around all
/// values, symmetric about 0 where zero matters.
/// @param extremes the field's least and greatest value
ColourScale field_scale(const FieldDisplay& display, const std::array<double, 2>& extremes);

/// A value for people: three significant digits at least, no exponent within 1e-4 to 1e6, its unit behind it.
std::string value_text(double value, std::string_view unit);

} // namespace spia::viewer
