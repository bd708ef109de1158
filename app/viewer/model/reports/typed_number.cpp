#include "app/viewer/model/reports/typed_number.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/read_number.h"

namespace spia::viewer {
namespace {

/// Fortran's ways to leave out the letter of an exponent, or to write a d, are no way to type:
/// "1-3" may be meant as 1 to 3.
bool as_people_write(std::string_view text)
{
    for (size_t k = 0; k < text.size(); ++k) {
        const bool sign = text[k] == '+' || text[k] == '-', letter = text[k] == 'e' || text[k] == 'E';
        const bool digit = text[k] >= '0' && text[k] <= '9';
        if (!(digit || letter || text[k] == '.' || (sign && (k == 0 || text[k - 1] == 'e' || text[k - 1] == 'E'))))
            return false;
    }
    return true;
}

} // namespace

std::optional<double> typed_number_of(std::string_view text, std::initializer_list<std::string_view> units)
{
    text = trimmed(text);
    for (const std::string_view unit : units)
        if (!unit.empty() && text.ends_with(unit)) {
            text = trimmed(text.substr(0, text.size() - unit.size()));
            break;
        }
    std::string number(text);
    if (number.find('.') == number.npos && std::count(number.begin(), number.end(), ',') == 1)
        number[number.find(',')] = '.';
    return as_people_write(number) ? read_number(number) : std::nullopt;
}

std::string refused_number(std::string_view text, std::string_view field, std::string_view kept)
{
    const std::string_view name = field_name(field).name;
    return fmt::format("\"{}\" is not a number. {} stays {}.", trimmed(text), name.empty() ? "The value" : name, kept);
}

FieldName field_name(std::string_view label)
{
    const size_t comma = label.rfind(", ");
    return comma == label.npos ? FieldName{label, {}} : FieldName{label.substr(0, comma), label.substr(comma + 2)};
}

} // namespace spia::viewer
