#pragma once
#include "engine/core/json_file.h"
#include "engine/unfold/target/target_surface.h"

namespace spia {

/// "plane", "cylinder", "cone" or "smooth" of a script of steps and of what they gave; lengths in
/// mm. A smooth one is found again from its carrying faces.
Json target_json(const TargetSurface& face);

} // namespace spia
