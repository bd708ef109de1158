#include "app/cli/add_option.h"

namespace spia::cli {

std::vector<std::string> names_of(const Option& option)
{
    std::vector<std::string> names;
    for (const Choice& choice : option.choices)
        names.emplace_back(choice.name);
    return names;
}

std::string help_of(const Option& option)
{
    std::string text = std::string(option.help).append(applicability(option));
    for (const Choice& choice : option.choices)
        if (!choice.help.empty())
            text.append("; ").append(choice.name).append(": ").append(choice.help);
    return text;
}

} // namespace spia::cli
