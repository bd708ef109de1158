#include "engine/exchange/cad/brep_check.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fmt/core.h>

namespace spia {
namespace {

constexpr std::string_view spaces = " \t\r\n";

constexpr std::array<std::string_view, 18> names = {"Locations",
                                                    "Curve2ds",
                                                    "Curves",
                                                    "Polygon3D",
                                                    "PolygonOnTriangulations",
                                                    "Surfaces",
                                                    "Triangulations",
                                                    "TShapes",
                                                    "Ve",
                                                    "Ed",
                                                    "Wi",
                                                    "Fa",
                                                    "Sh",
                                                    "So",
                                                    "CS",
                                                    "Co",
                                                    "p",
                                                    "*"};
constexpr std::array<std::string_view, 7> continuities = {"C0", "C1", "C2", "C3", "CN", "G1", "G2"};

bool is_count(std::string_view word)
{
    return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_number(std::string_view word)
{
    constexpr size_t most = 255; // OpenCASCADE takes the rest of a longer one for the next number
    if (word.size() > most)
        return false;
    if (word.starts_with('+')) {
        word.remove_prefix(1);
        if (word.starts_with('-'))
            return false;
    }
    double value = 0;
    const char* const end = word.data() + word.size();
    return std::from_chars(word.data(), end, value).ptr == end && !word.empty();
}

bool is_word(std::string_view word)
{
    if (std::find(names.begin(), names.end(), word) != names.end() || is_number(word))
        return true;
    if ((word.starts_with('i') || word.starts_with('e')) && is_count(word.substr(1)))
        return true; // a shape internal or external to another one: written like the signs of +1
                     // and -1
    for (const std::string_view continuity : continuities)
        if (word.ends_with(continuity)) { // that of a seam stands at the number of its second
                                          // curve: "2CN"
            const std::string_view before = word.substr(0, word.size() - continuity.size());
            return before.empty() || is_count(before);
        }
    return false;
}

} // namespace

std::string brep_word_at(std::string_view content, size_t at)
{
    constexpr size_t most = 40;
    const size_t begin = std::min(content.find_first_not_of(spaces, at), content.size());
    std::string word(content.substr(begin, std::min(content.find_first_of(spaces, begin) - begin, most)));
    for (char& c : word)
        c = std::isprint(static_cast<unsigned char>(c)) ? c : '?';
    return word;
}

std::string fault_of_brep(std::string_view content)
{
    size_t begin = content.find("Locations"); // before it stands who wrote the file, in any words
    begin = begin == std::string_view::npos ? content.size() : begin;
    while ((begin = content.find_first_not_of(spaces, begin)) != std::string_view::npos) {
        const std::string_view word = content.substr(begin, content.find_first_of(spaces, begin) - begin);
        if (!is_word(word)) {
            if (begin + word.size() == content.size())
                return fmt::format("it was cut short: its text ends at byte {}, within '{}'", content.size(),
                                   brep_word_at(content, begin));
            return fmt::format("in line {} (byte {}) stands '{}', which is neither a number with a decimal point nor a "
                               "word of BREP files",
                               1 + std::count(content.begin(), content.begin() + std::ptrdiff_t(begin), '\n'), begin,
                               brep_word_at(content, begin));
        }
        begin += word.size();
    }
    return "";
}

} // namespace spia
