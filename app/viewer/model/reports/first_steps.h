#pragma once
#include <string>

#include "app/viewer/model/document/state.h"

namespace spia::viewer {

/// What somebody who has opened the sample part can do next: only what has not been done yet; empty
/// while it runs, and when all is done.
std::string first_steps(const ViewerState& state, bool exported);

} // namespace spia::viewer
