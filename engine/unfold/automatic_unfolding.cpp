#include "engine/unfold/automatic_unfolding.h"

#include <algorithm>
#include <fmt/core.h>
#include <optional>

namespace spia {
namespace {

/// How many steps two plans begin with alike.
size_t alike(const UnfoldScript& a, const UnfoldScript& b)
{
    return size_t(std::mismatch(a.begin(), a.end(), b.begin(), b.end(), same_work).first - a.begin());
}

/// Why the plan has to change at one of its steps; none: it need not, or cannot.
struct Fault {
    size_t step;
    std::string why;
    bool has_blank = false; ///< the run ended in one all the same
};

/// The worst step before all is flattened that strains the sheet more than that does at last: it
/// led nowhere.
std::optional<Fault> strained_for_nothing(const UnfoldScript& steps, const UnfoldRun& run)
{
    constexpr double harmless = 0.05; // equivalent strain
    if (steps.back().kind != UnfoldKind::flatten)
        return std::nullopt;
    const double end = run.states.back().face.strain_equivalent.maxCoeff();
    double most = std::max(harmless, end);
    std::optional<Fault> fault;
    for (size_t k = 0; k + 1 < steps.size(); ++k) {
        const double strain = run.states[k].face.strain_equivalent(steps[k].pick.freed).maxCoeff();
        if (strain <= most)
            continue;
        most = strain;
        fault = Fault{k, fmt::format("it strains the sheet by {:.2g}, the final blank only by {:.2g}", strain, end),
                      run.blank.has_value()};
    }
    return fault;
}

std::optional<Fault> fault_in(const UnfoldScript& steps, const UnfoldRun& run)
{
    for (size_t k = 0; k < run.states.size();
         ++k) // what does not converge for itself may as well move with its neighbours
        if (const UnfoldState& state = run.states[k]; !state.converged && steps[k].kind == UnfoldKind::lay)
            return Fault{k, "it did not converge: " + state.reason, run.blank.has_value()};
    if (run.failure.empty())
        return strained_for_nothing(steps, run);
    if (steps[run.states.size()].kind == UnfoldKind::flatten)
        return std::nullopt;
    return Fault{run.states.size(), run.failure};
}

bool converged(const UnfoldRun& run)
{
    return run.blank &&
           std::all_of(run.states.begin(), run.states.end(), [](const UnfoldState& s) { return s.converged; });
}

AutomaticUnfolding with_notes(AutomaticUnfolding unfolded, const std::vector<std::string>& given_up)
{
    unfolded.sequence.notes.insert(unfolded.sequence.notes.end(), given_up.begin(), given_up.end());
    unfolded.given_up = given_up.size();
    return unfolded;
}

} // namespace

AutomaticUnfolding automatic_unfolding(const TriMesh& part, const BendMap& map, SequenceOptions options,
                                       const FlattenOptions& flatten, const Progress& progress,
                                       const AutomaticUnfolding* begun, const StepEnded& ended)
{
    AutomaticUnfolding now{propose_sequence(part, map, options), {}};
    options.root = now.sequence.root; // stays, whatever carries nothing
    std::vector<std::string> given_up;
    std::optional<AutomaticUnfolding> nearly; // the first faulty plan whose steps converge, else
                                              // that ended in a blank
    size_t keep = begun ? std::min(alike(begun->sequence.steps, now.sequence.steps), begun->run.states.size()) : 0;
    for (UnfoldRun before = begun ? begun->run : UnfoldRun{};;) {
        now.run = run_unfolding(part, now.sequence.steps, flatten, progress, keep > 0 ? &before : nullptr, keep,
                                [&](const UnfoldRun& so_far) {
                                    if (ended)
                                        ended(now.sequence.steps, so_far);
                                });
        const std::optional<Fault> fault = fault_in(now.sequence.steps, now.run);
        if (!fault)
            break;
        if (fault->has_blank && (!nearly || (!converged(nearly->run) && converged(now.run))))
            nearly = with_notes(now, given_up);
        const PlannedStep& failed = now.sequence.steps[fault->step];
        const std::string what = fmt::format("\"{}\" failed ({}); replanned ", failed.name, fault->why);
        if (failed.kind == UnfoldKind::unroll) {
            options.unroll = false;
            given_up.push_back(what + "with everything flattened in the last step");
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
