#include "engine/report/text/shown_lengths.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <vector>

#include "engine/report/text/lengths.h"

namespace spia {
namespace {

/// Digits with a sign, a point and an exponent.
struct FoundNumber {
    size_t from, to;
    double value;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// The number that ends before a place; nothing if there is none, or it is the end of a name
/// ("M10", "part-3" is one, "v2.5" is none).
std::optional<FoundNumber> number_before(std::string_view text, size_t end)
{
    const auto belongs = [](char c) { return is_digit(c) || c == '.' || c == '-' || c == '+' || c == 'e'; };
    size_t from = end;
    while (from > 0 && belongs(text[from - 1]))
        --from;
    while (from < end && !is_digit(text[from]) && !(text[from] == '-' && from + 1 < end && is_digit(text[from + 1])))
        ++from;
    if (from == end || (from > 0 && (is_letter(text[from - 1]) || text[from - 1] == '/' || text[from - 1] == '^')))
        return std::nullopt;
    double value = 0;
    const auto [after, fault] = std::from_chars(text.data() + from, text.data() + end, value);
    if (fault != std::errc() || after != text.data() + end)
        return std::nullopt;
    return FoundNumber{from, end, value};
}

/// The numbers that one unit behind the last of them stands for, the last first.
std::vector<FoundNumber> numbers_before(std::string_view text, size_t end)
{
    std::vector<FoundNumber> found;
    for (auto number = number_before(text, end); number;) {
        found.push_back(*number);
        const std::string_view before = text.substr(0, number->from);
        number.reset();
        for (const std::string_view between : {", ", " x ", " of ", " to ", " and "})
            if (before.ends_with(between))
                number = number_before(text, before.size() - between.size());
    }
    return found;
}

/// As many significant digits as the engine has given, three at least: an inch is no coarser than
/// what it was made of.
std::string converted(std::string_view digits, double value, double factor)
{
    int significant = 0;
    for (const char c : digits.substr(0, digits.find('e')))
        significant += is_digit(c) && (significant > 0 || c != '0');
    const double shown = factor * value;
    const std::string text = fmt::format("{:.{}g}", shown, std::clamp(significant, 3, 9));
    return text.find('e') == std::string::npos ? text : fmt::format("{:.6f}", shown);
}

} // namespace

std::string in_shown_lengths(std::string_view text, LengthUnit unit)
{
    std::string result(text);
    const std::string question = "is that in mm?"; // of a number that was typed in the unit of the
                                                   // screen
    if (const size_t at = result.find(question); at != result.npos && unit != LengthUnit::mm)
        result.replace(at, question.size(),
                       fmt::format("is that in {}?", unit == LengthUnit::inch ? "inch" : name(unit)));
    for (size_t at = result.rfind(" mm"); at != result.npos && at > 0;
         at = at > 0 ? result.rfind(" mm", at - 1) : result.npos) {
        size_t end = at + 3;
        int power = 1;
        for (const std::string_view square : {"2", "^2", "\u00b2"})
            if (result.compare(end, square.size(), square) == 0) {
                end += square.size();
                power = 2;
                break;
            }
        const char next = end < result.size() ? result[end] : ' ',
                   after = end + 1 < result.size() ? result[end + 1] : ' ';
        // "mm.stl" is a file
        if (is_letter(next) || is_digit(next) || next == '/' || (next == '.' && is_letter(after)))
            continue;
        const std::vector<FoundNumber> numbers = numbers_before(result, at);
        if (numbers.empty())
            continue;
        const ShownUnit as = as_shown(power == 1 ? "mm" : "mm\u00b2", unit);
        if (unit != LengthUnit::mm)
            result.replace(at + 1, end - at - 1, as.unit);
        for (const FoundNumber& number : numbers) {
            const std::string digits = result.substr(number.from, number.to - number.from);
            const bool nothing = power == 1 && std::abs(number.value) < no_length;
            if (nothing)
                result.replace(number.from, digits.size(), "0");
            else if (unit != LengthUnit::mm)
                result.replace(number.from, digits.size(), converted(digits, number.value, as.factor));
        }
        at = std::min(at, numbers.back().from + 1);
    }
    return result;
}

} // namespace spia
