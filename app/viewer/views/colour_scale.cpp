#include "app/viewer/views/colour_scale.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace spia::viewer {
namespace {

constexpr double round_steps[] = {1, 2, 2.5, 5};
constexpr double rounding = 1e-9; // of a step: an end that is that near to a round value is that value

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
    if (!(length > 1e-12 * std::max(std::abs(least), std::abs(greatest)))) // a single value gets a range around it
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

ColourScale field_scale(const FieldDisplay& display, const std::array<double, 2>& extremes)
{
    const bool diverging = info(display.field).diverging;
    ColourScale scale;
    scale.map = display.map.value_or(diverging ? ColourMap::diverging : ColourMap::viridis);
    scale.bands = display.bands;
    scale.isolines = display.isolines;
    if (display.range) {
        scale.least = float((*display.range)[0]);
        scale.greatest = float((*display.range)[1]);
        scale.ticks = display.bands > 0 ? display.bands : intervals_of((*display.range)[1] - (*display.range)[0]);
    } else {
        const RoundRange range = round_range(extremes[0], extremes[1], display.bands, diverging);
        scale.least = float(range.least);
        scale.greatest = float(range.greatest);
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
    return fmt::format("{:.4g}", value);
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
    const std::vector<double> values = tick_values(legend.scale);
    const int last = int(values.size()) - 1, every = (last + std::max(1, most - 1) - 1) / std::max(1, most - 1);
    std::vector<LegendTick> ticks;
    for (int k = 0; k <= last; ++k) {
        const bool fits = k % every == 0 && (k + every <= last || k == last); // the upper end is always told
        if (!fits && k != last)
            continue;
        const char* sign = k == 0 && legend.below ? "\u2264 " : k == last && legend.above ? "\u2265 " : "";
        ticks.push_back({double(k) / last, sign + tick_text(legend.scale, values[size_t(k)])});
    }
    return ticks;
}

std::string value_text(double value, std::string_view unit)
{
    std::string number;
    const double size = std::abs(value);
    if (!std::isfinite(value))
        return "no value";
    if (value == 0)
        number = "0";
    else if (size < 1e-4 || size >= 1e6)
        number = fmt::format("{:.2e}", value);
    else
        number = fmt::format("{:.{}f}", value, std::clamp(2 - int(std::floor(std::log10(size))), 0, 6));
    if (unit.empty())
        return number;
    return fmt::format("{}{}{}", number, unit == "\u00b0" ? "" : " ", unit);
}

} // namespace spia::viewer
