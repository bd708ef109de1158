#pragma once
#include <string>

#include "engine/forming/material/material.h"

namespace spia {

/// A grade as the text of a material file: read_material() gives the same grade again, every number
/// to its last bit.
std::string material_text(const Material& material);

/// The value of its key "hardening", JSON: {"law": "voce", "sigma0_MPa": ...}.
std::string hardening_text(const Hardening& law);

} // namespace spia
