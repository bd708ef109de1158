#pragma once
#include <string>
#include <vector>

#include "engine/unfold/sequence.h"
#include "engine/unfold/unfold_script.h"

namespace spia {

struct UnfoldedByItself {
    UnfoldSequence sequence; ///< of the run; its notes also tell which steps of earlier plans had no result
    UnfoldRun run;
};

/// Proposes the steps of a part and runs them. Where a step has no result or does not converge, its carrier carries nothing in
/// a new plan, in which what lay on it moves with its neighbours (what cannot be unrolled is flattened); the steps before it
/// that stay the same are kept; if no plan is without fault it is the first one whose steps converge, else the first that ended in a blank. So it is with a step that strains
/// the sheet by more than 5 % and more than the flattening of the whole part does at last. Where not even flattening all at
/// once has a result the run says so.
/// @throws InputError as propose_sequence() and run_unfolding(), or if the part is flat already
UnfoldedByItself unfold_by_itself(const TriMesh& part, const BendMap& map, SequenceOptions sequence,
                                  const FlattenOptions& options, const Progress& progress = {});

} // namespace spia
