#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/support/cad/bent_solid.h"

/// Solids of drawn sheet as a CAD system makes them. In the library spia_cad_support.
namespace spia::shapes {

/// Writes one of a family drawn at random, none of which has a bend that a press brake makes: cups,
/// flanged and stepped ones, cones, domes with a flange; boxes with rounded corners, upright or
/// with draft, and with a sharp brim.
/// @returns what it is, in words
std::string write_drawn_solid(const std::filesystem::path& file, std::uint64_t seed, CadForm form = CadForm::step);

} // namespace spia::shapes
