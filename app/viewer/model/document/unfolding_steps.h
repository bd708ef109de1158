#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/progress.h"
#include "engine/part/part_file.h"
#include "engine/unfold/plan/k_factor.h"
#include "engine/unfold/step/unfold_script.h"

/// Unfolding step by step: the list that the user edits, and what its last run gave.
namespace spia::viewer {

struct Document;

/// Steps in order. Each is finished and const, so that copies of a document share them; an edited
/// one is a new one.
using StepList = std::vector<std::shared_ptr<const PlannedStep>>;
StepList step_list(UnfoldScript steps);
UnfoldScript script_of(const StepList& list);

/// A part split at its bends.
struct PartBends {
    std::shared_ptr<const PartFile> part;
    BendMap map;
};
/// @param known those of this part, if they are; else, and if null, they are found
std::shared_ptr<const PartBends> bends_of(std::shared_ptr<const PartFile> part, std::shared_ptr<const PartBends> known);

/// Of the faces that a step moves, after it.
struct StepFigures {
    std::array<double, 2> thinning; ///< least and greatest, shares
    double strain_equivalent;       ///< greatest
    /// Where faces were laid on a target and hang on others: how far these end beside it, and by
    /// how much it turns from them.
    struct Hinge {
        double distance_mm, angle_deg; ///< greatest
        bool bad;                      ///< so far that the sheet has a step or a crease there
    };
    std::optional<Hinge> hinge;
};

/// Steps as they were proposed. As long as the list is still theirs, a run plans anew where one
/// does not work out.
struct Proposal {
    std::shared_ptr<const PartFile> part;
    int root; ///< of SequenceOptions
    StepList steps;
};
/// Whether the list is a proposal for the part, none of it edited.
bool still_proposed(const Document& document);

/// The size of the blank of steps, mm, with its bends laid by a K factor, as the blank has it that
/// is made of these steps.
struct LaidSize {
    std::optional<KFactor> k;
    Eigen::Vector2d size;
    std::vector<std::string> doubts = {}; ///< bends that are not laid with their allowance
};

/// What a run gave, and what it was made with.
struct StepsRun {
    std::shared_ptr<const PartFile> part;
    StepList steps;
    FlattenOptions sheet; ///< as sheet_of_steps() gives it
    UnfoldRun run;
    std::vector<StepFigures> figure;        ///< one per state
    std::vector<std::string> given_up = {}; ///< steps of a proposal that did not work out, and why:
                                            ///< it was planned anew
    std::optional<LaidSize> laid = {};      ///< not given: there is no blank, or it has flips
};

/// The sheet of the steps: material, gauge, tailored pieces, rolling direction. Tools act on the
/// part as a whole and are left out.
FlattenOptions sheet_of_steps(const FlattenOptions& wanted);

/// What of the document's process that is, in a sentence; empty: nothing.
std::string left_out_by_steps(const Document& document);

/// How many leading steps of the document's list the states of its last run hold for: the next one
/// was edited, is new, had no result, or its part or sheet is another one now.
size_t steps_done(const Document& document);
/// Whether all steps are done and the run went no further, so that its blank is that of the list.
bool all_steps_done(const Document& document);
/// Of the blank of the last run; nothing if there is none. By the K factor that is wanted now where
/// the blank is in use, for it is then laid anew, else by that of the run: the size says which.
std::optional<LaidSize> size_of_blank(const Document& document);
/// Behind that size: ", K 0.42" where another K factor is wanted now, else empty.
std::string of_other_k(const Document& document, const LaidSize& size);

enum class StepStatus { missing, done, poor, stale, failed, needs_pick };
std::string_view name(StepStatus status);
StepStatus step_status(const Document& document, size_t step);

/// Where the vertices of the part are. @param position 0: on the part; k: after step k; between: on
/// the way, each along an arc if its sheet turns. No more than there are states that hold.
Eigen::Matrix3Xd unfolded_places(const Document& document, double position);

/// Whether it has no target and what carried it is gone from a changed part.
bool needs_pick(const PlannedStep& step);

/// What a job about steps left behind.
struct StepsOutcome {
    std::optional<StepList> proposed;
    int root = -1;                          ///< of the proposal, see SequenceOptions
    std::vector<std::string> notes;         ///< of the proposal, or what of a file made no sense on
                                            ///< the part
    std::filesystem::path opened, saved;    ///< files; empty: none
    std::shared_ptr<const PartBends> bends; ///< null: not asked for
    std::shared_ptr<const StepsRun> run;    ///< null likewise; of a cancelled one with the steps
                                            ///< that had ended
    bool cancelled = false;
    std::string failure; ///< why there is nothing at all
};

/// Gets what a run would leave behind if it were cancelled now, after every step that has ended.
using StepsSoFar = std::function<void(StepsOutcome)>;

/// Proposes the steps of a part; never throws. @param bends those of this part if they are known,
/// else null
/// @param keep a face whose region stays where it is; not given: the largest flat one
StepsOutcome propose_steps(std::shared_ptr<const PartFile> part, std::shared_ptr<const PartBends> bends,
                           std::optional<int> keep, const Progress& progress);

/// Reads the steps of a file of the command line (engine/pipeline/files/unfold_file.h); never
/// throws.
/// @param bends as above
StepsOutcome open_steps(std::shared_ptr<const PartFile> part, std::shared_ptr<const PartBends> bends,
                        const std::filesystem::path& file, const Progress& progress);

/// Writes such a file; never throws. @param bends as above
StepsOutcome save_steps(std::shared_ptr<const PartFile> part, std::shared_ptr<const PartBends> bends,
                        const StepList& steps, const std::filesystem::path& file, const Progress& progress);

/// Runs steps as they were proposed, by automatic_unfolding(): planned anew where one does not work
/// out, the run then has other steps, as it does where it is cancelled meanwhile; never throws.
/// @param bends as above; @param before of the same part and sheet, or null: what of it can stay is
/// not solved again
/// @param k as SessionOptions has it
StepsOutcome run_proposal(const Proposal& proposal, std::shared_ptr<const PartBends> bends, const FlattenOptions& sheet,
                          const std::optional<KFactor>& k, std::shared_ptr<const StepsRun> before,
                          const Progress& progress, const StepsSoFar& so_far = {});

/// Runs the steps after the first `done` ones, whose states are taken from `before`; never throws.
/// @param k as above
StepsOutcome run_steps(std::shared_ptr<const PartFile> part, StepList steps, const FlattenOptions& sheet,
                       const std::optional<KFactor>& k, std::shared_ptr<const StepsRun> before, size_t done,
                       const Progress& progress, const StepsSoFar& so_far = {});

} // namespace spia::viewer
