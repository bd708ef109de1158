#pragma once
#include <filesystem>
#include <string>

#include "engine/part/part_file.h"
#include "engine/unfold/step/unfold_script.h"

namespace spia {

/// The states of an earlier run that a script can go on from.
struct KeptStates {
    UnfoldRun run;   ///< its leading states; no blank
    size_t keep = 0; ///< how many: those whose steps are the first ones of the script
    std::string why; ///< what ends them, in words; empty: all steps of the script are done
};

/// Writes the states of a run with all that they hang on, so that read_unfold_states() can tell
/// which of them hold for a script: the part, the sheet, the options, each step with its faces.
/// CBOR (RFC 8949), schema spia.unfold-states/2, numbers in full; behind it a checksum of four
/// bytes.
/// @throws ExchangeError as write_atomically()
void write_unfold_states(const std::filesystem::path& file, const TriMesh& part, const FlattenOptions& options,
                         const UnfoldScript& steps, const UnfoldRun& run);

/// @returns the states of the leading steps that are the same, whatever they are called; none if
/// the part, the sheet, an option or the
///          version of the program is another one
/// @throws InputError if there is no such file, it is no file of states or is damaged
KeptStates read_unfold_states(const std::filesystem::path& file, const TriMesh& part, const FlattenOptions& options,
                              const UnfoldScript& steps);

} // namespace spia
