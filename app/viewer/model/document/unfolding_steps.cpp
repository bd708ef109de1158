#include "app/viewer/model/document/unfolding_steps.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/document.h"
#include "app/viewer/model/document/k_choice.h"
#include "app/viewer/model/document/step_motion.h"
#include "app/viewer/model/document/step_target.h"
#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/applied_process.h"
#include "engine/pipeline/blank/bend_report.h"
#include "engine/pipeline/blank/bends_for_shop.h"
#include "engine/pipeline/blank/part_bends.h"
#include "engine/report/figures/figures.h"
#include "engine/unfold/automatic_unfolding.h"

namespace spia::viewer {
namespace {

/// Whether the last run was about this part in this sheet.
bool run_is_about(const Document& document)
{
    return document.unfolding && document.unfolding->part == document.session.part &&
           formed_alike(document.unfolding->sheet, sheet_of_steps(document.session.options.flatten));
}

std::optional<StepFigures::Hinge> hinge_of(const UnfoldState& state, const PlannedStep& step, const TriMesh& part)
{
    if (!state.on || step.pick.fixed.empty())
        return std::nullopt;
    return StepFigures::Hinge{state.on->distance_mm, state.on->angle * 180 / std::numbers::pi,
                              creased(*state.on, bounding_diagonal(part))};
}

StepFigures figures_of(const UnfoldState& state, const PlannedStep& step, const TriMesh& part)
{
    const SheetFigures sheet = sheet_figures(state.face, step.pick.freed);
    return {sheet.thinning, sheet.strain_equivalent, hinge_of(state, step, part)};
}

std::shared_ptr<const StepsRun> with_figures(std::shared_ptr<StepsRun> run)
{
    run->run.states.resize(std::min(run->run.states.size(), run->steps.size()));
    for (size_t k = 0; k < run->run.states.size(); ++k)
        run->figure.push_back(figures_of(run->run.states[k], *run->steps[k], run->part->mesh));
    return run;
}

Eigen::Vector2d size_of(const Eigen::Matrix2Xd& flat) { return flat.rowwise().maxCoeff() - flat.rowwise().minCoeff(); }

void measure_blank(StepsRun& run, const std::optional<KFactor>& k, const Progress& progress)
{
    if (!run.run.blank || run.run.flipped > 0)
        return;
    UnfoldRun laid;
    laid.states = {run.run.states.back()};
    laid.blank = run.run.blank;
    NeutralFibre fibre;
    try {
        progress.checkpoint(1, "laying the bends");
        fibre = part_bends(*run.part, run.sheet.thickness, k);
        lay_anew(run.part->mesh, run.sheet, fibre, laid, progress.part(1, 1));
    } catch (const Cancelled&) {
        return; // the steps are done all the same
    } catch (const std::exception&) {
        return; // a K factor for a skin, say: using the blank tells it
    }
    run.laid = LaidSize{k, size_of(laid.blank->position), bend_doubts(*run.part, fibre.table, k.has_value())};
}

/// The steps of a plan; those that the list begins with likewise are its own.
StepList as_far_as_the_same(const StepList& list, const UnfoldScript& plan)
{
    StepList steps = step_list(plan);
    for (size_t k = 0; k < std::min(list.size(), plan.size()); ++k)
        if (same_work(*list[k], plan[k]) && list[k]->name == plan[k].name)
            steps[k] = list[k];
    return steps;
}

/// What stays of a plan that was about to be replaced: it is to go on from there, not to be taken
/// for done.
UnfoldRun as_far_as_it_worked(UnfoldRun run)
{
    const auto poor = std::find_if(run.states.begin(), run.states.end(), [](const auto& s) { return !s.converged; });
    run.states.erase(poor, run.states.end());
    run.failure.clear();
    run.blank.reset();
    return run;
}

StepsOutcome cancelled_with(StepsRun run, std::shared_ptr<const PartBends> bends)
{
    StepsOutcome outcome;
    outcome.cancelled = true;
    outcome.bends = std::move(bends);
    outcome.run = with_figures(std::make_shared<StepsRun>(std::move(run)));
    return outcome;
}

} // namespace

UnfoldScript script_of(const StepList& list)
{
    UnfoldScript script;
    for (const auto& step : list)
        script.push_back(*step);
    return script;
}

StepList step_list(UnfoldScript steps)
{
    StepList list;
    for (PlannedStep& step : steps)
        list.push_back(std::make_shared<PlannedStep>(std::move(step)));
    return list;
}

std::shared_ptr<const PartBends> bends_of(std::shared_ptr<const PartFile> part, std::shared_ptr<const PartBends> known)
{
    return known && known->part == part ? known : std::make_shared<PartBends>(PartBends{part, bends_for_steps(*part)});
}

FlattenOptions sheet_of_steps(const FlattenOptions& wanted)
{
    FlattenOptions sheet;
    sheet.material = wanted.material;
    sheet.thickness = wanted.thickness;
    sheet.process.tailored = wanted.process.tailored;
    sheet.process.rolling = wanted.process.rolling;
    return sheet;
}

bool still_proposed(const Document& document)
{
    return document.proposal && document.proposal->part == document.session.part &&
           document.proposal->steps == document.steps;
}

std::string left_out_by_steps(const Document& document)
{
    const std::string what = spia::left_out_by_steps(document.session.options.flatten.process);
    return what.empty() ? "" : fmt::format("The steps leave out what acts on the part as a whole: {}.", what);
}

size_t steps_done(const Document& document)
{
    if (!run_is_about(document))
        return 0;
    const StepsRun& last = *document.unfolding;
    const size_t most = std::min(document.steps.size(), last.run.states.size());
    size_t done = 0;
    while (done < most && same_work(*document.steps[done], *last.steps[done]))
        ++done;
    return done;
}

bool all_steps_done(const Document& document)
{
    return !document.steps.empty() && steps_done(document) == document.steps.size() &&
           document.unfolding->run.states.size() == document.steps.size();
}

std::optional<LaidSize> size_of_blank(const Document& document)
{
    if (!all_steps_done(document))
        return std::nullopt;
    const auto& used = document.made_with.steps;
    if (document.session.blank && used && !used->polish && holds(document, *used))
        return LaidSize{document.made_with.k_factor, size_of(document.session.blank->blank.position)};
    return document.unfolding->laid;
}

std::string of_other_k(const Document& document, const LaidSize& size)
{
    return size.k == document.session.options.k_factor ? "" : ", K " + (size.k ? k_words(size.k) : KFactor{}.name);
}

std::string_view name(StepStatus status)
{
    switch (status) {
    case StepStatus::missing: return "missing";
    case StepStatus::done: return "done";
    case StepStatus::poor: return "poor";
    case StepStatus::stale: return "out of date";
    case StepStatus::failed: return "failed";
    case StepStatus::needs_pick: return "needs fixed faces";
    }
    return "";
}

StepStatus step_status(const Document& document, size_t step)
{
    const size_t done = steps_done(document);
    if (step < done) {
        const UnfoldState& state = document.unfolding->run.states[step];
        return state.converged && state.friction_share == 1 ? StepStatus::done : StepStatus::poor;
    }
    if (needs_pick(*document.steps[step]))
        return StepStatus::needs_pick;
    if (!document.unfolding)
        return StepStatus::missing;
    const StepsRun& last = *document.unfolding;
    if (step == done && run_is_about(document) && !last.run.failure.empty() && last.run.states.size() == done &&
        done < last.steps.size() && same_work(*document.steps[done], *last.steps[done]))
        return StepStatus::failed;
    return step < last.run.states.size() ? StepStatus::stale : StepStatus::missing;
}

Eigen::Matrix3Xd unfolded_places(const Document& document, double position)
{
    const TriMesh& part = document.session.part->mesh;
    const double end = double(steps_done(document)), at = std::clamp(position, 0., end);
    const auto after = [&](size_t steps) -> const Eigen::Matrix3Xd& {
        return steps == 0 ? part.position : document.unfolding->run.states[steps - 1].position;
    };
    const auto whole = size_t(at);
    return at == double(whole) ? after(whole)
                               : on_the_way(part.triangle, after(whole), after(whole + 1), at - double(whole));
}

bool needs_pick(const PlannedStep& step) { return step.carrying_lost && !step.pick.target; }

StepsOutcome propose_steps(std::shared_ptr<const PartFile> part, std::shared_ptr<const PartBends> bends,
                           std::optional<int> keep, const Progress& progress)
{
    StepsOutcome outcome;
    try {
        progress.checkpoint(0, "finding the bends");
        outcome.bends = bends = bends_of(part, std::move(bends));
        progress.checkpoint(0.7, "ordering the steps");
        SequenceOptions options;
        if (keep) {
            options.root = bends->map.label[*keep];
            if (options.root < 0 || size_t(options.root) >= bends->map.regions.size())
                throw InputError(fmt::format(
                    "Face {} lies on a bend; pick a face of the flat or gently curved region to be fixed.", *keep));
        }
        UnfoldSequence sequence = propose_sequence(part->mesh, bends->map, options);
        progress.checkpoint(1, "ordering the steps");
        outcome.notes = std::move(sequence.notes);
        outcome.root = options.root;
        outcome.proposed = step_list(std::move(sequence.steps));
    } catch (const Cancelled&) {
        outcome.cancelled = true;
    } catch (const std::exception& error) {
        outcome.failure = error.what();
    }
    return outcome;
}

StepsOutcome run_proposal(const Proposal& proposal, std::shared_ptr<const PartBends> bends, const FlattenOptions& sheet,
                          const std::optional<KFactor>& k, std::shared_ptr<const StepsRun> before,
                          const Progress& progress, const StepsSoFar& so_far)
{
    StepsOutcome outcome;
    const auto& part = proposal.part;
    auto result = std::make_shared<StepsRun>(StepsRun{part, proposal.steps, sheet, {}, {}, {}});
    const auto take = [&](const UnfoldScript& steps, UnfoldRun run) {
        result->steps = as_far_as_the_same(proposal.steps, steps);
        result->run = std::move(run);
    };
    try {
        progress.checkpoint(0, "finding the bends");
        outcome.bends = bends = bends_of(part, std::move(bends));
        AutomaticUnfolding begun;
        if (before && before->part == part && formed_alike(before->sheet, sheet)) {
            begun.sequence.steps = script_of(before->steps);
            begun.run = before->run;
        }
        AutomaticUnfolding unfolded = automatic_unfolding(
            part->mesh, bends->map, {.root = proposal.root}, sheet, progress, &begun,
            [&](const UnfoldScript& plan, const UnfoldRun& run) {
                if (so_far)
                    so_far(cancelled_with(
                        {part, as_far_as_the_same(proposal.steps, plan), sheet, as_far_as_it_worked(run), {}, {}},
                        bends));
            });
        const std::vector<std::string>& notes = unfolded.sequence.notes;
        result->given_up.assign(notes.end() - long(unfolded.given_up), notes.end());
        take(unfolded.sequence.steps, std::move(unfolded.run));
        measure_blank(*result, k, progress);
    } catch (const UnfoldingCancelled& cancelled) {
        outcome.cancelled = true;
        take(cancelled.steps, as_far_as_it_worked(cancelled.done));
    } catch (const Cancelled&) {
        outcome.cancelled = true;
    } catch (const std::exception& error) {
        outcome.failure = error.what();
    }
    outcome.run = with_figures(std::move(result));
    return outcome;
}

StepsOutcome run_steps(std::shared_ptr<const PartFile> part, StepList steps, const FlattenOptions& sheet,
                       const std::optional<KFactor>& k, std::shared_ptr<const StepsRun> before, size_t done,
                       const Progress& progress, const StepsSoFar& so_far)
{
    StepsOutcome outcome;
    auto result = std::make_shared<StepsRun>(StepsRun{part, steps, sheet, {}, {}, {}});
    if (done > 0)
        result->run.states.assign(before->run.states.begin(), before->run.states.begin() + Eigen::Index(done));
    try {
        const UnfoldRun kept = result->run;
        result->run =
            run_unfolding(part->mesh, script_of(steps), sheet, progress, &kept, done, [&](const UnfoldRun& run) {
                if (so_far)
                    so_far(cancelled_with({part, steps, sheet, run, {}, {}}, nullptr));
            });
        measure_blank(*result, k, progress);
    } catch (const UnfoldingCancelled& cancelled) {
        outcome.cancelled = true;
        result->run = cancelled.done;
    } catch (const std::exception& error) {
        outcome.failure = error.what();
    }
    outcome.run = with_figures(std::move(result));
    return outcome;
}

} // namespace spia::viewer
