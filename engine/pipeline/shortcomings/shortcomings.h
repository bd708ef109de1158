#pragma once
#include <string>
#include <vector>

#include "engine/pipeline/session.h"

namespace spia {

/// What makes a result poorer than it should be, in words; empty if nothing does. (Command line:
/// exit 1 with --strict.)
std::vector<std::string> shortcomings(const Session& session);

} // namespace spia
