// The jobs of unfolding step by step.
#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/jobs/viewer_model.h"
#include "engine/core/text.h"
#include "engine/report/text/lengths.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {
void ViewerModel::start_steps(std::string title, std::function<StepsOutcome(const Progress&, const StepsSoFar&)> work)
{
    dismiss_before_run(state_.messages);
    state_.job = JobView{};
    state_.job.running = true;
    state_.job.title = std::move(title);
    cancelled_at_.reset();
    steps_so_far_ = std::make_shared<Mailbox<StepsOutcome>>();
    steps_job_ = std::make_unique<Job<StepsOutcome>>(
        [work = std::move(work), so_far = steps_so_far_](const Progress& progress) {
            return work(progress, [&](StepsOutcome outcome) { so_far->post(std::move(outcome)); });
        },
        wake_);
}

void ViewerModel::run_missing_steps()
{
    const Document& document = state_.document;
    running_list_ = document.steps;
    if (still_proposed(document) && !keep_step_) // those of a project are to be what they were
        return start_steps("Unfolding step by step",
                           [proposal = document.proposal, bends = document.bends,
                            sheet = sheet_of_steps(document.session.options.flatten),
                            k = document.session.options.k_factor,
                            before = document.unfolding](const Progress& progress, const StepsSoFar& so_far) {
                               return run_proposal(*proposal, bends, sheet, k, before, progress, so_far);
                           });
    start_steps("Unfolding step by step",
                [part = document.session.part, steps = document.steps,
                 sheet = sheet_of_steps(document.session.options.flatten), k = document.session.options.k_factor,
                 before = document.unfolding,
                 done = steps_done(document)](const Progress& progress, const StepsSoFar& so_far) {
                    return run_steps(part, steps, sheet, k, before, done, progress, so_far);
                });
}

void ViewerModel::show_step(std::optional<int> step, double position)
{
    const bool fitted = fitter_.is_fitted(state_, View::part);
    state_.view.step = step;
    state_.view.unfolded = position;
    pickers_.follow_steps(state_);
    if (fitted && state_.document.session.part)
        fitter_.fit(state_, View::part);
}

/// Lets the running job of steps end by itself: a file that it has not written by then it never
/// will. @returns what had ended
StepsOutcome ViewerModel::leave_steps()
{
    StepsOutcome outcome = steps_so_far_->fetch().value_or(StepsOutcome{});
    outcome.cancelled = true;
    ending_steps_.push_back(std::move(steps_job_));
    return outcome;
}

void ViewerModel::take_steps_result()
{
    const std::string title = state_.job.title;
    const bool keep_step = std::exchange(keep_step_, false);
    state_.job = JobView{};
    const auto blank_next = std::exchange(blank_next_, std::nullopt);
    StepsOutcome outcome;
    try {
        outcome = steps_job_->finished() ? std::exchange(steps_job_, nullptr)->take() : leave_steps();
    } catch (const std::exception& error) { // no memory
        say(Severity::error, error.what());
        return;
    }
    Document& document = state_.document;
    const size_t done_before = steps_done(document);
    const auto change = [&](const char* name) {
        state_.history.remember(name, document);
        state_.document.unsaved = true;
    };
    if (outcome.proposed && !outcome.proposed->empty()) {
        change(outcome.opened.empty() ? "Propose steps" : "Open steps");
        document.steps = std::move(*outcome.proposed);
        document.proposal =
            outcome.opened.empty()
                ? std::make_shared<Proposal>(Proposal{document.session.part, outcome.root, document.steps})
                : nullptr;
        document.bends = outcome.bends;
        show_step(0, 0);
        const size_t most_notes = outcome.opened.empty() ? 2 : 6;
        for (size_t k = 0; k < std::min(most_notes, outcome.notes.size()); ++k)
            say(outcome.opened.empty() ? Severity::hint : Severity::warning, sentence(outcome.notes[k]));
        if (outcome.notes.size() > most_notes)
            say(Severity::hint, outcome.opened.empty()
                                    ? fmt::format("The same at {}.", counted(outcome.notes.size() - most_notes,
                                                                             "other place", "other places"))
                                    : fmt::format("And {} more.", outcome.notes.size() - most_notes));
        if (!outcome.opened.empty())
            say(Severity::done, fmt::format("Opened {} from {}{}", counted(document.steps.size(), "step", "steps"),
                                            outcome.opened.string(),
                                            outcome.notes.empty() ? "" : "; some of them do not fit this part"));
        else
            say(Severity::done, fmt::format("The part has {} and {}; proposed {}.",
                                            counted(outcome.bends->map.regions.size(), "region", "regions"),
                                            counted(outcome.bends->map.bends.size(), "bend", "bends"),
                                            counted(document.steps.size(), "step", "steps")));
    }
    const auto& run = outcome.run;
    if (run && (run->run.states.size() > done_before || run->run.blank || !run->run.failure.empty())) {
        if (keep_step) { // of a project: what it was when that was saved
            document.unfolding = run;
        } else {
            change("Run the steps");
            document.unfolding = run;
            if (const bool edited = document.steps != running_list_; !edited && run->steps != document.steps) {
                document.steps = run->steps;
                document.proposal =
                    std::make_shared<Proposal>(Proposal{run->part, document.proposal->root, run->steps});
            }
            const size_t done = steps_done(document);
            if (!run->run.failure.empty()) // the one to be changed
                show_step(int(std::min(done, document.steps.size() - 1)), double(done));
            else if (done > 0)
                show_step(int(done) - 1, double(done));
        }
    }
    if (!outcome.saved.empty()) {
        document.bends = outcome.bends;
        say(Severity::done, fmt::format("Saved the steps to {}", outcome.saved.string()));
    }
    if (outcome.cancelled)
        say(Severity::hint, run ? fmt::format("{}: cancelled. {} of {} are done.", title, run->run.states.size(),
                                              counted(run->steps.size(), "step", "steps"))
                                : fmt::format("{}: cancelled.", title));
    else if (!outcome.failure.empty())
        say(Severity::error, sentence(outcome.failure));
    else if (run)
        report_steps_run(outcome);
    if (blank_next && !outcome.cancelled)
        take_blank_of_project(*blank_next);
}

