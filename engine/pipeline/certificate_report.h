#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "engine/nurbs/certificate.h"

namespace spia {

/// `certificate` of the report, the contract of engine/pipeline/README.md.
nlohmann::ordered_json certificate_json(const Certificate& certificate);

/// What keeps the surface from analysis, in words, e.g. "it folds at ..."; nothing if nothing does.
/// No shortcoming of a run: a surface for CAD may do without, and a corner of the grid on a smooth
/// outline has no angle.
std::optional<std::string> unsuited(const Certificate& certificate);

} // namespace spia
