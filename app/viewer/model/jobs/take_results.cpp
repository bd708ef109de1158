#include "app/viewer/model/jobs/viewer_model.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/picking/handles.h"
#include "app/viewer/model/picking/measuring.h"
#include "engine/core/error.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/pipeline/shortcomings/surface_shortcomings.h"

namespace spia::viewer {
namespace {

/// What the light of the surface says all the time needs no message.
bool of_its_surface(const Session& session, const std::string& text)
{
    return session.surface &&
           (text == folded_surface(session) || std::ranges::count(surface_shortcomings(session), text) > 0);
}

/// A grid for one patch that was made on the way to what the program chooses is none that anyone
/// asked for: what there was before stays.
void leave_out_grid_on_the_way(ChainResult& result, const Document& before)
{
    Session& now = result.session;
    if (!now.options.best_surface || now.surface || now.grid == before.session.grid)
        return;
    const bool same_blank = now.blank == before.session.blank;
    now.grid = same_blank ? before.session.grid : nullptr;
    now.lifted = same_blank ? before.session.lifted : nullptr;
    now.surface = same_blank ? before.session.surface : nullptr;
    now.no_grid = same_blank ? before.session.no_grid : "";
    result.made_with.corners = before.made_with.corners;
    result.made_with.grid = before.made_with.grid;
}

} // namespace

void ViewerModel::take_chain_result()
{
    const std::string title = state_.job.title;
    state_.job = JobView{};
    ChainResult result;
    try {
        result = chain_job_->finished() ? std::exchange(chain_job_, nullptr)->take() : leave_chain();
    } catch (const std::exception& error) { // no memory for a copy of the session
        opening_beside_.reset();
        say(Severity::error, error.what());
        return;
    }
    if (open_by_itself(result))
        return;
    // first it is read, then the user is asked
    if (opening_beside_ && result.session.part && asks_ && state_.document.unsaved) {
        const Opening& opening = *opening_beside_;
        state_.read_and_waits = opening.project_file.empty() ? opening.document.session.file : opening.project_file;
        waiting_ = std::move(result);
        return;
    }
    take_result(std::move(result), title);
}

void ViewerModel::take_result(ChainResult result, const std::string& title)
{
    if (opening_beside_ && !take_opening(result))
        return;
    Document& document = state_.document;
    if (result.cancelled)
        leave_out_grid_on_the_way(result, document);
    const bool superseded = std::exchange(running_.superseded, false);
    if (superseded) { // nobody wants to know how it ended
        result.cancelled = false;
        result.failed.reset();
    }
    const bool had_blank = document.session.blank != nullptr;
    const Session before = document.session;
    const LaterResults quads = quads_shown(state_), surface = surface_shown(state_);
    for (const std::string& lost : take_over(document, result))
        say(Severity::warning, lost, about_results(state_));
    // What was picked during the run is taken back without it.
    state_.history.update_since(running_.depth_at_start, [&](Document& changed) { take_over(changed, result); });
    keep_before(result, quads, surface);
    if (superseded) {
        on_cancel_.undo &= document.session.grid == before.grid && document.session.blank == before.blank;
        if (!on_cancel_.undo)
            on_cancel_.unsaved_before.reset();
    }
    const bool taken_back = !superseded && forget_run_without_result(result, before);
    opening_ = false;
    if (document.session.part != before.part) {
        state_.refused.reset();
        state_.refused_file.reset();
        state_.fault.reset();
        part_opened(result.session.options);
    }
    if (project_)
        project_opened(result.search);
    if (document.session.blank && ((!had_blank && !keep_cameras_) || fitter_.is_fitted(state_, View::blank)))
        fitter_.fit(state_, View::blank);
    if (document.session.blank)
        keep_cameras_ = false;
    if (taken_back)
        say(Severity::hint,
            fmt::format("{}: cancelled. The options are again those of the result that is shown.", title),
            about_refusal(state_));
    else if (result.cancelled)
        say(Severity::hint, fmt::format("{}: cancelled. Finished results are kept.", title), about_refusal(state_));
    else if (result.failed)
        report_failed(result);
    else if (!superseded)
        for (const std::string& text : shortcomings(as_made(document)))
            if (!of_its_surface(document.session, text))
                say(Severity::warning, text, about_results(state_));
    const auto& cut = document.session.corner_cut;
    if (cut && !(before.corner_cut && before.part == document.session.part))
        say(Severity::done, describe(*cut), about_results(state_));
    const bool in_one_step = std::exchange(next_in_one_step_, false);
    if (const auto next = std::exchange(next_, std::nullopt); next && !result.cancelled && !result.failed) {
        if (in_one_step)
            document.session.options.steps.reset();
        // 1: it was all that had been asked for then
        const double done = progress_to_ < 1 ? progress_to_ : 0;
        run_to(*next, superseded ? title : *next == Stage::solve ? "Unfolding" : "Updating all");
        progress_from_ = state_.job.fraction = done;
        progress_to_ = std::lerp(done, 1, progress_to_);
    }
    if (!chain_job_ && std::exchange(steps_next_, false) && !result.cancelled)
        run_missing_steps();
}

/// A run that was cancelled or failed before it had anything new is no change: nothing to take back
/// or to save. If it was to make what a change of options asks for, that change is taken back with
/// it. @returns whether it was
bool ViewerModel::forget_run_without_result(const ChainResult& result, const Session& before)
{
    const OnCancel back = std::exchange(on_cancel_, {});
    const Session& now = result.session;
    if (!back.unsaved_before || !(result.cancelled || result.failed) ||
        state_.history.depth() != (back.undo ? running_.depth_noted : running_.depth_at_start) ||
        now.part != before.part || now.blank != before.blank || now.grid != before.grid)
        return false;
    if (back.undo) { // one that has failed stays, for its advice to be followed
        if (!result.cancelled || now.lifted != before.lifted || now.surface != before.surface)
            return false;
        for (size_t k = 0; k < back.changes; ++k)
            state_.history.undo(state_.document);
        state_.before = {};
        return true;
    }
    state_.history.forget_last();
    state_.document.unsaved &= *back.unsaved_before;
    if (now.blank)
        state_.document.session.options.steps = state_.document.made_with.steps;
    else
        state_.document.session.options.steps.reset();
    return false;
}

/// A run that has made another grid and went no further leaves the quad mesh and the surface of the
/// last one to be looked at; where one of them cannot be made of the grid, there is none.
void ViewerModel::keep_before(const ChainResult& result, const LaterResults& quads, const LaterResults& surface)
{
    const Session& session = state_.document.session;
    state_.before = {};
    if (result.failed == Stage::lift || result.failed == Stage::fit || session.surface || !session.grid)
        return;
    const LaterResults& last = surface.surface ? surface : quads;
    if (last.blank == session.blank)
        state_.before = last;
}

/// The lattice bends whatever surface there is; what control points were moved belongs to the
/// surface they are of.
/// @param before  the surface that there was; null: none, the moves are those of a project
/// @returns in words what could not be kept
static std::vector<std::string> deform_again(Document& document, const std::shared_ptr<const SurfaceStage>& before)
{
    Session& session = document.session;
    auto& deformation = session.options.deformation;
    session.deformed = nullptr;
    std::vector<std::string> lost;
    if (before && before != session.surface) {
        document.controls.clear();
        if (deformation && !deformation->moves.empty()) {
            deformation = reset(deformation, HandleKind::control);
            lost.push_back("The moved control points were reset: the surface has new control points.");
        }
    }
    if (deformation && session.surface)
        try {
            session = deform_surface(std::move(session));
        } catch (const InputError& error) {
            deformation.reset();
            lost.push_back(fmt::format("The deformation of the surface was dropped: {}.", error.what()));
        }
    document.made_with.deformation = deformation;
    return lost;
}

/// Puts the results of a run into a document. On a part that was read otherwise the picks stay
/// where they are in space.
/// @returns in words what was not found again
std::vector<std::string> ViewerModel::take_over(Document& document, const ChainResult& result) const
{
    const std::shared_ptr<const PartFile> before = document.session.part, after = result.session.part;
    const bool renumbered =
        before && after && before != after &&
        (before->mesh.triangle.cols() != after->mesh.triangle.cols() || before->mesh.triangle != after->mesh.triangle);
    std::optional<StoredPicks> picks;
    if (renumbered)
        picks = store_picks(document);
    const std::shared_ptr<const SurfaceStage> surface_before = document.session.surface;
    const Session session_before = document.session;
    SessionOptions wanted = std::move(document.session.options); // may have changed meanwhile
    document.session = result.session;
    document.session.options = std::move(wanted);
    document.made_with = result.made_with;
    std::vector<std::string> lost = deform_again(document, surface_before);
    // changed meanwhile
    if (document.session.blank && document.session.options.limits != document.made_with.limits) {
        document.made_with.limits = document.session.options.limits;
        document.session.limits = judge_limits(as_made(document)).limits;
    }
    if (before && before != after)
        document.section.reset();
    if (!picks) {
        if (before && after)
            before != after ? measure_again(document) : measure_again(document, session_before);
        return lost;
    }
    document.selected.clear();
    document.vertices.clear();
    document.probes.clear();
    document.measurements.clear();
    document.regions.clear();
    document.lines.clear();
    document.steps.clear();
    for (std::string& text : restore(document, *picks, result.search))
        lost.push_back(std::move(text));
    return lost;
}

/// Picks and, made of them, the process. @returns in words what was not found again, or why nothing
/// was
std::vector<std::string> ViewerModel::restore(Document& document, const StoredPicks& picks,
                                              const std::shared_ptr<const ClosestPointSearch>& search) const
{
    std::vector<std::string> lost;
    try {
        lost = restore_picks(document, picks, search);
        document.session.options.flatten.process = process_of(document, assets() / "materials");
    } catch (const InputError& error) {
        lost.push_back(error.what());
    }
    return lost;
}

} // namespace spia::viewer
