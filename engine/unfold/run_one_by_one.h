#pragma once
#include <functional>

#include "engine/unfold/unfold_script.h"

namespace spia {

/// run_unfolding() step by step, with the same result: what has ended before it is cancelled has been seen.
/// @param watch sees the run after each step; may be empty
/// @param progress from 0, before the first step that is not kept, to 1
/// @throws InputError as run_unfolding(), of the friction of a step only when it is its turn
UnfoldRun run_one_by_one(const TriMesh& part, const UnfoldScript& script, const FlattenOptions& options,
                         const std::function<void(const UnfoldRun&)>& watch, const Progress& progress = {},
                         const UnfoldRun* before = nullptr, size_t keep = 0);

} // namespace spia
