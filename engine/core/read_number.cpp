#include "engine/core/read_number.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace spia {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

/// The readers of the library take a minus only. "+-1" is left as it is, and is no number.
std::string_view without_plus(std::string_view field)
{
    return field.size() > 1 && field[0] == '+' && field[1] != '-' ? field.substr(1) : field;
}

/// Too small is zero, too large is nothing.
std::optional<double> from_text(const char* begin, const char* end)
{
    double value = 0;
    const auto [rest, problem] = std::from_chars(begin, end, value);
    if (rest != end)
        return std::nullopt;
    if (problem == std::errc())
        return value;
    const char* exponent = std::find_if(begin, end, [](char c) { return lower(c) == 'e'; });
    if (problem == std::errc::result_out_of_range && end - exponent > 1 && exponent[1] == '-')
        return 0;
    return std::nullopt;
}

} // namespace

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && is_blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back()))
        text.remove_suffix(1);
    return text;
}

bool same_letters(std::string_view a, std::string_view b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::optional<double> read_number(std::string_view field)
{
    field = without_plus(trimmed(field));
    const size_t first = field.empty() || field.front() != '-' ? 0 : 1;
    if (first >= field.size() || !(is_digit(field[first]) || field[first] == '.'))
        return std::nullopt; // "inf" and "nan" as well
    const char *begin = field.data(), *end = begin + field.size();
    double value = 0;
    const auto [rest, problem] = std::from_chars(begin, end, value);
    if (rest == end && problem == std::errc())
        return value;
    if (rest == end || lower(*rest) == 'e')
        return from_text(begin, end);
    std::array<char, 64> text; // with the letter that Fortran needs not
    if (rest == begin || field.size() + 1 > text.size() || (lower(*rest) != 'd' && *rest != '+' && *rest != '-'))
        return std::nullopt;
    char* out = std::copy(begin, rest, text.begin());
    *out++ = 'e';
    return from_text(text.data(), std::copy(lower(*rest) == 'd' ? rest + 1 : rest, end, out));
}

std::optional<std::int64_t> read_whole_number(std::string_view field)
{
    field = without_plus(trimmed(field));
    const char *begin = field.data(), *end = begin + field.size();
    std::int64_t value = 0;
    const auto [rest, problem] = std::from_chars(begin, end, value);
    if (problem != std::errc())
        return std::nullopt;
    if (rest == end || (*rest == '.' && std::all_of(rest + 1, end, [](char c) { return c == '0'; })))
        return value;
    return std::nullopt;
}

double mean(std::span<const double> values)
{
    double beyond = 0;
    for (const double value : values)
        beyond += value - values[0];
    return values[0] + beyond / double(values.size());
}

} // namespace spia
