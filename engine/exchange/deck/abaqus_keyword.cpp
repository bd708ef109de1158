#include "engine/exchange/deck/abaqus_keyword.h"

#include <cctype>

#include "engine/core/read_number.h"

namespace spia {
namespace {

/// The text up to a comma that is not between quotes; takes it and the comma away.
std::string_view next_piece(std::string_view& line)
{
    bool quoted = false;
    size_t end = 0;
    while (end < line.size() && (quoted || line[end] != ','))
        quoted ^= line[end++] == '"';
    const std::string_view piece = line.substr(0, end);
    line.remove_prefix(end < line.size() ? end + 1 : end);
    return trimmed(piece);
}

} // namespace

std::string upper_case(std::string_view text)
{
    std::string result(text);
    for (char& c : result)
        c = char(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

std::string_view without_quotes(std::string_view text)
{
    return text.size() > 1 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

AbaqusKeyword::AbaqusKeyword(std::string_view line)
{
    line.remove_prefix(1);
    bool blank = false; // "SHELL  SECTION" is "SHELL SECTION"
    for (const char c : upper_case(next_piece(line))) {
        if (c != ' ' || !blank)
            name += c;
        blank = c == ' ';
    }
    while (!line.empty()) {
        const std::string_view piece = next_piece(line);
        const size_t equals = piece.find('=');
        const std::string_view value =
            equals == piece.npos ? std::string_view() : without_quotes(trimmed(piece.substr(equals + 1)));
        if (const std::string_view parameter = trimmed(piece.substr(0, equals)); !parameter.empty())
            values[upper_case(parameter)] = std::string(value);
    }
}

} // namespace spia
