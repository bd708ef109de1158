#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "engine/forming/hardening.h"

namespace spia {

/// A sheet grade: elasticity, hardening and the r-values of Hill's 1948 yield criterion.
struct Material {
    std::string name;
    double young_MPa = 0;
    double poisson = 0;
    double density_kg_m3 = 0;
    Hardening hardening;
    double r0 = 1, r45 = 1, r90 = 1; ///< Lankford coefficients along, at 45 degrees and across the rolling direction
    std::string source;              ///< where the values come from; may be empty for a user's file

    /// Mean normal anisotropy (r0 + 2 r45 + r90) / 4, the r of the plane-stress law that the solver uses.
    double normal_anisotropy() const { return (r0 + 2 * r45 + r90) / 4; }
    friend bool operator==(const Material&, const Material&) = default;
};

/// Reads a material file (JSON, the form is documented in assets/materials/README.md).
/// @throws InputError if a value is missing or makes no sense; names the key
Material read_material(const std::filesystem::path& file);

} // namespace spia
