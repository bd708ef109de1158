#pragma once
#include <filesystem>

#include "engine/mesh/tri_mesh.h"

namespace spia::shapes {

/// Writes a binary STL (.stl) or a Wavefront OBJ (.obj, rounded to 1e-6 mm), as the ending says.
/// @throws InputError for another ending, ExchangeError if the file cannot be written
void write_mesh(const std::filesystem::path& file, const TriMesh& mesh);

} // namespace spia::shapes
