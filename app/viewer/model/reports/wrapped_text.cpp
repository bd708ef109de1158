#include "app/viewer/model/reports/wrapped_text.h"

#include <algorithm>
#include <array>

namespace spia::viewer {
namespace {

/// Whether the word from here on is a unit of the number before it.
bool is_unit(std::string_view word)
{
    constexpr std::array<std::string_view, 10> units{"mm", "mm2", "mm\u00b2", "in",   "in\u00b2",
                                                     "%",  "MPa", "kN",       "N/mm", "s"};
    while (!word.empty() && std::string_view(".,;:)?").find(word.back()) != word.npos)
        word.remove_suffix(1);
    return std::find(units.begin(), units.end(), word) != units.end();
}

/// The end of what stays together from a place on: a word, with a number its unit.
size_t end_of_piece(std::string_view text, size_t from)
{
    size_t end = std::min(text.find(' ', from), text.size());
    if (end > from && end < text.size() && text[end - 1] >= '0' && text[end - 1] <= '9') {
        const size_t next = std::min(text.find(' ', end + 1), text.size());
        if (is_unit(text.substr(end + 1, next - end - 1)))
            end = next;
    }
    return end;
}

std::string broken_line(std::string_view text, float room, const std::function<float(std::string_view)>& width_of)
{
    std::string result, line;
    for (size_t at = 0; at < text.size();) {
        const size_t begin = std::min(text.find_first_not_of(' ', at), text.size()), end = end_of_piece(text, begin);
        const std::string longer = line + std::string(text.substr(at, end - at));
        if (!line.empty() && width_of(longer) > room) {
            result += line + '\n';
            line = text.substr(begin, end - begin);
        } else
            line = longer;
        at = end;
    }
    return result + line;
}

} // namespace

std::string broken_at_spaces(std::string_view text, float room, const std::function<float(std::string_view)>& width_of)
{
    std::string result;
    for (size_t at = 0; at <= text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size());
        result += (at > 0 ? "\n" : "") + broken_line(text.substr(at, end - at), room, width_of);
        at = end + 1;
    }
    return result;
}

} // namespace spia::viewer
