#pragma once
#include <filesystem>

namespace spia {

/// Solids as STEP files of OpenCASCADE, in mm and radians.
void write_box(const std::filesystem::path& step, double x, double y, double z);
/// From the radius `bottom` in the plane z = 0 to `top`, with both lids.
void write_cone(const std::filesystem::path& step, double bottom, double top, double height);

} // namespace spia
