#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/viewer/model/document/state.h"

/// Where file dialogs begin.
namespace spia::viewer {

/// The folder of the project, else of the part, else of the file that was opened last, else the
/// current one. The samples that come with the program lie where nobody works.
/// @param recent  files that were opened, the newest first
/// @param assets  folder of the program with the sample parts
std::filesystem::path working_folder(const ViewerState& state, const std::vector<std::filesystem::path>& recent,
                                     const std::filesystem::path& assets);

/// In that folder, with the name of the project or the part and this instead of its ending. "part"
/// where there is neither.
std::filesystem::path suggested_file(const ViewerState& state, const std::vector<std::filesystem::path>& recent,
                                     const std::filesystem::path& assets, const std::string& ending);

} // namespace spia::viewer
