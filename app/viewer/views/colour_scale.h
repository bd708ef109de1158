#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "app/viewer/model/document/document.h"
#include "app/viewer/model/document/scene.h"
#include "engine/report/text/lengths.h"

namespace spia::viewer {

/// A range with round ends, cut into intervals of one round length (1, 2, 2.5 or 5 times a power of
/// ten) each.
struct RoundRange {
    double least = 0, greatest = 1;
    int intervals = 1;
};

/// The tightest such range that holds both values.
/// @param intervals  that many; 0: four to ten
/// @param about_zero  as far below 0 as above
RoundRange round_range(double least, double greatest, int intervals = 0, bool about_zero = false);

/// The values of a range that numbers are written at: round ones a round step (1, 2, 2.5 or 5 times
/// a power of ten) apart, with 0 among them where the range has it.
/// @param most  how many there is room for, 2 at least
std::vector<double> axis_numbers(const RoundRange& range, int most);

/// The shortest range that a field is coloured over, in its unit: values that differ by less are
/// noise(), and colours would make a landscape of it.
/// @param size of the part, mm
double least_range(Field field, double size);

/// How a field is coloured on the part: the range, map and bands the user asked for; else a round
/// range around all values, symmetric about 0 where zero matters, and no shorter than
/// least_range().
/// @param extremes the field's least and greatest value
/// @param size     of the part, mm
/// @param shown    see ColourScale: the values that are written are round
ColourScale field_scale(const FieldDisplay& display, const std::array<double, 2>& extremes, double size = 0,
                        double shown = 1);

/// What a legend says under its title where the values are nearer to each other than the least
/// range; else empty.
std::string noise_note(const FieldDisplay& display, const std::array<double, 2>& extremes, double size,
                       double shown = 1);

/// A value written beside the colours of a scale.
struct LegendTick {
    double share = 0; ///< of the scale's length, from its lower end
    std::string text; ///< e.g. "0.25"; at an end with values beyond it "\u2264 0" or "\u2265 0.25"
};

/// Ticks of a legend from below, its ends among them.
/// @param most  how many there is room for, 2 at least
std::vector<LegendTick> legend_ticks(const SceneLegend& legend, int most);

/// The value of a tick or an isoline: no digits that mean nothing.
std::string tick_text(const ColourScale& scale, double value);

/// Where the ticks are, and the isolines if there are any; from below.
std::vector<double> tick_values(const ColourScale& scale);

/// Whether a value lies beyond the ends of a scale by more than the eye could tell.
bool below(const ColourScale& scale, double value);
bool above(const ColourScale& scale, double value);

/// A value for people: three significant digits at least, no exponent within 1e-4 to 1e6, its unit
/// behind it.
/// @param lengths  what a unit with mm in it is shown in
std::string value_text(double value, std::string_view unit, LengthUnit lengths = LengthUnit::mm);

} // namespace spia::viewer
