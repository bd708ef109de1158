#pragma once
#include <filesystem>

#include "tests/support/plane_faces.h"

namespace spia::shapes {

/// A STEP file of the solid that a section in the xz plane sweeps from y = 0 to the length, mm.
void write_prism(const std::filesystem::path& file, const PlaneLoop& section, double length);

} // namespace spia::shapes
