#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/soup.h"

namespace spia {

/// Polygons of a file, in its unit.
struct MeshFile {
    PolygonSoup soup;
    std::string format;
    std::vector<std::string> notes;
};

/// The ending of a file that parts are read from, in lower case and without its dot: of a mesh file
/// stl, obj, ply, off, gltf or glb, else of a deck (is_deck()) or a CAD file (is_cad()).
/// @throws InputError  it is none of these
std::string part_extension(const std::filesystem::path& path);

/// @param extension  of a mesh file
/// @throws InputError  the file is damaged
MeshFile read_mesh_file(const std::filesystem::path& path, std::string_view extension, const Progress& progress);

} // namespace spia
