#pragma once
#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/options/option.h"

namespace spia::cli {

/// The names of all choices.
std::vector<std::string> names_of(const Option& option);

/// What the option does, and what its choices do.
std::string help_of(const Option& option);

/// Refuses numbers that are out of the option's range, and nan, which is in all of CLI11's. People
/// give percent of what is a share.
template <class Number> CLI::Validator range_of(const Option& option)
{
    const double scale = option.value == "PERCENT" ? 100 : 1;
    const CLI::Range range{Number(scale * option.range->least), Number(scale * option.range->greatest)};
    const auto check = [range](std::string& word) {
        double number = 0;
        const bool nan = CLI::detail::lexical_cast(word, number) && std::isnan(number);
        return nan ? fmt::format("{} is not a number", word) : range(word);
    };
    return {check, range.get_description()};
}

template <class T> struct NumberIn {
    using type = double;
};
template <> struct NumberIn<int> {
    using type = int;
};
template <> struct NumberIn<std::vector<int>> {
    using type = int;
};

/// Adds an option as it is described, whatever its range: a flag for a bool, names for an
/// enumeration. The help shows the default where there is one.
template <class T> CLI::Option* add_unchecked(CLI::App& command, const Option& option, T& value)
{
    const std::string name = "--" + std::string(option.name);
    if constexpr (std::is_same_v<T, bool>) {
        return command.add_flag(name, value, help_of(option));
    } else if constexpr (std::is_enum_v<T>) {
        const auto take = [&option, &value](const std::string& word) { value = *value_of<T>(option, word); };
        return command.add_option_function<std::string>(name, take, help_of(option))
            ->check(CLI::IsMember(names_of(option)))
            ->default_str(std::string(choice_of(option, value).name));
    } else {
        CLI::Option* added = command.add_option(name, value, help_of(option));
        if (!option.value.empty())
            added->type_name(std::string(option.value));
        else if (!option.choices.empty())
            added->check(CLI::IsMember(names_of(option)));
        if constexpr (requires { value.empty(); }) {
            if (!value.empty())
                added->capture_default_str();
        } else if constexpr (std::is_arithmetic_v<T>)
            added->capture_default_str();
        return added;
    }
}

/// The same, of which numbers out of its range are refused.
template <class T> CLI::Option* add(CLI::App& command, const Option& option, T& value)
{
    CLI::Option* added = add_unchecked(command, option, value);
    return option.range ? added->check(range_of<typename NumberIn<T>::type>(option)) : added;
}

} // namespace spia::cli
