#pragma once
#include <functional>

#include "engine/unfold/sequence.h"
#include "engine/unfold/unfold_script.h"

namespace spia {

struct UnfoldedByItself {
    UnfoldSequence sequence; ///< of the run; its notes also tell which steps of earlier plans had no result
    UnfoldRun run;
    size_t given_up = 0; ///< how many of the notes, the last ones, tell of these
};

/// Sees the plan at work and its run so far, after each of its steps.
using PlanWatch = std::function<void(const UnfoldSequence& plan, const UnfoldRun& run)>;

/// Proposes the steps of a part and runs them. Where a step has no result or does not converge, its carrier carries nothing in
/// a new plan, in which what lay on it moves with its neighbours (what cannot be unrolled is flattened); the steps before it
/// that stay the same are kept; if no plan converges it is the first one that ended in a blank. Where not even flattening all at
/// once has a result the run says so.
/// @param progress of the plan at work: from none on again where it is planned anew
/// @param begun what a watch has seen of an earlier run on this part in this sheet: steps with which the first plan begins likewise
///              are not solved again
/// @throws InputError as propose_sequence() and run_unfolding(), or if the part is flat already
UnfoldedByItself unfold_by_itself(const TriMesh& part, const BendMap& map, SequenceOptions sequence,
                                  const FlattenOptions& options, const Progress& progress = {},
                                  const PlanWatch& watch = {}, const UnfoldedByItself* begun = nullptr);

} // namespace spia
