#include "engine/report/text/lengths.h"

#include <array>
#include <cmath>
#include <fmt/core.h>

#include "engine/report/text/number_text.h"
#include "engine/report/text/shown_lengths.h"

namespace spia {

std::string_view length_word(LengthUnit unit) { return unit == LengthUnit::inch ? "in" : name(unit); }

double shown_length(double mm, LengthUnit unit) { return mm / millimetres(unit); }

/// For texts; fields to type into keep what is typed.
static double displayed_length(double mm, LengthUnit unit)
{
    return std::abs(mm) < no_length ? 0 : shown_length(mm, unit);
}

double kept_length(double shown, LengthUnit unit) { return shown * millimetres(unit); }

ShownUnit as_shown(std::string_view unit, LengthUnit lengths)
{
    struct Power {
        std::string_view unit;
        int power;
        std::string_view before, behind;
    };
    constexpr std::array powers{Power{"mm", 1, "", ""}, Power{"mm\u00b2", 2, "", "\u00b2"}, Power{"1/mm", -1, "1/", ""},
                                Power{"1/mm\u00b2", -2, "1/", "\u00b2"}};
    for (const Power& each : powers)
        if (each.unit == unit) {
            double factor = 1;
            for (int k = 0; k < (each.power > 0 ? each.power : -each.power); ++k)
                factor = each.power > 0 ? factor / millimetres(lengths) : factor * millimetres(lengths);
            return {factor, fmt::format("{}{}{}", each.before, length_word(lengths), each.behind)};
        }
    return {1, std::string(unit)};
}

int more_decimals(LengthUnit unit) { return unit == LengthUnit::inch ? 2 : 0; }

std::string length_text(double mm, LengthUnit unit, int digits)
{
    return fmt::format("{:.{}g} {}", displayed_length(mm, unit), digits, length_word(unit));
}

std::string fixed_length(double mm, LengthUnit unit, int decimals, bool sign)
{
    const double value = displayed_length(mm, unit);
    decimals += more_decimals(unit);
    return sign ? fmt::format("{:+.{}f} {}", value, decimals, length_word(unit))
                : fmt::format("{:.{}f} {}", value, decimals, length_word(unit));
}

std::string thickness_text(double mm, LengthUnit unit)
{
    if (unit == LengthUnit::mm)
        return length_text(mm, unit, 6);
    constexpr int decimals = 4; // of an inch: gauges of sheet differ by some thousandths
    return fmt::format("{:.{}f} {}", displayed_length(mm, unit), decimals, length_word(unit));
}

std::string plain_length(double mm, LengthUnit unit)
{
    return fmt::format("{} {}", plain_number(displayed_length(mm, unit)), length_word(unit));
}

std::string size_text(double mm, double other_mm, LengthUnit unit)
{
    return fmt::format("{:.6g} x {:.6g} {}", displayed_length(mm, unit), displayed_length(other_mm, unit),
                       length_word(unit));
}

std::string in_unit(std::string_view label, LengthUnit unit) { return fmt::format("{}, {}", label, length_word(unit)); }

} // namespace spia
