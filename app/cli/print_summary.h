#pragma once
#include "engine/pipeline/session.h"

namespace spia::cli {

/// Prints what the chain found. @param session solved at least
void print_summary(const Session& session);

} // namespace spia::cli
