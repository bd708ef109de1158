#pragma once
#include <filesystem>

namespace spia {

/// What lies between two squares of 20 mm in a row along x, in the plane z = 0, as face 1.
enum class ThirdFace {
    none,
    torn,  ///< its border is far from its surface
    sliver ///< between both, widest at 20, 10, 0
};
constexpr double sliver_width = 1e-9; // mm

/// Writes them as BREP.
void write_two_squares(const std::filesystem::path& brep, ThirdFace third);

} // namespace spia
