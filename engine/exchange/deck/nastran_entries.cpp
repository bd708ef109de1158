#include "engine/exchange/deck/nastran_entries.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/core.h>
#include <utility>

#include "engine/core/read_number.h"

namespace spia {
namespace {

constexpr size_t column = 8;
constexpr size_t longest_line = 200;  // more is damage; tabs are replaced in these
constexpr size_t most_fields = 10000; // of one entry

std::string with_blanks_for_tabs(std::string_view line)
{
    std::string result;
    for (const char c : line)
        if (c == '\t')
            result.append(column - result.size() % column, ' ');
        else
            result += c;
    return result;
}

bool starts_with_word(std::string_view line, std::string_view word)
{
    line = trimmed(line);
    return same_letters(line.substr(0, word.size()), word) &&
           (line.size() == word.size() || !std::isalnum(static_cast<unsigned char>(line[word.size()])));
}

bool begins_bulk(std::string_view line)
{
    line = trimmed(line);
    return starts_with_word(line, "BEGIN") &&
           (starts_with_word(line.substr(5), "BULK") || starts_with_word(line.substr(5), "SUPER"));
}

bool has_control_sections(std::string_view text)
{
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size() - 1);
        if ((text[0] == 'B' || text[0] == 'b' || text[0] == ' ' || text[0] == '\t') && begins_bulk(text.substr(0, end)))
            return true;
        text.remove_prefix(end + 1);
    }
    return false;
}

std::string_view without_sign(std::string_view mark)
{
    return !mark.empty() && (mark[0] == '+' || mark[0] == '*') ? mark.substr(1) : mark;
}

} // namespace

NastranEntries::NastranEntries(DeckLines& lines)
    : lines_(lines), end_missing_(has_control_sections(lines.text())), in_bulk_(!end_missing_)
{
}

/// Goes to a line that is neither empty nor a comment.
bool NastranEntries::next_line()
{
    if (std::exchange(ahead_, false))
        return true;
    while (lines_.next()) {
        line_ = lines_.line();
        if (line_.starts_with('$')) {
            comment(line_);
            continue;
        }
        line_ = line_.substr(0, line_.find('$'));
        if (line_.find_first_not_of(" \t") != line_.npos)
            return true;
    }
    return false;
}

bool NastranEntries::continues() const
{
    const char first = line_.front();
    return first == '+' || first == '*' || first == ',' || first == '\t' ||
           line_.substr(0, column).find_first_not_of(' ') == line_.npos;
}

bool NastranEntries::next()
{
    name_.clear();
    field_.clear();
    lines_.speak_of(std::nullopt);
    while (name_.empty()) {
        if (!next_line())
            return false;
        if (!in_bulk_) {
            in_bulk_ = begins_bulk(line_);
            continue;
        }
        if (starts_with_word(line_, "INCLUDE"))
            include(trimmed(line_).substr(7));
        else if (starts_with_word(line_, "ENDDATA")) {
            end_missing_ = end_missing_ && lines_.depth() > 1;
            lines_.leave_file();
        } else if (!begins_bulk(line_))
            take(line_);
    }
    in_order_ = true;
    const DeckLines::Place first = lines_.place();
    while (next_line()) {
        if (!continues()) {
            ahead_ = true;
            break;
        }
        take(line_);
    }
    lines_.speak_of(first);
    return true;
}

/// Adds the fields of a line; of the first one also the name.
void NastranEntries::take(std::string_view line)
{
    const bool first_line = name_.empty();
    if (first_line)
        expanded_.clear();
    too_long_ = field_.size() > most_fields;
    if (too_long_)
        return;
    if (line.find('\t') != line.npos && line.find(',') == line.npos)
        line = expanded_.emplace_back(with_blanks_for_tabs(line.substr(0, longest_line)));
    const bool free = line.find(',') != line.npos;
    std::string_view head = trimmed(free ? line.substr(0, line.find(',')) : line.substr(0, column));
    const bool large = first_line ? head.ends_with('*') : head.starts_with('*');
    if (first_line) {
        if (large)
            head.remove_suffix(1);
        for (const char c : head)
            name_ += char(std::toupper(static_cast<unsigned char>(c)));
        if (name_.empty() ||
            !std::all_of(name_.begin(), name_.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; }) ||
            std::isdigit(static_cast<unsigned char>(name_[0])))
            lines_.fail(fmt::format("'{}' is no entry of Nastran bulk data", head.substr(0, 40)));
    } else if (!without_sign(mark_).empty() && !without_sign(head).empty() &&
               without_sign(mark_) != without_sign(head)) {
        in_order_ = false;
    }
    static constexpr std::array<int, 10> small_widths = {8, 8, 8, 8, 8, 8, 8, 8, 8, 8};
    static constexpr std::array<int, 6> large_widths = {8, 16, 16, 16, 16, 8};
    if (free)
        cut_.cut_commas(line);
    else if (large)
        cut_.cut_columns(line, large_widths);
    else
        cut_.cut_columns(line, small_widths);
    const size_t per_line = large ? 4 : 8;
    for (size_t k = 1; k <= per_line; ++k)
        field_.push_back(cut_[k]);
    mark_ = cut_[per_line + 1];
}

void NastranEntries::require_whole() const
{
    if (too_long_)
        lines_.fail(fmt::format("this {} has more than {} fields", name_, most_fields));
    if (!in_order_)
        lines_.fail(fmt::format("the continuations of this {} are not in their order; sort the deck", name_));
}

/// INCLUDE 'file' over one or more lines.
void NastranEntries::include(std::string_view rest)
{
    rest = trimmed(rest);
    if (rest.empty() || (rest[0] != '\'' && rest[0] != '"'))
        return lines_.include(rest);
    const char quote = rest[0];
    std::string name(trimmed(rest.substr(1)));
    constexpr int most_lines = 20;
    for (int line = 0; name.find(quote) == name.npos; ++line) {
        if (line == most_lines || !lines_.next())
            lines_.fail("the quote around the name of an included file does not end");
        name += trimmed(lines_.line());
    }
    lines_.include(name.substr(0, name.find(quote)));
}

void NastranEntries::comment(std::string_view line)
{
    const auto digits_from = [&](size_t at) {
        at = std::min(line.find_first_not_of(' ', at), line.size());
        return line.substr(at, std::min(line.find_first_not_of("0123456789", at), line.size()) - at);
    };
    const auto remember = [&](std::string_view number, std::string_view name) {
        if (const auto id = read_whole_number(number); id && !trimmed(name).empty())
            property_name_[*id] = std::string(trimmed(name));
    };
    if (constexpr std::string_view head = "$HMNAME PROP"; line.starts_with(head)) {
        const size_t open = line.find('"'), close = line.rfind('"');
        if (open < close && close != line.npos)
            remember(digits_from(head.size()), line.substr(open + 1, close - open - 1));
    } else if (constexpr std::string_view word = " Property "; line.starts_with("$ Femap")) {
        const size_t at = line.find(word), colon = line.find(" : ");
        if (at < colon && colon != line.npos)
            remember(digits_from(at + word.size()), line.substr(colon + 3));
    }
}

} // namespace spia
