#include "engine/exchange/deck/deck_fields.h"

#include <algorithm>

#include "engine/core/read_number.h"

namespace spia {

void DeckFields::cut_columns(std::string_view line, std::span<const int> widths)
{
    count_ = 0;
    for (const int width : widths) {
        if (line.empty())
            return;
        add(trimmed(line.substr(0, size_t(width))));
        line.remove_prefix(std::min(line.size(), size_t(width)));
    }
}

void DeckFields::cut_commas(std::string_view line)
{
    count_ = 0;
    for (bool more = true; more;) {
        const size_t comma = line.find(',');
        more = comma != line.npos;
        add(trimmed(line.substr(0, comma)));
        line.remove_prefix(more ? comma + 1 : line.size());
    }
}

void DeckFields::cut_words(std::string_view line)
{
    constexpr std::string_view blank = " \t\r";
    count_ = 0;
    for (size_t begin = line.find_first_not_of(blank); begin != line.npos;) {
        const size_t end = line.find_first_of(blank, begin);
        add(line.substr(begin, end - begin));
        begin = end == line.npos ? end : line.find_first_not_of(blank, end);
    }
}

} // namespace spia
