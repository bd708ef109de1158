#pragma once
#include "engine/pipeline/session.h"

namespace spia::cli {

/// Prints what the chain found. @param session solved at least
void print_summary(const Session& session);

/// What the lengths of a blank are lengths of, and its bends.
void print_bends(const BendTable& table);

} // namespace spia::cli
