#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spia::fuzz {

/// A format of CAD files, and what damaged ones are made from.
struct CadTarget {
    std::string name;               ///< "step", "igs" or "brep": the ending of its files
    std::vector<std::string> seeds; ///< good files, small
    std::vector<std::string> spice; ///< words that mean something to the reader, and numbers that
                                    ///< are too large
};

bool is_cad_target(std::string_view name);

/// @throws std::out_of_range if there is none
const CadTarget& cad_target(std::string_view name);

/// Reads and examines such a file in this process, which OpenCASCADE may crash.
/// @returns whether it was accepted; an InputError is no fault and is false.
/// @throws std::logic_error if what came of it makes no sense, and whatever else the reader should
/// not have thrown
bool read_and_examine(const std::filesystem::path& file);

} // namespace spia::fuzz
