#include "engine/pipeline/run_chain.h"

#include <utility>

#include "engine/core/error.h"
#include "engine/pipeline/flat_thickness.h"
#include "engine/pipeline/run_stage.h"

namespace spia {
namespace {

/// @returns the session with the result of the stage, the surface deformed as is wished
Session made(Stage stage, const Session& before, const ChainWishes& wishes, const Progress& progress,
             const StepWatch& watch)
{
    Session session = run_stage(stage, before, progress, watch);
    if (stage != Stage::fit || !wishes.deformation)
        return session;
    session.options.deformation = deformation_of(*wishes.deformation, fitted_patches(*session.surface));
    return deform_surface(std::move(session), true, progress.part(1, 1));
}

/// The wishes that hang on the part. The force of a bead follows from the thickness of the sheet,
/// which therefore comes first.
void take_wishes_of_part(Session& session, const ChainWishes& wishes)
{
    FlattenOptions& sheet = session.options.flatten;
    sheet.thickness = flat_thickness(wishes.thickness, *session.part, sheet.thickness);
    if (wishes.process)
        sheet.process = wishes.process(*session.part, sheet);
}

/// One stage, and what follows from it before the next.
void pass(Stage stage, Session& session, const ChainWishes& wishes, const ChainHooks& hooks)
{
    session = made(stage, session, wishes, hooks.begins ? hooks.begins(stage) : Progress(), hooks.watch);
    if (hooks.ended)
        hooks.ended(stage, session);
    if (stage != Stage::read)
        return;
    take_wishes_of_part(session, wishes);
    if (hooks.part_is_ready)
        hooks.part_is_ready(session);
}

} // namespace

ChainRun run_chain(Session session, Stage first, Stage last, const ChainWishes& wishes, const ChainHooks& hooks)
{
    ChainRun run{std::move(session), {}, {}};
    for (const Stage stage : chain) {
        if (stage < first || stage > last)
            continue;
        try {
            pass(stage, run.session, wishes, hooks);
        } catch (const Cancelled&) {
            throw;
        } catch (const std::exception& reason) {
            run.failure = {stage, reason.what()};
            run.error = std::current_exception();
            break;
        }
    }
    return run;
}

Session completed(ChainRun run)
{
    if (run.error)
        std::rethrow_exception(run.error);
    return std::move(run.session);
}

} // namespace spia
