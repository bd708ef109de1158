#pragma once
#include <string>
#include <string_view>

namespace spia {

/// Text as XML and HTML want it, in attributes too.
std::string escaped(const std::string& text);

/// Bytes as text. [RFC 4648, section 4]
std::string base64(const std::string& bytes);

/// Text of unknown origin as UTF-8 that can be shown: bytes that are none are read as Latin-1,
/// control characters become blanks.
std::string readable(std::string_view text);

} // namespace spia
