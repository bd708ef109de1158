#include "engine/picture/stroke_font.h"

#include <algorithm>

namespace spia::stroke_font {
namespace {

constexpr int base_line = 2; ///< y of the base line on the grid; descenders reach down to 0
constexpr double letter_space = 1.9;
constexpr double word_space = 3.2;

/// Polylines divided by blanks, each point two digits x and y on a grid of 0..6 by 0..8; a lone
/// point is a dot.
std::string_view strokes(char letter)
{
    switch (letter) {
    case '0': return "123243473818070312";
    case '1': return "172822 1232";
    case '2': return "07183847460242";
    case '3': return "07183847463525 354443321203";
    case '4': return "32380444";
    case '5': return "480805354443321203";
    case '6': return "473818070312324344351504";
    case '7': return "084822";
    case '8': return "15060718384746351504031232434435";
    case '9': return "031232434738180706153546";
    case 'a': return "4642 4536160503123243";
    case 'b': return "0802 0516364543321203";
    case 'c': return "4536160503123243";
    case 'd': return "4842 4536160503123243";
    case 'e': return "04444536160503123243";
    case 'f': return "38281712 0636";
    case 'g': return "4641301001 4536160503123243";
    case 'h': return "0802 0516364542";
    case 'i': return "0602 08";
    case 'j': return "161100 18";
    case 'k': return "0802 4603 1442";
    case 'l': return "0802";
    case 'm': return "0602 0516263532 3546566562";
    case 'n': return "0602 0516364542";
    case 'o': return "123243453616050312";
    case 'p': return "0600 0516364543321203";
    case 'q': return "4640 4536160503123243";
    case 'r': return "0602 051636";
    case 's': return "45361605143443321203";
    case 't': return "18132232 0636";
    case 'u': return "0603123243 4642";
    case 'v': return "062246";
    case 'w': return "0612355266";
    case 'x': return "0642 0246";
    case 'y': return "0622 4610";
    case 'z': return "06460242";
    case 'A': return "022842 1434";
    case 'B': return "02083847463505 3544433202";
    case 'I': return "0208";
    case 'N': return "02084248";
    case 'P': return "02083847463505";
    case 'R': return "02083847463505 2542";
    case 'S': return "473818070615354443321203";
    case 'U': return "080312324348";
    case '-': return "0535";
    case '+': return "0545 2327";
    case '.': return "02";
    case ',': return "1201";
    case ':': return "02 05";
    case '/': return "0248";
    case '%': return "0258 0708181707 4243535242";
    default: return "";
    }
}

double right_edge(std::string_view glyph)
{
    double x = 0;
    for (size_t i = 0; i < glyph.size(); ++i) // the point after a blank begins anew; x and y take
                                              // turns
        if (glyph[i] != ' ') {
            x = std::max(x, double(glyph[i] - '0'));
            ++i;
        }
    return x;
}

} // namespace

double width(std::string_view words)
{
    double x = 0;
    for (const char letter : words)
        x += strokes(letter).empty() ? word_space : right_edge(strokes(letter)) + letter_space;
    return std::max(0.0, x - letter_space);
}

std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> segments(std::string_view words)
{
    std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> result;
    double left = 0;
    for (const char letter : words) {
        const std::string_view glyph = strokes(letter);
        const auto point = [&](size_t i) {
            return Eigen::Vector2d(left + (glyph[i] - '0'), glyph[i + 1] - '0' - base_line);
        };
        for (size_t i = 0; i < glyph.size(); i += 2) {
            if (glyph[i] == ' ')
                ++i;
            const bool begins = i == 0 || glyph[i - 1] == ' ', ends = i + 2 >= glyph.size() || glyph[i + 2] == ' ';
            if (!begins)
                result.emplace_back(point(i - 2), point(i));
            else if (ends)
                result.emplace_back(point(i), point(i));
        }
        left += glyph.empty() ? word_space : right_edge(glyph) + letter_space;
    }
    return result;
}

} // namespace spia::stroke_font
