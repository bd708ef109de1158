#include "engine/unfold/plan/k_factor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <utility>

#include "engine/core/error.h"

namespace spia {
namespace {

constexpr size_t most_rows = 10'000;

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view blank = " \t\r";
    const size_t first = text.find_first_not_of(blank);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::optional<double> number(std::string_view text)
{
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

/// The fields of a line; more than three are cut off, for two are right.
std::vector<std::string_view> fields_of(std::string_view line)
{
    std::vector<std::string_view> fields;
    while (!line.empty() && fields.size() < 4) {
        const size_t end = line.find_first_of(" \t,;");
        fields.push_back(line.substr(0, end));
        if (end == std::string_view::npos)
            break;
        line = line.substr(end);
        const size_t next = line.find_first_not_of(" \t");
        // One comma or semicolon, with spaces around it, parts two fields.
        if (next != std::string_view::npos && (line[next] == ',' || line[next] == ';'))
            line = trimmed(line.substr(next + 1));
        else
            line = next == std::string_view::npos ? std::string_view() : line.substr(next);
    }
    return fields;
}

} // namespace

double KFactor::at(double ratio) const
{
    const auto above = std::upper_bound(table.begin(), table.end(), ratio,
                                        [](double value, const auto& row) { return value < row.first; });
    if (above == table.begin())
        return table.front().second;
    if (above == table.end())
        return table.back().second;
    const auto below = above - 1;
    const double share = (ratio - below->first) / (above->first - below->first);
    return below->second + share * (above->second - below->second);
}

KFactor constant_k(double k)
{
    if (!(k > 0 && k < 1))
        throw InputError(fmt::format("a K factor is above 0 and below 1, not {}: it says at which share of the "
                                     "thickness, from the inner side, the neutral fibre lies",
                                     k));
    return {fmt::format("{}", k), {{0, k}}};
}

KFactor din6935_k()
{
    // The sagitta of 0.25 lg x over a row that is 1 + q times as far as the one before is 0.25
    // lg(e) q^2 / 8: below 1e-7.
    constexpr int rows = 2500;
    const double least = std::log10(0.05), end = 5;
    KFactor result{"din6935", {}};
    for (int i = 0; i < rows; ++i) {
        const double lg = least + (std::log10(end) - least) * i / (rows - 1);
        result.table.emplace_back(i == rows - 1 ? end : std::pow(10, lg), std::max(0., (0.65 + 0.5 * lg) / 2));
    }
    // k is 0.9995 at 5, and 1 from there on.
    result.table.emplace_back(std::nextafter(end, 2 * end), 0.5);
    return result;
}

KFactor parse_k_table(std::string_view text, const std::string& name)
{
    KFactor result{name, {}};
    int line_number = 0;
    bool first = true;
    const auto fail = [&](std::string_view what) -> InputError {
        return InputError(fmt::format("{}, line {}: {}", name, line_number, what));
    };
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++line_number;
        line = trimmed(line.substr(0, line.find('#')));
        if (line.empty())
            continue;
        const auto fields = fields_of(line);
        std::optional<double> ratio, k;
        if (fields.size() == 2) {
            ratio = number(fields[0]);
            k = number(fields[1]);
        }
        const bool words = std::none_of(fields.begin(), fields.end(), [](auto field) { return number(field); });
        if (std::exchange(first, false) && words)
            continue; // the head of the table
        if (!ratio || !k)
            throw fail("a row has two numbers, R/t and K, as in \"1.5  0.38\"");
        if (!(*ratio >= 0))
            throw fail(fmt::format("R/t is {}; it is 0 or more", *ratio));
        if (!(*k > 0 && *k < 1))
            throw fail(fmt::format("K is {}; it is above 0 and below 1", *k));
        if (!result.table.empty() && !(*ratio > result.table.back().first))
            throw fail(fmt::format("R/t is {} after {}; rows ascend", *ratio, result.table.back().first));
        if (result.table.size() == most_rows)
            throw fail(fmt::format("a table has {} rows at most", most_rows));
        result.table.emplace_back(*ratio, *k);
    }
    if (result.table.empty())
        throw InputError(fmt::format("{}: there is no row with R/t and K in it", name));
    return result;
}

} // namespace spia
