#pragma once
#include <string>

namespace spia {

/// With a capital letter at its beginning, unless that is a name: of a file or a folder, or what
/// stands before a colon.
std::string as_sentence(std::string text);
/// The same with a full stop at its end.
std::string sentence(std::string text);

} // namespace spia
