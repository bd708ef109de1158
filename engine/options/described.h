#pragma once
#include <tuple>

#include "engine/options/option.h"

/// Which member of the options of a stage an option sets. Whoever takes them from people, or keeps
/// them, goes through these and so has them all.
namespace spia {

template <class S, class T> struct Described {
    const Option* option;
    T S::*member;
};
template <class S, class T> constexpr Described<S, T> describe(const Option& option, T S::*member)
{
    return {&option, member};
}

template <class S> inline constexpr std::tuple<> described{}; ///< specialised: a tuple of Described

/// @param use  called with each option and the member it sets
template <class S, class Use> void for_each_described(S& options, const Use& use)
{
    std::apply([&](const auto&... each) { (use(*each.option, options.*each.member), ...); }, described<S>);
}

/// @param use  called with each option whose member is not the default one
template <class S, class Use> void for_each_changed(const S& options, const Use& use)
{
    const S plain;
    const auto compare = [&](const auto& one) {
        if (!(options.*one.member == plain.*one.member))
            use(*one.option);
    };
    std::apply([&](const auto&... each) { (compare(each), ...); }, described<S>);
}

} // namespace spia
