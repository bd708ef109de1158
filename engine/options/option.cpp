#include "engine/options/option.h"

#include <algorithm>
#include <cstdlib>

#include "engine/options/all_options.h"

namespace spia {
namespace {

// Neither is in any text of people, nor to be seen where a text is shown as it is.
constexpr char begin_mark = '\x02', end_mark = '\x03';

std::string mark(std::string_view name, std::string_view value)
{
    std::string text;
    text += begin_mark;
    text += name;
    if (!value.empty())
        (text += ' ') += value;
    return text += end_mark;
}

std::string on_command_line(const Option& option, std::string_view value)
{
    std::string text = "--";
    text += option.name;
    if (!value.empty())
        (text += ' ') += value;
    return text;
}

/// Its own place is that of a choice, or of the number that stands for all of them.
const Choice* choice_with_place(const Option& option, std::string_view value)
{
    const auto found = std::find_if(option.choices.begin(), option.choices.end(), [&](const Choice& choice) {
        return choice.name == value || (!value.empty() && choice.name == option.value);
    });
    return found == option.choices.end() || found->place.empty() ? nullptr : &*found;
}

std::string in_window(const Option& option, std::string_view value)
{
    if (const Choice* choice = choice_with_place(option, value))
        return std::string(choice->place);
    std::string text;
    if (!option.label.empty())
        ((text += '"') += option.label) += "\" in ";
    return text += option.place;
}

template <class Described> const Described* named(std::span<const Described* const> all, std::string_view name)
{
    const auto found = std::find_if(all.begin(), all.end(), [&](const Described* each) { return each->name == name; });
    return name.empty() || found == all.end() ? nullptr : *found;
}

/// @param words       of an option and its value
/// @param advice_words which member of an advice has its words
std::string replaced(std::string_view text, std::string (*words)(const Option&, std::string_view),
                     std::string_view Advice::*advice_words)
{
    std::string result;
    for (size_t at = 0; at < text.size();) {
        const size_t end = text.find(end_mark, text.find(begin_mark, at));
        if (end == text.npos)
            return result += text.substr(at);
        const size_t begin = text.rfind(begin_mark, end);
        result += text.substr(at, begin - at);
        const std::string_view inside = text.substr(begin + 1, end - begin - 1);
        const size_t blank = std::min(inside.find(' '), inside.size());
        const std::string_view name = inside.substr(0, blank);
        at = end + 1;
        if (const Option* option = named(all_options(), name))
            result += words(*option, inside.substr(std::min(blank + 1, inside.size())));
        else if (const Advice* advice = named(all_advice(), name))
            result += advice->*advice_words;
        else // of a file that has such characters
            result += text.substr(begin, at - begin);
    }
    return result;
}

} // namespace

std::string mention(const Option& option, std::string_view value) { return mark(option.name, value); }
std::string mention(const Advice& advice) { return mark(advice.name, {}); }

std::string command_line_text(std::string_view text)
{
    return replaced(text, on_command_line, &Advice::on_command_line);
}

std::string window_text(std::string_view text) { return replaced(text, in_window, &Advice::in_window); }

std::string_view applicability(const Option& option)
{
    switch (option.patches) {
    case Patches::any: return "";
    case Patches::one: return "; of one patch only";
    case Patches::several: return "; of several patches only";
    }
    std::abort();
}

} // namespace spia
