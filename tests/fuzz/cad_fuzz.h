#pragma once
#include <string_view>

#include "tests/fuzz/cad_target.h"

namespace spia::fuzz {

/// For libFuzzer: reads a CAD file in a copy of this process (CadCopy), whose coverage counts here.
/// Every tenth file that ends the copy is read again as users do, and has to get an answer. Ends
/// this process at a fault, for libFuzzer to keep the file. What became of all files is printed now
/// and then; the first file for each place where OpenCASCADE was ended is kept in the folder
/// SPIA_FUZZ_ENDED, if there is one.
void fuzz_cad(const CadTarget& target, std::string_view content);

} // namespace spia::fuzz
