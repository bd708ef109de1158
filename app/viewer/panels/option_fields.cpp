#include "app/viewer/panels/option_fields.h"

#include <fmt/core.h>

#include "app/viewer/panels/widgets.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {
namespace {

/// Behind a value that was changed, or not.
template <class Number> bool within(const Option& option, Number& value, bool changed)
{
    tooltip(help_text(option));
    if (option.range)
        value = Number(option.range->nearest(double(value)));
    return changed;
}

} // namespace

std::string help_text(const Option& option)
{
    std::string text = sentence(std::string(option.help).append(applicability(option)));
    for (const Choice& choice : option.choices)
        if (!choice.help.empty())
            text += fmt::format(" {}: {}.", as_sentence(std::string(label_of(choice))), choice.help);
    return text;
}

bool tick(const Option& option, bool& value)
{
    const bool changed = ImGui::Checkbox(std::string(option.label).c_str(), &value);
    tooltip(help_text(option));
    return changed;
}

bool integer_field(Frame& frame, const Option& option, int& value, int step)
{
    return within(option, value, typed_integer(frame, std::string(option.label).c_str(), value, step));
}

bool percent_field(Frame& frame, const Option& option, double& share, const char* format)
{
    double percent = 100 * share;
    const bool changed = typed_number(frame, fmt::format("{}, %", option.label).c_str(), percent, format);
    if (changed)
        share = percent / 100;
    return within(option, share, changed);
}

bool angle_field(Frame& frame, const Option& option, double& degrees)
{
    return within(option, degrees,
                  typed_number(frame, fmt::format("{}, degrees", option.label).c_str(), degrees, "%.4g"));
}

bool choice_field(const Option& option, int& chosen)
{
    std::string labels; // one behind the other, each with a 0
    for (const Choice& choice : option.choices)
        labels.append(label_of(choice)).push_back('\0');
    const bool changed = ImGui::Combo(std::string(option.label).c_str(), &chosen, labels.c_str());
    tooltip(help_text(option));
    return changed;
}

} // namespace spia::viewer
