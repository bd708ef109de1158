#include "engine/unfold/unfold_by_itself.h"

#include <algorithm>
#include <fmt/core.h>
#include <optional>

#include "engine/core/error.h"
#include "engine/unfold/run_one_by_one.h"

namespace spia {
namespace {

bool same(const PlannedStep& a, const PlannedStep& b)
{
    return a.kind == b.kind && a.pick.freed == b.pick.freed && a.pick.fixed == b.pick.fixed &&
           a.pick.carrying == b.pick.carrying && a.within_mm == b.within_mm;
}

/// How many steps two plans begin with alike.
size_t alike(const UnfoldScript& a, const UnfoldScript& b)
{
    return size_t(std::mismatch(a.begin(), a.end(), b.begin(), b.end(), same).first - a.begin());
}

/// Why the plan has to change at one of its steps; none: it need not, or cannot.
struct Fault {
    size_t step;
    std::string why;
    bool has_blank = false; ///< the run ended in one all the same
};

std::optional<Fault> fault_in(const UnfoldScript& steps, const UnfoldRun& run)
{
    for (size_t k = 0; k < run.states.size();
         ++k) // what does not converge for itself may as well move with its neighbours
        if (const UnfoldState& state = run.states[k]; !state.converged && steps[k].kind == UnfoldKind::lay)
            return Fault{k, "it did not converge: " + state.reason, run.blank && state.plain != "smooth"};
    if (run.failure.empty() || steps[run.states.size()].kind == UnfoldKind::flatten)
        return std::nullopt;
    return Fault{run.states.size(), run.failure};
}

bool converged(const UnfoldRun& run)
{
    return run.blank &&
           std::all_of(run.states.begin(), run.states.end(), [](const UnfoldState& s) { return s.converged; });
}

UnfoldedByItself with_notes(UnfoldedByItself unfolded, const std::vector<std::string>& given_up)
{
    unfolded.sequence.notes.insert(unfolded.sequence.notes.end(), given_up.begin(), given_up.end());
    unfolded.given_up = given_up.size();
    return unfolded;
}

} // namespace

UnfoldedByItself unfold_by_itself(const TriMesh& part, const BendMap& map, SequenceOptions options,
                                  const FlattenOptions& flatten, const Progress& progress, const PlanWatch& watch,
                                  const UnfoldedByItself* begun)
{
    UnfoldedByItself now{propose_sequence(part, map, options), {}};
    if (now.sequence.steps.empty())
        throw InputError("the part is flat already; there is nothing to unfold");
    options.root = now.sequence.root; // stays, whatever carries nothing
    std::vector<std::string> given_up;
    std::optional<UnfoldedByItself> nearly; // the first plan that ended in a blank, if no other one converges
    size_t keep = begun ? std::min(alike(begun->sequence.steps, now.sequence.steps), begun->run.states.size()) : 0;
    const auto seen = [&](const UnfoldRun& run) {
        if (watch)
            watch(now.sequence, run);
    };
    for (UnfoldRun before = begun ? begun->run : UnfoldRun{};;) {
        now.run = run_one_by_one(part, now.sequence.steps, flatten, seen, progress, keep > 0 ? &before : nullptr, keep);
        const std::optional<Fault> fault = fault_in(now.sequence.steps, now.run);
        if (!fault)
            break;
        if (fault->has_blank && !nearly) {
            nearly = with_notes(now, given_up);
        }
        const PlannedStep& failed = now.sequence.steps[fault->step];
        const std::string what = fmt::format("\"{}\" did not work out ({}); planned anew ", failed.name, fault->why);
        if (failed.kind == UnfoldKind::unroll) {
            options.unroll = false;
            given_up.push_back(what + "with all flattened at last");
        } else {
            given_up.push_back(what + "with nothing on " + map.name(failed.carrier));
            options.carries_nothing.insert(
                std::upper_bound(options.carries_nothing.begin(), options.carries_nothing.end(), failed.carrier),
                failed.carrier);
        }
        UnfoldSequence next = propose_sequence(part, map, options);
        keep = std::min(alike(now.sequence.steps, next.steps), fault->step);
        before = std::move(now.run);
        now.sequence = std::move(next);
    }
    if (nearly && !converged(now.run))
        return std::move(*nearly);
    return with_notes(std::move(now), given_up);
}

} // namespace spia
