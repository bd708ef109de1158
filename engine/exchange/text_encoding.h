#pragma once
#include <string>

namespace spia {

/// Text as XML and HTML want it, in attributes too.
std::string escaped(const std::string& text);

/// Bytes as text. [RFC 4648, section 4]
std::string base64(const std::string& bytes);

} // namespace spia
