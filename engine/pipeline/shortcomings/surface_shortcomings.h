#pragma once
#include <optional>
#include <string>

#include "engine/pipeline/session.h"

namespace spia {

// What makes a surface poor, in words with the way out; nothing where it is good. @pre
// session.surface and session.part

/// Of a surface for which no tolerance was asked for: it is farther from the part than
/// usual_tolerance somewhere. (What was asked for and not reached is told by FitReport::shortfall.)
std::optional<std::string> far_surface(const Session& session);

/// It folds: the certificate is refused elsewhere than at a corner of the grid on a
/// smooth outline, where CAD does not mind, or samples look the other way than the part. Of a
/// deformed surface the one that leaves the program.
std::optional<std::string> folded_surface(const Session& session);

} // namespace spia
