#pragma once
#include <span>

#include "engine/options/option.h"

namespace spia {

/// All that are described.
std::span<const Option* const> all_options();
std::span<const Advice* const> all_advice();

} // namespace spia
