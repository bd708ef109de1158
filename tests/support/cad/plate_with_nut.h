#pragma once
#include <filesystem>

namespace spia::shapes {

/// A plate around the z axis with a nut joined to it over a hole.
struct PlateWithNut {
    double size = 60, thickness = 2; ///< mm
    double hole = 3;                 ///< mm, radius in the plate
    double inner = 2.5, outer = 6;   ///< mm, radii of the nut
    double height = 5;               ///< mm, of the nut above the plate
};
void write_plate_with_nut(const std::filesystem::path& file, const PlateWithNut& plate);

} // namespace spia::shapes
