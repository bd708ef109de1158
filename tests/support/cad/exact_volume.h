#pragma once
#include <filesystem>

namespace spia::shapes {

/// mm3, of the solids of a STEP file: integrated over their CAD faces by OpenCASCADE, without any
/// triangle. @throws std::runtime_error
double exact_volume(const std::filesystem::path& step);

} // namespace spia::shapes
