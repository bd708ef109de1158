#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/pipeline/session.h"

namespace spia {

/// Formats by the names the command line uses.
const std::vector<std::string>& output_formats();

/// Finds out what would keep write_outputs() from writing, before the work that fills the files; makes the folder.
/// @param other one more file that the caller will write; may be empty
/// @throws InputError if a format is unknown; ExchangeError if a place cannot be written, or a file would take the place of
///         the part itself or of another output
void require_place(const Session& session, const std::filesystem::path& folder, const std::vector<std::string>& formats,
                   const std::filesystem::path& other = {});

/// Writes the results of a session, solved at least, into a folder, which is made if need be: PART.iges, PART.step, PART.glb,
/// PART.vtu, PART.dxf, PART.png, and for csv the two tables fields.csv and outline.csv. Each file appears whole or not
/// at all. What has no surface yet leaves out IGES and STEP, and of the other files what belongs to it.
/// @param formats some of output_formats()
/// @returns the files, in the order of `formats`
/// @throws InputError if the part is not solved or a format is unknown; ExchangeError if a file cannot be written
std::vector<std::filesystem::path> write_outputs(const Session& session, const std::filesystem::path& folder,
                                                 const std::vector<std::string>& formats,
                                                 const Progress& progress = {});

} // namespace spia