/// The chain of a project whose blank was that of its steps.
void ViewerModel::take_blank_of_project(const BlankNext& next)
{
    Document& document = state_.document;
    const auto& last = document.unfolding;
    if (!all_steps_done(document) || !last->run.blank || last->run.flipped > 0) {
        say(Severity::warning,
            "The blank of the steps used in the project could not be computed again; correct the steps, or unfold the part in one step.");
        return;
    }
    document.session.options.steps = {{last, &last->run}, next.polish};
    run_to(next.to, "Updating all");
}

void ViewerModel::report_steps_run(const StepsOutcome& outcome)
{
    const StepsRun& last = *outcome.run;
    const UnfoldRun& run = last.run;
    bool poor = false;
    const auto warn = [&](std::string text) {
        poor = true;
        say(Severity::warning, std::move(text), about_steps(state_));
    };
    for (const UnfoldState& state : run.states)
        if (!state.converged)
            warn(
                fmt::format("The step \"{}\" did not converge: {}. Its best shape is kept; a larger tolerance or other "
                            "faces may help.",
                            state.name, state.reason));
        else if (state.friction_share < 1)
            warn(fmt::format("The step \"{}\" reached {:.2g} % of its friction: {}.", state.name,
                             100 * state.friction_share, state.reason));
    for (const UnfoldState& state : run.states)
        if (state.reach.without_room > 0)
            warn(fmt::format("In the step \"{}\" {} reach beyond the end of the target, up to {} from its fixed faces.",
                             state.name, counted(state.reach.without_room, "face", "faces"),
                             length_text(state.reach.farthest_mm, state_.preferences.lengths)));
    if (const size_t count = last.given_up.size(); count > 0)
        say(Severity::hint,
            fmt::format("The step {}{}. The list shows the steps that were done.", last.given_up.front(),
                        count > 1 ? fmt::format("; so it was {} more", counted(count - 1, "time", "times")) : ""),
            about_steps(state_));
    if (!run.failure.empty()) {
        const size_t failed = run.states.size();
        say(Severity::error,
            fmt::format("Step {} \"{}\" has no result: {} {}Change this step or its place in the list, then run again.",
                        failed + 1, last.steps[failed]->name, sentence(run.failure),
                        failed > 0 ? fmt::format("The states up to step {} are kept. ", failed) : ""),
            about_steps(state_));
        return;
    }
    if (!run.blank) {
        warn("After the last step the part is not flat yet; add a step.");
        return;
    }
    if (run.flipped > 0)
        warn(fmt::format("{} of the blank are flipped; unfold in smaller steps there.",
                         counted(run.flipped, "triangle", "triangles")));
    const UnfoldState& end = run.states.back();
    if (end.necking > 0)
        warn(fmt::format(
            "{} strained beyond the valid range of the hardening curve: the sheet would neck or crack there.",
            counted(end.necking, "triangle is", "triangles are")));
    if (end.overlap.places > 0)
        warn(fmt::format("The blank overlaps itself at {}.", counted(end.overlap.places, "place", "places")));
    if (last.laid)
        for (const std::string& doubt : last.laid->doubts)
            warn(sentence(doubt));
    const auto blank = size_of_blank(state_.document);
    say(poor ? Severity::hint : Severity::done, // green only where nothing is poor
        fmt::format("Unfolded in {}{}.", counted(run.states.size(), "step", "steps"),
                    blank ? ": a blank of " + size_text(blank->size[0], blank->size[1], state_.preferences.lengths) +
                                of_other_k(state_.document, *blank)
                          : ""),
        about_steps(state_));
}

} // namespace spia::viewer
