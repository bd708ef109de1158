#pragma once
#include <filesystem>

#include "tests/support/plane_faces.h"

namespace spia::shapes {

/// A STEP file of the solid that a section in the xz plane sweeps from y = 0 to the length, mm.
/// @param round  radii of the corners, mm; 0 and not given: sharp
void write_prism(const std::filesystem::path& file, const PlaneLoop& section, double length,
                 const std::vector<double>& round = {});

} // namespace spia::shapes
