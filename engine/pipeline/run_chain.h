#pragma once
#include <exception>
#include <functional>
#include <optional>
#include <string>

#include "engine/core/progress.h"
#include "engine/pipeline/files/deform_file.h"
#include "engine/pipeline/session.h"

namespace spia {

/// What is asked for before there is the part or the surface that it hangs on. It joins the options
/// of the session once that is there, in a run that makes it.
struct ChainWishes {
    /// mm, of the flat sheet. Not given: that of the part, else that of the options.
    std::optional<double> thickness = {};
    /// Process conditions that name faces or places of the part. Not given: those of the options.
    /// @param sheet  of the options, with its thickness
    std::function<ProcessConditions(const PartFile& part, const FlattenOptions& sheet)> process = {};
    /// Of the finished surface; its lattice may have to be laid around it. Not given: that of the
    /// options.
    std::optional<DeformationWish> deformation = {};
};

/// Who is told of a run, on the thread that runs it. What one of them throws ends the run as if the
/// stage had thrown it.
struct ChainHooks {
    /// Before a stage. @returns what takes its progress, from 0 to 1, and may cancel it; not given:
    /// nothing
    std::function<Progress(Stage)> begins;
    /// The stage has its result, and `session.seconds` its time.
    std::function<void(Stage, const Session& session)> ended;
    /// Sees the blank while it is solved for.
    StepWatch watch = {};
    /// The part is read and the wishes of it are in the options; the next stage has not begun.
    std::function<void(const Session& session)> part_is_ready;
};

/// The stage that has no result, or after which the run could not go on, and why.
struct Failure {
    Stage stage;
    std::string message;
};

/// What a run of the chain gave.
struct ChainRun {
    Session session;                ///< with the results and times of all stages that have ended
    std::optional<Failure> failure; ///< none: all the stages have ended
    std::exception_ptr error;       ///< what was thrown; null: nothing
};

/// Runs the stages from `first` to `last` in the order of the chain, on a copy of the session. With
/// a layout of patches, grid and lift are passed through without a result. A stage without a result
/// ends the run: the run says which and why, and what was made before is kept.
/// @throws Cancelled  if its owner asks for it, at the next checkpoint of the running stage; what
///                    has ended by then was told to the hooks
ChainRun run_chain(Session session, Stage first = Stage::read, Stage last = Stage::fit, const ChainWishes& wishes = {},
                   const ChainHooks& hooks = {});

/// The session of a run that came to its end.
/// @throws what ended it, if anything did
Session completed(ChainRun run);

} // namespace spia
