#include "app/viewer/model/viewer_words.h"

#include <string_view>

namespace spia::viewer {

std::string in_viewer_words(std::string text)
{
    constexpr std::string_view words[][2] = {{"--weld", "\"Join them\" in the step Part"},
                                             {"--keep-largest", "\"Keep the largest piece\" in the step Part"},
                                             {"--unit", "in the step Part"}};
    for (const auto& [flag, button] : words)
        for (size_t at = text.find(flag); at != std::string::npos; at = text.find(flag, at + button.size()))
            text.replace(at, flag.size(), button);
    return text;
}

std::string as_sentence(std::string text)
{
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
        text[0] = char(text[0] - 'a' + 'A');
    return text;
}

} // namespace spia::viewer
