#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/forming/material/material.h"

namespace spia {

/// The grades of a folder: its files *.json, sorted by name, so that their order is the same
/// everywhere.
/// @throws InputError if the folder cannot be read or holds no grade
std::vector<std::filesystem::path> material_files(const std::filesystem::path& folder);

/// Reads every grade of a folder, in the order of material_files.
/// @throws InputError if a file is at fault (see read_material) or one name would mean two grades
std::vector<Material> read_materials(const std::filesystem::path& folder);

/// Finds a grade by the stem of its file ("dp600") or by its name ("Dual phase steel DP600"),
/// whatever the case; otherwise reads the user's own file of that path. What has a folder or the
/// extension .json and is a file is always read as one.
/// @throws InputError if there is neither; lists the known grades and suggests the closest one
Material find_material(const std::string& name_or_file, const std::filesystem::path& folder);

} // namespace spia
