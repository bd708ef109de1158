#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/forming/material/fit_hardening.h"
#include "engine/forming/material/material.h"
#include "engine/forming/material/tensile_test.h"

namespace spia {

/// How a table is to be understood, and what a tensile curve does not tell of a sheet.
struct MaterialFitOptions {
    TensileOptions test;
    std::string law = "best"; ///< a name as law_name(), or "best": best_fit()
    std::string name;         ///< of the grade
    double poisson = 0.3;
    double density_kg_m3 = 7850;
    double r0 = 1, r45 = 1, r90 = 1; ///< Lankford coefficients
    friend bool operator==(const MaterialFitOptions&, const MaterialFitOptions&) = default;
};

struct MaterialFit {
    TensileTest test;
    std::vector<LawFit> fits;
    size_t taken = 0; ///< of the fits, the one that became the material's law
    Material material;
};

/// Makes a material of a tensile test. Its source tells the table, the law and the error of the
/// fit.
/// @throws InputError if the table cannot be read or is no tensile test, or the wanted law does not
/// fit
MaterialFit fit_material(const std::filesystem::path& table, const MaterialFitOptions& options);

} // namespace spia
