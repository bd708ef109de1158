#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/soup.h"

namespace spia {

struct GltfContent {
    PolygonSoup soup;               ///< in file units; vertices node by node, primitive by
                                    ///< primitive
    std::vector<std::string> notes; ///< what was left out
};

/// Reads the triangles of the default scene (or of all root nodes, or of all meshes where there are
/// no nodes) with the transforms of their nodes; a mirrored node keeps the outer side outside. The
/// axes stay as they are: Y is up.
/// @param path  for .gltf: its folder is where buffers in files of their own are looked for, and
/// nowhere else
/// @param file  the content of the file, text or binary
/// What is compressed by EXT_meshopt_compression or KHR_draco_mesh_compression is decoded.
/// @throws InputError for damage and required extensions that change the geometry
GltfContent read_gltf(const std::filesystem::path& path, std::string_view file, const Progress& progress = {});

} // namespace spia
