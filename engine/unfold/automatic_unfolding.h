#pragma once
#include <functional>

#include "engine/unfold/plan/sequence.h"
#include "engine/unfold/step/unfold_script.h"

namespace spia {

/// Called after every step with the plan at work and its states so far.
using StepEnded = std::function<void(const UnfoldScript& plan, const UnfoldRun& so_far)>;

struct AutomaticUnfolding {
    UnfoldSequence sequence; ///< of the run; its notes also tell which steps of earlier plans had
                             ///< no result
    UnfoldRun run;
    size_t given_up = 0; ///< how many of the notes, the last ones, tell of these
};

/// Proposes the steps of a part and runs them. Where a step has no result or does not converge, its
/// carrier carries nothing in a new plan, in which what lay on it moves with its neighbours (what
/// cannot be unrolled is flattened); the steps before it that stay the same are kept. So it is with
/// a step that strains the sheet by more than 5 % and more than the flattening of the whole part
/// does at last. If no plan is without fault it is the first one whose steps converge, else the
/// first that ended in a blank. Where not even flattening all at once has a result the run says so.
/// @param progress of the plan at work: from none on again where it is planned anew
/// @param begun of an earlier run on this part in this sheet, which may have been cancelled: steps
/// with which the first plan begins
///              likewise are not solved again
/// @throws UnfoldingCancelled with the plan at work and its states; InputError as
/// propose_sequence() and run_unfolding()
AutomaticUnfolding automatic_unfolding(const TriMesh& part, const BendMap& map, SequenceOptions sequence,
                                       const FlattenOptions& options, const Progress& progress = {},
                                       const AutomaticUnfolding* begun = nullptr, const StepEnded& ended = {});

} // namespace spia
