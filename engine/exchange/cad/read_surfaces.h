#pragma once
#include <filesystem>
#include <vector>

#include "engine/nurbs/surface.h"

namespace spia {

/// The B-spline surfaces under the faces of a file, in the file's order, in mm, as OpenCASCADE
/// understands it. Trimming curves are not looked at; knots are mapped to 0..1 where they are not.
/// @throws ExchangeError if the file cannot be opened, is damaged, cut short or holds no face;
/// InputError if a face is
///         not a B-spline surface (names it)
std::vector<NurbsSurface> read_iges_surfaces(const std::filesystem::path& path);
std::vector<NurbsSurface> read_step_surfaces(const std::filesystem::path& path);

} // namespace spia
