#pragma once
#include <optional>
#include <string>

#include "engine/nurbs/certificate.h"

namespace spia {

/// What keeps the surface from analysis, in words, e.g. "it folds at ..."; nothing if nothing does.
/// No shortcoming of a run: a surface for CAD may do without, and a corner of the grid on a smooth
/// outline has no angle.
std::optional<std::string> unsuited(const Certificate& certificate);

} // namespace spia
