#pragma once
#include "engine/pipeline/run_chain.h"

namespace spia::cli {

/// Runs the chain, each stage as a job that is shown on the standard error, until the user cancels.
/// @param part_is_ready  as ChainHooks
/// @throws Cancelled
ChainRun run_shown(Session session, Stage first, Stage last, const ChainWishes& wishes = {},
                   const std::function<void(const Session&)>& part_is_ready = {});

} // namespace spia::cli
