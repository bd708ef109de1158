#include "engine/exchange/deck/dyna_card.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "engine/core/read_number.h"

namespace spia {

DynaKeyword::DynaKeyword(std::string_view line, DynaFormat usual) : format(usual)
{
    line.remove_prefix(1);
    const size_t end = std::min(line.find_first_of(" \t,"), line.size());
    std::string_view word = line.substr(0, end);
    options = trimmed(line.substr(end));
    std::string_view mark = options.substr(0, 1);
    if (!word.empty() && std::string_view("%+-").find(word.back()) != word.npos) {
        mark = word.substr(word.size() - 1);
        word.remove_suffix(1);
    }
    if (mark == "%")
        format = DynaFormat::i10;
    else if (mark == "+")
        format = DynaFormat::wide;
    else if (mark == "-")
        format = DynaFormat::standard;
    for (const char c : word)
        name += char(std::toupper(static_cast<unsigned char>(c)));
}

bool DynaKeyword::is(std::string_view prefix) const
{
    return name.starts_with(prefix) && (name.size() == prefix.size() || name[prefix.size()] == '_');
}

bool DynaKeyword::has(std::string_view suffix) const
{
    for (size_t at = name.find(suffix); at != name.npos; at = name.find(suffix, at + 1)) {
        const size_t end = at + suffix.size();
        if (at > 0 && name[at - 1] == '_' && (end == name.size() || name[end] == '_'))
            return true;
    }
    return false;
}

DynaFormat dyna_format(std::string_view options, DynaFormat usual)
{
    DynaFormat format = usual;
    std::string text; // "LONG = Y" is one word
    for (const char c : options)
        if (c != ' ' && c != '\t')
            text += char(std::toupper(static_cast<unsigned char>(c)));
    if (text.find("LONG=S") != text.npos)
        format = DynaFormat::standard;
    if (text.find("I10=Y") != text.npos)
        format = DynaFormat::i10;
    if (text.find("LONG=Y") != text.npos)
        format = DynaFormat::wide;
    return format;
}

void cut_dyna_card(std::string_view line, std::initializer_list<int> widths, DynaFormat format, DeckFields& fields)
{
    if (line.find(',') != line.npos)
        return fields.cut_commas(line);
    if (line.find('\t') != line.npos)
        return fields.cut_words(line);
    const int least = format == DynaFormat::standard ? 0 : format == DynaFormat::i10 ? 10 : 20;
    std::array<int, DeckFields::most> wide;
    std::transform(widths.begin(), widths.end(), wide.begin(), [&](int w) { return std::max(w, least); });
    fields.cut_columns(line, std::span(wide).first(widths.size()));
}

} // namespace spia
