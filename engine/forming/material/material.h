#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/forming/material/hardening.h"

namespace spia {

/// What is known of where a grade begins to neck, for forming_limits(); without it the metal and
/// its hardening law decide.
struct GradeLimit {
    std::optional<double> n;          ///< for the curve of Keeler-Brazier; else the uniform strain
                                      ///< of the law
    std::vector<double> minor, major; ///< points of a measured curve, engineering strains, minor
                                      ///< rising; empty: none
    friend bool operator==(const GradeLimit&, const GradeLimit&) = default;
};

/// A sheet grade: elasticity, hardening and the r-values of Hill's 1948 yield criterion.
struct Material {
    std::string name;
    double young_MPa = 0;
    double poisson = 0;
    double density_kg_m3 = 0;
    Hardening hardening;
    double r0 = 1, r45 = 1, r90 = 1; ///< Lankford coefficients along, at 45 degrees and across the
                                     ///< rolling direction
    std::string source;              ///< where the values come from; may be empty for a user's file
    GradeLimit limit = {};

    /// Mean normal anisotropy (r0 + 2 r45 + r90) / 4, the r of the plane-stress law that the solver
    /// uses.
    double normal_anisotropy() const { return (r0 + 2 * r45 + r90) / 4; }
    friend bool operator==(const Material&, const Material&) = default;
};

/// Whether sheets of both are formed alike: their names, sources and forming limits may differ.
bool formed_alike(const Material& a, const Material& b);

/// Reads a material file (JSON, the form is documented in assets/materials/README.md).
/// @throws InputError if a value is missing or makes no sense; names the key
Material read_material(const std::filesystem::path& file);
/// The same of the text of such a file. @param where  for messages: the file, or what stands for it
Material material_from(const std::string& text, const std::string& where);

} // namespace spia
