#include "app/viewer/views/colour_scale.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/report/figures/face_values.h"
#include "engine/report/text/number_text.h"
#include "engine/report/text/zone_look.h"

namespace spia::viewer {
namespace {

constexpr double round_steps[] = {1, 2, 2.5, 5};
constexpr double rounding = 1e-9; // of a step: an end that is that near to a round value is that
                                  // value

/// The smallest round length that is not below x > 0.
double round_up(double x)
{
    const double power = std::pow(10, std::floor(std::log10(x)));
    for (const double step : round_steps)
        if (step * power >= x * (1 - rounding))
            return step * power;
    return 10 * power;
}

bool is_round(double x) { return x > 0 && std::abs(round_up(x) / x - 1) < 1e-6; }

/// Intervals of a range that somebody has typed: round ones if there are some.
int intervals_of(double length)
{
    for (const int count : {8, 10, 7, 9, 6, 5, 4})
        if (is_round(length / count))
            return count;
    return 10;
}

} // namespace

RoundRange round_range(double least, double greatest, int intervals, bool about_zero)
{
    if (about_zero)
        greatest = std::max(std::abs(least), std::abs(greatest)), least = -greatest;
    double length = greatest - least;
    // a single value gets a range around it
    if (!(length > 1e-12 * std::max(std::abs(least), std::abs(greatest))))
        return about_zero || greatest == 0
                   ? RoundRange{about_zero ? -1. : 0., 1, intervals > 0 ? intervals : 4}
                   : round_range(least - std::abs(least) / 2, greatest + std::abs(least) / 2, intervals);
    constexpr int usual = 8;
    for (double step = round_up(length / (intervals > 0 ? intervals : usual));; step = round_up(1.01 * step)) {
        if (intervals > 0 && about_zero) {
            if (step * intervals >= length * (1 - rounding))
                return {-step * intervals / 2, step * intervals / 2, intervals};
            continue;
        }
        const double low = std::floor(least / step + rounding) * step,
                     high = std::ceil(greatest / step - rounding) * step;
        const int count = int(std::lround((high - low) / step));
        if (intervals == 0)
            return {low, high, count};
        if (count <= intervals)
            return {low, low + intervals * step, intervals};
    }
}

std::vector<double> axis_numbers(const RoundRange& range, int most)
{
    const double step = (range.greatest - range.least) / range.intervals;
    std::vector<double> numbers;
    for (int every = 1; every <= std::max(1, range.intervals); ++every) {
        if (!is_round(every * step))
            continue;
        numbers.clear();
        const double first = std::ceil(range.least / (every * step) - 1e-6),
                     last = std::floor(range.greatest / (every * step) + 1e-6);
        for (double k = first; k <= last; ++k)
            numbers.push_back(k * every * step + 0.); // whole steps from 0
        if (int(numbers.size()) <= most)
            break;
    }
    return numbers;
}

double least_range(Field field, double size) { return noise(field, size); }

/// The values, or a range around them that is long enough to be coloured.
static std::array<double, 2> lengthened(const FieldDisplay& display, const std::array<double, 2>& extremes, double size)
{
    const double shortest = least_range(display.field, size), missing = shortest - (extremes[1] - extremes[0]);
    if (!(missing > 0))
        return extremes;
    if ((info(display.field).diverging || display.difference) &&
        std::max(std::abs(extremes[0]), std::abs(extremes[1])) < shortest)
        return {-shortest, shortest};
    if (extremes[0] >= 0 && extremes[1] < shortest)
        return {0, shortest};
    return {extremes[0] - missing / 2, extremes[1] + missing / 2};
}

std::string noise_note(const FieldDisplay& display, const std::array<double, 2>& extremes, double size, double shown)
{
    if (display.range || lengthened(display, extremes, size) == extremes)
        return "";
    return fmt::format("uniform within {:.2g}", shown * least_range(display.field, size));
}

ColourScale field_scale(const FieldDisplay& display, const std::array<double, 2>& extremes, double size, double shown)
{
    const bool diverging = info(display.field).diverging || display.difference;
    ColourScale scale;
    scale.shown = shown;
    if (display.field == Field::zone) { // a colour for each
        scale.map = ColourMap::zones;
        scale.least = -0.5f, scale.greatest = float(zone_count) - 0.5f;
        scale.bands = scale.ticks = zone_count;
        return scale;
    }
    scale.map = display.map.value_or(diverging                                ? ColourMap::diverging
                                     : display.field == Field::limit_distance ? ColourMap::quality
                                                                              : ColourMap::viridis);
    scale.bands = display.bands;
    scale.isolines = display.isolines;
    if (display.range) {
        scale.least = float((*display.range)[0]);
        scale.greatest = float((*display.range)[1]);
        scale.ticks =
            display.bands > 0 ? display.bands : intervals_of(shown * ((*display.range)[1] - (*display.range)[0]));
    } else {
        const auto [low, high] = lengthened(display, extremes, size);
        const RoundRange range = round_range(shown * low, shown * high, display.bands, diverging);
        scale.least = float(range.least / shown);
        scale.greatest = float(range.greatest / shown);
        scale.ticks = range.intervals;
    }
    return scale;
}

std::vector<double> tick_values(const ColourScale& scale)
{
    const int count = std::max(1, scale.bands > 0 ? scale.bands : scale.ticks);
    const double length = double(scale.greatest) - double(scale.least);
    std::vector<double> values;
    for (int k = 0; k <= count; ++k)
        values.push_back(double(scale.least) + k * length / count);
    return values;
}

std::string tick_text(const ColourScale& scale, double value)
{
    if (std::abs(value) < 1e-6 * (double(scale.greatest) - double(scale.least)))
        value = 0; // a remainder of single precision
    const double step = (double(scale.greatest) - double(scale.least)) / std::max(1, scale.ticks);
    const double places = std::abs(value) > 0 && step > 0 ? std::log10(std::abs(value) / step) : 0;
    return fmt::format("{:.{}g}", scale.shown * value, std::clamp(int(std::ceil(places)) + 1, 4, 9));
}

bool below(const ColourScale& scale, double value)
{
    return value < double(scale.least) - 1e-4 * (double(scale.greatest) - double(scale.least));
}

bool above(const ColourScale& scale, double value)
{
    return value > double(scale.greatest) + 1e-4 * (double(scale.greatest) - double(scale.least));
}

std::vector<LegendTick> legend_ticks(const SceneLegend& legend, int most)
{
    if (legend.scale.map == ColourMap::zones) {
        std::vector<LegendTick> names;
        for (int k = 0; k < zone_count; ++k)
            names.push_back({(k + 0.5) / zone_count, zone_words(Zone(k))});
        return names;
    }
    const std::vector<double> values = tick_values(legend.scale);
    const int last = int(values.size()) - 1;
    const auto zero = std::find_if(values.begin(), values.end(), [&](double value) {
        return std::abs(value) < 1e-6 * (values.back() - values.front());
    });
    const int middle = zero == values.end() ? -1 : int(zero - values.begin());
    std::vector<LegendTick> ticks;
    for (int every = 1; every <= last + 1; ++every) { // the closest row with both ends and zero
                                                      // that there is room for
        ticks.clear();
        for (int k = 0; k <= last; ++k) {
            const bool end = k == 0 || k == last, in_row = (k - std::max(middle, 0)) % every == 0,
                       crowded = 2 * std::min(k, last - k) < every; // covers the text of an end
            if (!end && !(k == middle && every <= last) && (!in_row || crowded))
                continue;
            const char* sign = k == 0 && legend.below ? "\u2264 " : k == last && legend.above ? "\u2265 " : "";
            ticks.push_back({double(k) / last, sign + tick_text(legend.scale, values[size_t(k)])});
        }
        if (int(ticks.size()) <= most)
            break;
    }
    return ticks;
}

std::string value_text(double value, std::string_view unit, LengthUnit lengths)
{
    if (!std::isfinite(value))
        return "no value";
    if (unit == info(Field::zone).unit)
        return zone_words(Zone(std::clamp(int(std::lround(value)), 0, zone_count - 1)));
    if (unit == "%") // one precision wherever it is said
        return figure_text(value, 1) + " %";
    const ShownUnit as = as_shown(unit, lengths);
    const std::string number = plain_number(as.factor * value);
    if (unit.empty())
        return number;
    return fmt::format("{}{}{}", number, unit == "\u00b0" ? "" : " ", as.unit);
}

} // namespace spia::viewer
