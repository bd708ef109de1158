#pragma once
#include <functional>
#include <optional>
#include <string>

#include "app/viewer/model/document/document.h"
#include "engine/core/progress.h"
#include "engine/mesh/closest_point.h"
#include "engine/pipeline/run_chain.h"

namespace spia::viewer {

/// The first stage whose result is missing or was made with other options than are wanted now; none
/// if all is up to date. Old results stay to be looked at until newer ones take their place.
std::optional<Stage> first_stale(const Document& document);

/// Whether a surface is the same with either, on one blank.
bool makes_same_surface(const SessionOptions& a, const SessionOptions& b);

/// Whether a blank of steps is still that of the document's list.
bool holds(const Document& document, const BlankOfSteps& steps);

/// The results with the options they were made with, for what leaves the program.
Session as_made(const Document& document);

/// Says that results are older than the options; empty if they are not, or if there are none.
std::string out_of_date(const Document& document);

/// What a run of the chain left behind.
struct ChainResult {
    Session session;             ///< with every stage that has ended; of the others as it was
    SessionOptions made_with;    ///< the options its results were made with
    std::optional<Stage> failed; ///< the stage that has no result
    std::string message;         ///< why, in words
    bool cancelled = false;
    /// Of a part that has just been read, to find the picks of the one before; made here because it
    /// takes a while.
    std::shared_ptr<const ClosestPointSearch> search;
    std::shared_ptr<const PartFile> refused; ///< the part, if its mesh was the reason
};

/// Share of the time of the whole chain that these stages take, roughly; between 0 and 1.
double share_of_time(Stage from, Stage to);

/// Runs the stages from `from` to `to` and notes the options they are made with; never throws. What
/// a cancelled or failed run has finished is kept. The deformation of the session is left out: it
/// is of the surface that there was. The options of the result have the wishes of a part that was
/// read.
/// @param ended  called on this thread after every stage, with all that has been finished so far
/// @param watch  sees the blank while it is solved for, on this thread
ChainResult run_and_note(Session session, SessionOptions made_with, Stage from, Stage to, const Progress& progress,
                         const ChainWishes& wishes = {}, const std::function<void(const ChainResult&)>& ended = {},
                         const StepWatch& watch = {});

/// What to do about a stage that failed, in one sentence. @param options that it was to be made
/// with
std::string advice(Stage failed, const SessionOptions& options);

/// What to do about a blank that solves a weaker system than wanted, in one sentence; empty for the
/// strict one.
std::string advice(const SolveReport& report);

} // namespace spia::viewer
