#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/core/progress.h"
#include "engine/exchange/file_format.h"
#include "engine/mesh/soup.h"

namespace spia {

/// Polygons of a file, in its unit.
struct MeshFile {
    PolygonSoup soup;
    std::string format;
    std::vector<std::string> notes;
    std::optional<LengthUnit> unit = {}; ///< that the specification of the format states
    bool own_corners = false;            ///< faces may each have their own where they meet
};

/// Those that read_mesh_file() reads.
std::vector<FileFormat> mesh_file_formats();

/// @param path  of one of the mesh_file_formats()
/// @throws InputError  the file is damaged
MeshFile read_mesh_file(const std::filesystem::path& path, const Progress& progress);

} // namespace spia
