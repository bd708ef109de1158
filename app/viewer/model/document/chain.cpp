#include "app/viewer/model/document/chain.h"

#include <fmt/core.h>

#include "app/viewer/model/document/fit_choice.h"
#include "app/viewer/model/reports/viewer_words.h"
#include "engine/core/error.h"
#include "engine/exchange/read_part.h"

namespace spia::viewer {
namespace {

/// The part to be looked at, if its mesh is sick; null if the file cannot be read at all.
std::shared_ptr<const PartFile> refused_part(const Session& session, const Progress& progress)
{
    try {
        PartFile part = examine_part(session.file, session.options.read, progress);
        if (!part.doctor.healthy())
            return std::make_shared<PartFile>(std::move(part));
    } catch (const InputError&) { // said already
    }
    return nullptr;
}

/// The bar goes on from stage to stage, each with its usual share of the time.
Progress progress_of(Stage stage, Stage from, Stage to, const Progress& progress)
{
    const double whole = share_of_time(from, to);
    const double done = share_of_time(from, stage);
    return progress.part((done - share_of_time(stage, stage)) / whole, done / whole);
}

void note_failure(const Failure& failure, const Progress& progress, ChainResult& result)
{
    result.failed = failure.stage;
    result.message = failure.message;
    if (failure.stage != Stage::read)
        return;
    try {
        result.refused = refused_part(result.session, progress);
    } catch (const std::exception&) { // the reason above counts
    }
}

void note(Stage done, const SessionOptions& options, SessionOptions& made_with)
{
    switch (done) {
    case Stage::read: made_with.read = options.read; break;
    case Stage::solve:
        made_with.flatten = options.flatten;
        made_with.steps = options.steps;
        made_with.k_factor = options.k_factor;
        made_with.limits = options.limits;
        break;
    case Stage::grid:
        made_with.corners = options.corners;
        made_with.grid = options.grid;
        break;
    case Stage::lift: break;
    case Stage::fit:
        made_with.interpolate = options.interpolate;
        set_fit(made_with, fit_choice(options));
        made_with.patches = options.patches;
        made_with.best_surface = options.best_surface;
        break;
    }
}

/// Whether the blank is what is wanted now.
bool blank_holds(const Document& document)
{
    const SessionOptions &wanted = document.session.options, &made = document.made_with;
    if (wanted.steps != made.steps || wanted.k_factor != made.k_factor)
        return false;
    return made.steps ? holds(document, *made.steps) && wanted.flatten.skins == made.flatten.skins
                      : formed_alike(wanted.flatten, made.flatten);
}

} // namespace

double share_of_time(Stage from, Stage to)
{
    // Of the drawn cone, the solver takes 72 % of the time and the fit 21 %, of a face 95 % and 4
    // %, of the recliner bracket 10 % and 85 %.
    constexpr double share[] = {0.05, 0.6, 0.08, 0.02, 0.25};
    double sum = 0;
    for (const Stage stage : chain)
        if (stage >= from && stage <= to)
            sum += share[int(stage)];
    return sum;
}

bool holds(const Document& document, const BlankOfSteps& steps)
{
    return all_steps_done(document) && steps.run.get() == &document.unfolding->run;
}

bool makes_same_surface(const SessionOptions& a, const SessionOptions& b)
{
    return a.patches == b.patches && a.best_surface == b.best_surface && fit_choice(a) == fit_choice(b) &&
           a.interpolate.parameters == b.interpolate.parameters && a.corners == b.corners && a.grid == b.grid;
}

std::optional<Stage> first_stale(const Document& document)
{
    const Session& session = document.session;
    const SessionOptions &wanted = session.options, &made = document.made_with;
    if (!session.part || wanted.read != made.read)
        return Stage::read;
    if (!session.blank || !blank_holds(document))
        return Stage::solve;
    const bool fitted_as_wanted = session.surface && wanted.patches == made.patches &&
                                  wanted.best_surface == made.best_surface && fit_choice(wanted) == fit_choice(made);
    if (wanted.patches || (wanted.best_surface && !session.no_grid.empty()) ||
        (fitted_as_wanted && session.surface->patches))
        return fitted_as_wanted ? std::nullopt : std::optional(Stage::fit); // without a grid of the whole
    if (!session.grid || wanted.corners != made.corners || wanted.grid != made.grid)
        return Stage::grid;
    if (!session.lifted)
        return Stage::lift;
    if (!fitted_as_wanted || wanted.interpolate.parameters != made.interpolate.parameters)
        return Stage::fit;
    return std::nullopt;
}

Session as_made(const Document& document)
{
    Session session = document.session;
    session.options = document.made_with;
    return session;
}

std::string out_of_date(const Document& document)
{
    const auto stale = first_stale(document);
    const Session& session = document.session;
    const bool there = stale && (*stale == Stage::read    ? session.part != nullptr
                                 : *stale == Stage::solve ? session.blank != nullptr
                                 : *stale == Stage::fit   ? session.surface != nullptr
                                                          : session.grid != nullptr);
    return there ? fmt::format(
                       "Out of date from the step \"{}\" on: options have changed since these results were computed.",
                       heading(*stale))
                 : "";
}

ChainResult run_and_note(Session session, SessionOptions made_with, Stage from, Stage to, const Progress& progress,
                         const ChainWishes& wishes, const std::function<void(const ChainResult&)>& ended,
                         const StepWatch& watch)
{
    ChainResult result;
    result.session = std::move(session);
    result.session.options.deformation.reset(); // of the surface that comes of it, not of the chain
    result.made_with = std::move(made_with);
    ChainHooks hooks;
    hooks.watch = watch;
    hooks.begins = [&](Stage stage) { return progress_of(stage, from, to, progress); };
    hooks.ended = [&](Stage stage, const Session& made) {
        result.session = made;
        note(stage, made.options, result.made_with);
        if (stage == Stage::read)
            result.search = std::make_shared<ClosestPointSearch>(made.part->mesh);
        if (ended)
            ended(result);
    };
    hooks.part_is_ready = [&](const Session& ready) { result.session.options = ready.options; };
    try {
        const ChainRun run = run_chain(result.session, from, to, wishes, hooks);
        if (run.failure)
            note_failure(*run.failure, progress, result);
    } catch (const Cancelled&) {
        result.cancelled = true;
    }
    return result;
}

std::string advice(Stage failed, const SessionOptions& options)
{
    if (options.steps && failed == Stage::solve)
        return "Use the blank of the steps as it is, without polishing.";
    switch (failed) {
    case Stage::read: return "See the faults in the step Part, where some can be repaired, or choose another file.";
    case Stage::solve: return "Look at the places that are named; otherwise a coarser or cleaner mesh often helps.";
    case Stage::grid: return "Drag the corners to sharp corners of the blank, or choose the harmonic method.";
    case Stage::lift: return "Choose the automatic grid method.";
    case Stage::fit:
        return options.best_surface ? "Choose one patch or several patches in the step NURBS surface to see what is in "
                                      "the way of each."
               : options.patches    ? "Add a cut there, or choose one patch in the step NURBS surface."
                                    : "Choose a finer grid.";
    }
    return "";
}

std::string advice(const SolveReport& report)
{
    if (report.process_share < 1)
        return "Reduce the tool forces, or use a stronger sheet or a finer mesh.";
    switch (report.system) {
    case SolvedSystem::strict: return "";
    case SolvedSystem::continued:
        return "The outline can be used; strains above that value are extrapolated. A softer grade, a shallower part or less tool restraint is needed there.";
    case SolvedSystem::relaxed:
        return "The outline can be used; strains around those vertices are estimates. Check the worst spots; refine the mesh or round sharp edges there.";
    case SolvedSystem::energy:
        return "Outline and strains are a first guess only. Try another stamping direction or a more even mesh, or split the part at its worst spots.";
    }
    return "";
}

} // namespace spia::viewer
