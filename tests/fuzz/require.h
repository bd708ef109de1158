#pragma once
#include <stdexcept>

namespace spia::fuzz {

/// @throws std::logic_error  what came of a file makes no sense
inline void require(bool sound, const char* what)
{
    if (!sound)
        throw std::logic_error(what);
}

} // namespace spia::fuzz
