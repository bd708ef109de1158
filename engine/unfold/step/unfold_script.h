#pragma once
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/unfold/plan/sequence.h"
#include "engine/unfold/step/landed_overlap.h"
#include "engine/unfold/step/unfold_step.h"
#include "engine/unfold/target/target_reach.h"

namespace spia {

/// What the tolerance of a step may be.
constexpr double least_step_tolerance = 1e-14, most_step_tolerance = 0.1;

/// The steps that unfold a part, in order.
using UnfoldScript = std::vector<PlannedStep>;

/// A part after one step of a script.
struct UnfoldState {
    std::string name;                           ///< of the step
    Eigen::Matrix3Xd position;                  ///< 3 by #V, mm
    SheetFields face;                           ///< #F: of forming what was moved so far into the
                                                ///< part; a face never moved has no strain
    Eigen::VectorXi step;                       ///< #F: the last step that moved the face, from 1;
                                                ///< 0: none
    std::optional<TargetFit> on;                ///< the target; none for an unroll
    std::string plain;                          ///< plane, cylinder, cone: what it was laid on or
                                                ///< unrolled from
    bool converged = true;                      ///< else the best shape found
    std::string reason;                         ///< why not, or what else is not as asked for: the
                                                ///< curve, friction, relaxed vertices
    SolvedSystem system = SolvedSystem::strict; ///< the poorest of its pieces; of an unroll, which
                                                ///< solves nothing, strict
    double trusted_strain = 0;                  ///< the least with which one was solved; 0: none
                                                ///< was
    int necking = 0;                            ///< faces beyond the trusted strain
    LandedOverlap overlap;                      ///< of all that lies on the target after the step;
                                                ///< of an unroll, in the plane
    TargetReach reach;                          ///< of what was laid; zero where nothing carries
                                                ///< the target
    double seconds = 0;
    double friction_share = 1; ///< of the step's friction that is in the state: below 1 the sheet
                               ///< does not bear it
};

struct UnfoldRun {
    std::vector<UnfoldState> states; ///< one per step that was done
    std::string failure;             ///< empty, or why the step after the last state had no result
    std::optional<Blank> blank;      ///< if all steps were done and the part lies in one plane
    int flipped = 0;                 ///< triangles of the blank
};

/// The user asked to stop: what was done until then.
struct UnfoldingCancelled : Cancelled {
    UnfoldingCancelled(UnfoldScript script, UnfoldRun run) : steps(std::move(script)), done(std::move(run)) {}

    UnfoldScript steps; ///< all that were to be done
    UnfoldRun done;     ///< the states of the leading ones; no blank
};

/// Runs all steps; of a step that has no result the run keeps the states before it.
/// @param before of a run of the same part whose first `keep` steps are those of this script: they
/// are not solved again
/// @param ended called after every step, with the states so far
/// @param progress one checkpoint per iteration; cancelling takes effect at the next one
/// @throws UnfoldingCancelled with the states of the steps before
/// @throws InputError if there is no step, an option or the friction of a step is not as described
/// or there are fewer steps before
///                    than to keep
UnfoldRun run_unfolding(const TriMesh& part, const UnfoldScript& script, const FlattenOptions& options,
                        const Progress& progress = {}, const UnfoldRun* before = nullptr, size_t keep = 0,
                        const std::function<void(const UnfoldRun& so_far)>& ended = {});

/// Whether what was laid bends at its hinge: the target is farther beside the fixed faces, or
/// turned more against them, than the last facet of a fillet is. @param diagonal of the part, mm
bool creased(const TargetFit& target, double diagonal);

/// The face moved to its outer side; a smooth one along the normal of its plane. @throws InputError
/// if a cylinder or cone would vanish
TargetSurface moved_out(const TargetSurface& face, double mm);

/// The plane in which the development of a face lies where it touches it in the middle of some
/// places.
PlaneFace tangent_plane(const TargetSurface& face, const Eigen::Matrix2Xd& places);

} // namespace spia
