#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/core/attempts.h"

namespace spia {

/// Those that were made, in their order; `attempts` within only where there are any.
nlohmann::ordered_json attempts_json(const std::vector<AttemptReport>& attempts);

} // namespace spia
