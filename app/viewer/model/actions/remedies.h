#pragma once
#include <vector>

#include "app/viewer/model/actions/actions.h"
#include "app/viewer/model/reports/lights.h"

namespace spia::viewer {

/// What pressing a doubt's button does, made of the document as it is now; nothing where it has
/// none.
std::vector<Action> actions_of(const Doubt& doubt, const Document& document);

} // namespace spia::viewer
