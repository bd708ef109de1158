#include "app/viewer/model/unfolding_steps.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "app/viewer/model/document.h"
#include "app/viewer/model/step_motion.h"
#include "app/viewer/model/step_target.h"
#include "engine/core/error.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

bool same_sheet(const FlattenOptions& a, const FlattenOptions& b)
{
    return a.material == b.material && a.thickness == b.thickness && a.process.tailored == b.process.tailored &&
           a.process.rolling == b.process.rolling;
}

/// Whether two steps do the same, whatever they are called.
bool same_work(const PlannedStep& a, const PlannedStep& b)
{
    return &a == &b ||
           (same_target(a.pick.target, b.pick.target) && a.kind == b.kind && a.within_mm == b.within_mm &&
            a.offset_mm == b.offset_mm && a.tolerance == b.tolerance && a.most_energy_steps == b.most_energy_steps &&
            a.most_newton_steps == b.most_newton_steps && a.pick.fixed == b.pick.fixed &&
            a.pick.freed == b.pick.freed && a.pick.carrying == b.pick.carrying &&
            a.pick.friction == b.pick.friction);
}

/// Whether the last run was about this part in this sheet.
bool run_is_about(const Document& document)
{
    return document.unfolding && document.unfolding->part == document.session.part &&
           same_sheet(document.unfolding->sheet, document.session.options.flatten);
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
    StepFigures figures{{0, 0}, 0, hinge_of(state, step, part)};
    bool first = true;
    for (const int f : step.pick.freed) {
        const double thinning = state.face.thinning[f];
        figures.thinning[0] = first ? thinning : std::min(figures.thinning[0], thinning);
        figures.thinning[1] = first ? thinning : std::max(figures.thinning[1], thinning);
        figures.strain_equivalent = std::max(figures.strain_equivalent, state.face.strain_equivalent[f]);
        first = false;
    }
    return figures;
}

} // namespace

StepList step_list(UnfoldScript steps)
{
    StepList list;
    for (PlannedStep& step : steps)
        list.push_back(std::make_shared<PlannedStep>(std::move(step)));
    return list;
}

std::shared_ptr<const PartBends> bends_of(std::shared_ptr<const PartFile> part, std::shared_ptr<const PartBends> known)
{
    return known && known->part == part ? known : std::make_shared<PartBends>(PartBends{part, find_bends(part->mesh)});
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

std::string_view name(StepStatus status)
{
    switch (status) {
    case StepStatus::missing: return "missing";
    case StepStatus::done: return "done";
    case StepStatus::poor: return "poor";
    case StepStatus::stale: return "out of date";
    case StepStatus::failed: return "failed";
    }
    return "";
}

StepStatus step_status(const Document& document, size_t step)
{
    const size_t done = steps_done(document);
    if (step < done)
        return document.unfolding->run.states[step].converged ? StepStatus::done : StepStatus::poor;
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

const std::vector<int>& carrying_faces(const PlannedStep& step)
{
    return step.pick.carrying.empty() ? step.pick.fixed : step.pick.carrying;
}

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
                throw InputError(fmt::format("Face {} lies on a bend; pick a face of the flat or gently curved region "
                                             "that shall stay.",
                                             *keep));
        }
        UnfoldSequence sequence = propose_sequence(part->mesh, bends->map, options);
        progress.checkpoint(1, "ordering the steps");
        outcome.notes = std::move(sequence.notes);
        outcome.proposed = step_list(std::move(sequence.steps));
    } catch (const Cancelled&) {
        outcome.cancelled = true;
    } catch (const std::exception& error) {
        outcome.failure = error.what();
    }
    return outcome;
}

StepsOutcome run_steps(std::shared_ptr<const PartFile> part, StepList steps, const FlattenOptions& sheet,
                       std::shared_ptr<const StepsRun> before, size_t done, const Progress& progress)
{
    StepsOutcome outcome;
    auto result = std::make_shared<StepsRun>(StepsRun{part, steps, sheet, {}, {}});
    if (done > 0)
        result->run.states.assign(before->run.states.begin(), before->run.states.begin() + Eigen::Index(done));
    try {
        // One by one, so that what has ended before it is cancelled stays; if only the blank is missing, that.
        const double missing = double(std::max<size_t>(1, steps.size() - done));
        UnfoldScript script;
        for (size_t k = 0; k < done; ++k)
            script.push_back(*steps[k]);
        for (size_t k = done; k < steps.size() || k == done; ++k) {
            if (k < steps.size())
                script.push_back(*steps[k]);
            result->run = run_unfolding(part->mesh, script, sheet,
                                        progress.part(-double(done) / missing, double(script.size() - done) / missing),
                                        &result->run, k);
            if (!result->run.failure.empty())
                break;
        }
    } catch (const Cancelled&) {
        outcome.cancelled = true;
        result->run.blank.reset();
    } catch (const std::exception& error) {
        outcome.failure = error.what();
    }
    result->run.states.resize(std::min(result->run.states.size(), steps.size()));
    for (size_t k = 0; k < result->run.states.size(); ++k)
        result->figure.push_back(figures_of(result->run.states[k], *steps[k], part->mesh));
    outcome.run = std::move(result);
    return outcome;
}

} // namespace spia::viewer
