#pragma once
#include <filesystem>

#include "engine/core/progress.h"
#include "engine/part/part_file.h"
#include "engine/part/read_options.h"

namespace spia {

/// Reads a mesh (read_mesh_file()), the shells of a solver deck (read_deck()) or the faces of a CAD
/// file (read_cad()) as a sheet part: one piece with a boundary and no handles. A solid of sheet is
/// given by one of its skins (thin_solid()). What else is closed, has handles or is a tube is cut
/// open along a seam (cut_open()); the report says so and where.
/// Coordinates keep their full precision (STL and glTF hold single precision).
/// @throws InputError  the file cannot be read, or the doctor found a fault that cannot be repaired
PartFile read_part(const std::filesystem::path& path, const ReadOptions& options = {}, const Progress& progress = {});

/// The same, but a sick part is no error: its report says why read_part() refuses it.
/// @throws InputError  the file cannot be read
PartFile examine_part(const std::filesystem::path& path, const ReadOptions& options = {},
                      const Progress& progress = {});

} // namespace spia
