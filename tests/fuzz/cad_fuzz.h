#pragma once
#include <string_view>

#include "tests/fuzz/cad_target.h"

namespace spia::fuzz {

/// For libFuzzer: reads a CAD file in a copy of this process, whose coverage counts here. OpenCASCADE may crash there, run out of memory
/// or not end: every tenth of these files is read again as users do, and has to get an answer. Whatever else ends the copy is a fault of the
/// reader: a report of a sanitizer, a signal or an exception in its own code, a result that makes no sense.
/// Ends this process at a fault. What became of the files is printed when it ends.
void fuzz_cad(const CadTarget& target, std::string_view content);

} // namespace spia::fuzz
