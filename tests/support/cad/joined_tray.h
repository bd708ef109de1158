#pragma once
#include <filesystem>

#include "tests/support/cad/bent_solid.h"

namespace spia::shapes {

/// A tray whose walls are joined at sharp corners, welded say, and bent up from the floor with a
/// radius.
struct JoinedTray {
    double length = 100, width = 70, height = 20; ///< mm, outside
    double thickness = 1, radius = 1.5;           ///< mm, of the sheet; inside of the bends

    /// mm2, of the middle surface: floor, bends between mitres, walls
    double area() const;
};

void write_joined_tray(const std::filesystem::path& file, const JoinedTray& tray, CadForm form = CadForm::step);

} // namespace spia::shapes
