#pragma once
#include <filesystem>

#include "engine/exchange/export_scene.h"

namespace spia {

/// The nodes of a file, each with its name there: which are wanted.
struct GltfNodes {
    bool part = true, blank = true, quad_mesh = true, surface = true, control_net = true;

    friend bool operator==(const GltfNodes&, const GltfNodes&) = default;
};

/// Writes the scene as glTF 2.0: one binary file for .glb, else JSON with the buffer inside
/// (.gltf).
///
/// A root node named after the part turns mm and Z up into metres and Y up. Below it stand the
/// nodes part, blank (flat, beside the part, level with its lowest point), quad_mesh, surface and
/// control_net (one primitive for each patch, with its counts and degrees in extras), as far as
/// they are wanted and the scene has them.
/// With zones both carry _ZONE, the number of the worst zone around each vertex, and the asset's
/// extras name the numbers. Part and blank carry _THICKNESS, _THINNING, _STRAIN_MAJOR,
/// _STRAIN_MINOR, _STRAIN_EQUIVALENT per vertex, and COLOR_0: thinning in the colour map named,
/// with its range, in the extras of the mesh and of the asset. Vertices are float32 mm about a
/// whole-millimetre centre, which is the node's translation (the blank's is blank_origin_mm in its
/// extras).
/// @throws InputError if the scene is incomplete or not finite, or nothing of it is wanted;
/// ExchangeError if the file cannot be written
void write_gltf(const std::filesystem::path& path, const ExportScene& scene, const GltfNodes& nodes = {});

} // namespace spia
