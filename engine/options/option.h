#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace spia {

/// From least to greatest, both allowed.
struct Range {
    double least, greatest;

    constexpr double nearest(double value) const { return value < least ? least : value > greatest ? greatest : value; }
};

/// One of the values of an option that is chosen from a list. Lists have the order of their
/// enumeration.
struct Choice {
    std::string_view name;       ///< on the command line, in scripts and projects
    std::string_view label = {}; ///< in the list of the window; empty: the name
    std::string_view help = {};  ///< what it does; empty: the option says it
    std::string_view place = {}; ///< of the window, where texts advise this value; empty: that of
                                 ///< the option
};

/// Which surfaces an option is for, by what they are made of.
enum class Patches { any, one, several };

/// What can be asked for, described once: the command line, scripts and projects, the fields of the
/// window and the advice in messages are made from it. The default is that of the member it sets.
struct Option {
    std::string_view name;                ///< on the command line, without its dashes; empty: it
                                          ///< is not there
    std::string_view key = {};            ///< in scripts and projects; empty: it is not there
    std::string_view value = {};          ///< what is given, with its unit: "MM", "0-0.9"; empty:
                                          ///< a choice, or nothing
    std::optional<Range> range = {};      ///< of the member; not given: any
    std::span<const Choice> choices = {}; ///< that there are; the command line may take others,
                                          ///< where `value` says so
    std::string_view help;                ///< what it does; no capital and no full stop
    std::string_view label = {};          ///< of its field in the window; empty: it has none
    std::string_view place = {};          ///< of the window, in which that field is
    Patches patches = Patches::any;       ///< for which surfaces; with others it is refused
    bool within_tolerance = false;        ///< it is for surfaces within a tolerance
};

/// What to do next, where that is another thing in files and on the command line than in the
/// window.
struct Advice {
    std::string_view name; ///< unlike that of any option, without blanks
    std::string_view on_command_line, in_window;
};

/// An option as texts of the engine name it: by a mark that command_line_text() and window_text()
/// replace. Unreplaced it reads as the name.
/// @param value  that is advised: a number, a choice, or what stands for one as in Option::value
std::string mention(const Option& option, std::string_view value = {});
std::string mention(const Advice& advice);

/// As in: close the crack (--weld 0.02).
std::string command_line_text(std::string_view text);
/// As in: close the crack ("Close the crack" in the step Part).
std::string window_text(std::string_view text);

/// Which surfaces the option is for, to be put behind its help: "; of one patch only". Empty: any.
std::string_view applicability(const Option& option);

/// Of a choice in the list of the window.
inline std::string_view label_of(const Choice& choice) { return choice.label.empty() ? choice.name : choice.label; }

/// The choice with this value of the enumeration.
template <class E> const Choice& choice_of(const Option& option, E value) { return option.choices[size_t(value)]; }

/// The value of the enumeration with this name; none: there is no such choice.
template <class E> std::optional<E> value_of(const Option& option, std::string_view name)
{
    for (size_t i = 0; i < option.choices.size(); ++i)
        if (option.choices[i].name == name)
            return E(i);
    return std::nullopt;
}

} // namespace spia
