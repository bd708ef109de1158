#pragma once
#include "app/viewer/panels/ui.h"
#include "engine/options/option.h"

/// Fields for what options set: the label, the choices, the range and the tooltip are theirs. All
/// @return whether the value was changed.
namespace spia::viewer {

/// What an option and its choices do.
std::string help_text(const Option& option);

bool tick(const Option& option, bool& value);
bool integer_field(Frame& frame, const Option& option, int& value, int step = 0);
/// @param share  typed in percent
bool percent_field(Frame& frame, const Option& option, double& share, const char* format = "%.0f");
bool angle_field(Frame& frame, const Option& option, double& degrees);

bool choice_field(const Option& option, int& chosen);
template <class E> bool choice_field(const Option& option, E& value)
{
    int chosen = int(value);
    const bool changed = choice_field(option, chosen);
    value = E(chosen);
    return changed;
}

} // namespace spia::viewer
