#include "engine/report/text/sentence.h"

#include <algorithm>
#include <string_view>

namespace spia {

std::string as_sentence(std::string text)
{
    const size_t end = std::min(text.find_first_of(" :,;"), text.size());
    const std::string_view first = std::string_view(text).substr(0, end);
    const bool name = (end < text.size() && text[end] == ':') || first.find('/') != first.npos ||
                      first.substr(0, std::max<size_t>(end, 1) - 1).find('.') != first.npos;
    const bool symbol = end == 1 && std::string_view(text).substr(end).starts_with(" = "); // "n = 0.25"
    if (!first.empty() && !name && !symbol && text[0] >= 'a' && text[0] <= 'z')
        text[0] = char(text[0] - 'a' + 'A');
    return text;
}

std::string sentence(std::string text)
{
    constexpr std::string_view ends = ".!?)";
    if (!text.empty() && ends.find(text.back()) == ends.npos)
        text += '.';
    return as_sentence(std::move(text));
}

} // namespace spia
