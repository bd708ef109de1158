#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/exchange/file_format.h"

/// What parts are read from. Each format stands in the table of its readers: mesh_file_formats(),
/// deck_file_formats(), cad_file_formats(). What lists formats to people is made from these.
namespace spia {

enum class FileKind { cad, deck, mesh };

/// The kind of the file, by its ending; none: parts are not read from such files.
std::optional<FileKind> kind_of_file(const std::filesystem::path& path);

/// The same.
/// @throws InputError  parts are not read from such files; says from which they are
FileKind require_kind_of_file(const std::filesystem::path& path);

/// Of all formats, with their dots.
std::vector<std::string> part_endings();

/// As in: CAD files (STEP, IGES, BREP), solver decks (LS-DYNA, ...), meshes (STL, ...)
std::string part_format_names();
/// As in: CAD files (STEP .step .stp, IGES .iges .igs, ...), ...
std::string part_format_endings();

} // namespace spia
