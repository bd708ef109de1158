#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "tests/support/cad/bent_solid.h"

/// Solids of drawn sheet as a CAD system makes them. In the library spia_cad_support.
namespace spia::shapes {

struct DrawnSolid {
    std::string kind;     ///< in words
    double thickness = 0; ///< mm
    std::optional<double> middle_area =
        {}; ///< mm2, in closed form or from the volume; boxes with a draft or a brim are
            ///< not as thick everywhere
};

/// Writes one of a family drawn at random, none of which has a bend that a press brake makes: cups,
/// flanged and stepped ones, cones, domes with a flange; boxes with rounded corners, upright or
/// with draft, and with a sharp brim.
DrawnSolid write_drawn_solid(const std::filesystem::path& file, std::uint64_t seed, CadForm form = CadForm::step);

/// A sheet rolled to a part of a cone.
struct ConicalSheet {
    double thickness = 2; ///< mm
    double from = 40;     ///< mm, from the axis to the middle surface at the narrow end
    double length = 60;   ///< mm, along the rulings
    double slope = 0.5;   ///< radians, of the rulings against the plane across the axis
    double turn = 3;      ///< radians about the axis, below a full turn

    double to() const; ///< mm, likewise at the wide end
    double middle_area() const;
};
void write_conical_sheet(const std::filesystem::path& file, const ConicalSheet& sheet, CadForm form = CadForm::step);

/// A sheet rolled to waves of random length and height: one smooth spline face on either side, bent
/// nowhere along a line. As a STEP file.
void write_waved_sheet(const std::filesystem::path& file, std::uint64_t seed);

} // namespace spia::shapes
