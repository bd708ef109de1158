#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/forming/material/material.h"

namespace spia {

/// A value of a grade that makes no sense.
struct MaterialFault {
    std::string key;             ///< as in the material file: "young_MPa", "hardening/K_MPa",
                                 ///< "forming_limit/minor"
    std::string what;            ///< "must be above 0", "the curve falls at strain 0.12"
    std::optional<double> value; ///< the number at fault, where `what` does not tell it
    int entry = -1;              ///< of a list, from 0
};

/// What is wrong with a grade, in the order of its file; none: it can be used. read_material()
/// takes only such grades.
std::vector<MaterialFault> faults_of(const Material& material);

} // namespace spia
