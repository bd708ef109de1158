#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace spia {

/// The text with ASCII letters made small; others stay, for the result must not depend on the
/// user's locale.
std::string lower_case(std::string_view text);

/// Bytes of the UTF-8 sequence at the beginning of a text, 0 if there is none. [RFC 3629]
size_t utf8_length(std::string_view text);

} // namespace spia
