#include "engine/forming/material/two_columns.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "engine/core/error.h"

namespace spia {
namespace {

constexpr std::string_view blanks = " \t\r\v\f\"";

std::string_view trimmed(std::string_view text)
{
    const size_t begin = text.find_first_not_of(blanks);
    return begin == text.npos ? "" : text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

std::string small_letters(std::string_view text)
{
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return result;
}

std::vector<std::string_view> split(std::string_view line, char separator)
{
    std::vector<std::string_view> fields;
    if (separator == ' ') {
        for (size_t begin = line.find_first_not_of(blanks); begin != line.npos;) {
            const size_t end = line.find_first_of(blanks, begin);
            fields.push_back(line.substr(begin, end - begin));
            begin = end == line.npos ? end : line.find_first_not_of(blanks, end);
        }
        return fields;
    }
    for (size_t begin = 0; begin <= line.size();) {
        const size_t end = std::min(line.find(separator, begin), line.size());
        fields.push_back(trimmed(line.substr(begin, end - begin)));
        begin = end + 1;
    }
    while (fields.size() > 2 && fields.back().empty()) // separators at the end of a line
        fields.pop_back();
    return fields;
}

char separator_of(std::string_view line)
{
    for (const char sure : {';', '\t'})
        if (line.find(sure) != line.npos)
            return sure;
    if (line.find(',') == line.npos)
        return ' ';
    const auto words = split(line, ' ');
    const bool commas_within = words.size() == 2 && words[0].back() != ',' && words[1].front() != ',';
    return commas_within ? ' ' : ',';
}

bool begins_with_number(std::string_view line)
{
    const size_t at = line.find_first_not_of("+-.,");
    return at != line.npos && at <= 2 && line[at] >= '0' && line[at] <= '9';
}

std::optional<double> number(std::string_view field, char separator)
{
    std::string text(field);
    if (separator != ',' && std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == text.npos)
        std::replace(text.begin(), text.end(), ',', '.');
    // from_chars does not know it
    const size_t plus = text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0;
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data() + plus, text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return {};
    return value;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }

bool has_word(const std::vector<std::string>& lines, const std::string& word)
{
    for (const std::string& line : lines)
        for (size_t at = line.find(word); at != line.npos; at = line.find(word, at + 1)) {
            const bool apart = (at == 0 || !is_letter(line[at - 1])) &&
                               (at + word.size() == line.size() || !is_letter(line[at + word.size()]));
            if (apart || !is_letter(word[0]))
                return true;
        }
    return false;
}

/// Keeps the titles if the line above has two.
void note_titles(TwoColumns& table, char separator)
{
    for (auto above = table.heading.rbegin(); above != table.heading.rend(); ++above)
        if (const auto titles = split(*above, separator); titles.size() == 2 && !titles[1].empty()) {
            table.column_title = {std::string(titles[0]), std::string(titles[1])};
            return;
        }
}

} // namespace

bool TwoColumns::heading_has(const std::string& word) const { return has_word(heading, word); }

bool TwoColumns::titles_have(const std::string& word) const
{
    return has_word(column_title.empty() ? heading : column_title, word);
}

TwoColumns parse_two_columns(const std::string& text, const std::string& name)
{
    TwoColumns table;
    char separator = 0;
    std::string_view rest = text;
    if (rest.starts_with("\xef\xbb\xbf")) // byte order mark
        rest.remove_prefix(3);
    if (rest.find('\0') != rest.npos)
        throw InputError(fmt::format("{} is not a text file; save the table as CSV (UTF-8)", name));
    for (long count = 1; !rest.empty(); ++count) {
        const auto fail = [&](const std::string& what) {
            throw InputError(fmt::format("{}, line {}: {}", name, count, what));
        };
        const size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view whole = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        const std::string_view line = trimmed(whole.substr(0, whole.find('#')));
        const bool row = begins_with_number(line);
        if (separator == 0 && !row && !whole.empty())
            table.heading.push_back(small_letters(whole));
        if (line.empty() || (separator == 0 && !row))
            continue;
        if (!row)
            fail(fmt::format("\"{}\" is not a row of numbers; put # before remarks", line.substr(0, 40)));
        if (separator == 0)
            separator = separator_of(line);
        const auto fields = split(line, separator);
        if (fields.size() != 2)
            fail(fmt::format("{} columns, two are needed{}", fields.size(),
                             separator == ',' ? "; decimal commas need ';' or a tab between the columns" : ""));
        double value[2];
        for (size_t k = 0; k < 2; ++k) {
            const auto read = number(fields[k], separator);
            if (!read)
                fail(fmt::format("\"{}\" is not a finite number", fields[k].substr(0, 40)));
            value[k] = *read;
        }
        table.first.push_back(value[0]);
        table.second.push_back(value[1]);
        table.line.push_back(count);
    }
    if (table.first.empty())
        throw InputError(fmt::format("{} has no row of two numbers; two columns are needed", name));
    note_titles(table, separator);
    return table;
}

TwoColumns read_two_columns(const std::filesystem::path& file)
{
    constexpr std::uintmax_t most_bytes = 64u << 20;
    std::error_code unknown; // a pipe has no size
    const std::uintmax_t size = std::filesystem::file_size(file, unknown);
    if (!unknown && size > most_bytes)
        throw InputError(fmt::format("{} has {} MB; a table of two columns has at most {} MB", file.string(),
                                     size >> 20, most_bytes >> 20));
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || std::filesystem::is_directory(file))
        throw InputError(fmt::format("cannot open {}; give a text file with two columns of numbers", file.string()));
    text << stream.rdbuf();
    return parse_two_columns(text.str(), file.string());
}

} // namespace spia
