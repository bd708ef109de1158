#pragma once
#include <cstdint>
#include <cstdlib>

namespace spia::shapes {

/// How many of a family that is drawn at random a test takes: all where the environment variable
/// SPIA_WHOLE_FAMILIES is set, else a third, which keeps what has to pass before a commit below
/// half an hour.
inline std::uint64_t family_size(std::uint64_t whole)
{
    return std::getenv("SPIA_WHOLE_FAMILIES") ? whole : (whole + 2) / 3;
}

} // namespace spia::shapes
