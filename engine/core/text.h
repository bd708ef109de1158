#pragma once
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>

namespace spia {

/// The text with ASCII letters made small; others stay, for the result must not depend on the
/// user's locale.
std::string lower_case(std::string_view text);

/// Bytes of the UTF-8 sequence at the beginning of a text, 0 if there is none. [RFC 3629]
size_t utf8_length(std::string_view text);

/// "1 face has", "3 faces have"
template <std::integral Count> std::string counted(Count count, std::string_view one, std::string_view many)
{
    return std::to_string(count).append(" ").append(count == 1 ? one : many);
}

} // namespace spia
