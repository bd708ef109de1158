#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace spia::fuzz {

/// The reader of one format, for content of any kind.
struct FuzzTarget {
    std::string name;               ///< the ending of its files, e.g. "obj"
    std::vector<std::string> seeds; ///< good files, small
    std::vector<std::string> spice; ///< words that mean something to the reader, and numbers that
                                    ///< are too large
    /// @returns whether the content was accepted; what a reader may throw, an InputError, is no
    /// fault and is false.
    /// @throws std::logic_error if what it gave makes no sense, and whatever else the reader should
    /// not have thrown
    bool (*read)(std::string_view content) = nullptr;
};

/// All formats that parts and lines are read from in this process. CAD files are read in another
/// one: cad_search.h.
const std::vector<FuzzTarget>& fuzz_targets();

/// @throws std::out_of_range if there is none
const FuzzTarget& fuzz_target(std::string_view name);

} // namespace spia::fuzz
