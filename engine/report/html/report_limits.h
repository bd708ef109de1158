#pragma once
#include <string>

#include "engine/pipeline/session.h"

namespace spia {

/// The forming limits of a report, as HTML: the strain diagram with the curve, the zones with their
/// definitions and shares, the worst spots. Empty if the session has no limits.
std::string limits_section(const Session& session, LengthUnit lengths = LengthUnit::mm);

} // namespace spia
