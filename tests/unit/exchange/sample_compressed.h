#pragma once
#include <string>

#include "engine/mesh/tri_mesh.h"

/// Meshes in binary glTF as compressing programs write them, by the encoders of the two libraries.
/// One unit is a metre.
namespace spia::sample {

/// EXT_meshopt_compression: positions as numbers of single precision, triangles in lists. @param
/// fallback a second buffer stands in for what is decoded, as gltfpack writes it
std::string glb_by_meshopt(const TriMesh& mesh, bool fallback = false);

/// KHR_draco_mesh_compression. @param bits of a position; 0: not rounded @param mirrored by its
/// node, in x
std::string glb_by_draco(const TriMesh& mesh, int bits = 0, bool mirrored = false);

} // namespace spia::sample
