#include "app/viewer/model/actions/apply.h"

#include <algorithm>
#include <fmt/core.h>
#include <utility>

#include "app/viewer/model/document/chain.h"
#include "engine/part/vertex_numbers.h"
#include "engine/pipeline/blank/part_bends.h"
#include "engine/pipeline/make_surface.h"

namespace spia::viewer {

template <class Edit> void ViewerModel::Apply::read_again(std::string name, const Edit& edit, Stage to)
{
    if (session.file.empty())
        throw InputError("Open a part first.");
    if (model.busy())
        throw Busy("Cancel the running job first; then read the part with other options.");
    const bool unsaved = state.document.unsaved;
    change(std::move(name));
    (*this)(DismissMessages{}); // of the part as it was read before
    edit(session.options.read);
    model.opening_ = true;
    run_of_change(to, "Reading the part again", unsaved);
}

void ViewerModel::Apply::run_of_change(Stage to, const std::string& title, bool unsaved)
{
    dismiss_failed_run(state.messages);
    const bool begins = !model.chain_job_;
    model.run_to(to, title);
    if (begins && model.chain_job_)
        model.on_cancel_ = {true, 1, unsaved};
}

void ViewerModel::Apply::operator()(const SetUnit& action)
{
    const LengthUnit unit = length_unit(action.unit);
    if (part().cad && part().cad->unit_stated)
        throw InputError("The length unit is stated in the file and cannot be changed.");
    if (part().unit != unit)
        read_again("Change unit", [&](ReadOptions& read) { read.unit = unit; });
}

void ViewerModel::Apply::operator()(const SetReading& action)
{
    if (reading_of(session.options.read) != action.reading)
        read_again("Change reading options", [&](ReadOptions& read) { set_reading(read, action.reading); });
}

void ViewerModel::Apply::operator()(const ReadAgain& action)
{
    ReadOptions wanted = session.options.read;
    if (!action.unit.empty())
        wanted.unit = length_unit(action.unit);
    set_reading(wanted, action.reading);
    const bool same =
        reading_of(wanted) == reading_of(session.options.read) && wanted.unit == session.options.read.unit;
    if (!same)
        read_again("Change reading options", [&](ReadOptions& read) { read = wanted; });
    (*this)(CloseList{});
}

void ViewerModel::Apply::operator()(const SetSeam& action)
{
    if ((action.seam.mode == SeamOptions::Mode::given) == action.seam.path.empty())
        throw InputError("A seam that is given needs a path, any other has none.");
    if (session.options.read.seam == action.seam)
        return;
    // What cutting the corners is worth is told in strain.
    read_again(
        "Change seam", [&](ReadOptions& read) { read.seam = action.seam; },
        action.seam.mode == SeamOptions::Mode::corners ? Stage::solve : Stage::read);
}

void ViewerModel::Apply::operator()(const SetRemeshing& action)
{
    const ReadOptions& now = session.options.read;
    if (now.remesh != action.remesh || now.cad.keep_triangles != !action.remesh)
        read_again(action.remesh ? "Remesh" : "Use the triangles of the file", [&](ReadOptions& read) {
            read.remesh = action.remesh;
            read.cad.keep_triangles = !action.remesh;
        });
}

void ViewerModel::Apply::operator()(const RunTo& action)
{
    if (state.refused && !session.part && !model.opening_)
        throw InputError("The part was refused: repair its faults in the step Part first, or open another one.");
    if (model.opening_) { // as soon as the part is there
        model.next_ = action.stage;
        return;
    }
    // Asked for by name, the one-step solve takes the place of the blank of the steps; else only
    // where that does not hold.
    const bool instead = session.options.steps && action.stage == Stage::solve;
    if (!instead && (!first_stale(document) || *first_stale(document) > action.stage)) {
        const bool fixed = std::any_of(document.regions.begin(), document.regions.end(),
                                       [](const FaceRegion& region) { return region.kind == RegionKind::fixed; });
        model.say(
            Severity::hint,
            session.options.steps
                ? "Everything is up to date, with the blank of the steps. Unfold (F6) unfolds the part in one step instead."
            : fixed ? "Everything is up to date. Fixed regions take effect in Step by step only: propose steps there."
                    : "Everything is up to date.");
        return;
    }
    part();
    dismiss_before_run(state.messages);
    if (model.export_job_)
        throw Busy("Wait for the export to end.");
    if (model.steps_job_)
        throw Busy("Wait for the steps to end, or cancel them.");
    if (model.chain_job_) { // the newest wish counts
        model.next_ = std::max(model.next_.value_or(action.stage), action.stage);
        model.next_in_one_step_ |= instead;
        return;
    }
    const bool unsaved = state.document.unsaved;
    change(action.stage == Stage::solve ? run_names[0] : run_names[1]);
    state.document.unsaved = unsaved; // what is computed comes again by one key: it is no work that could be
                                      // lost
    if (instead) {
        session.options.steps.reset();
        model.say(Severity::hint, "The one-step blank is used again. The blank of the steps is kept with them.");
    }
    model.run_to(action.stage, action.stage == Stage::solve ? "Unfolding" : "Updating all");
    if (model.chain_job_)
        model.on_cancel_.unsaved_before = unsaved;
}

void ViewerModel::Apply::operator()(const CancelJob&)
{
    model.next_.reset();
    model.running_.superseded = false;
    model.next_in_one_step_ = false;
    model.blank_next_.reset();
    model.steps_next_ = false;
    if (model.steps_job_)
        model.steps_job_->cancel();
    if (model.chain_job_)
        model.chain_job_->cancel();
    if (model.export_job_)
        model.export_job_->cancel();
    if ((model.steps_job_ || model.chain_job_ || model.export_job_) && !model.cancelled_at_)
        model.cancelled_at_ = std::chrono::steady_clock::now();
    if (model.list_job_)
        (*this)(CloseList{});
}

void ViewerModel::Apply::operator()(const SetSkins& action)
{
    change("Strains of the skins");
    session.options.flatten.skins = action.skins;
}

void ViewerModel::Apply::operator()(const SetDirection& action)
{
    if (action.direction && !(action.direction->norm() > 0))
        throw InputError("The stamping direction needs a length above 0.");
    change("Change stamping direction");
    session.options.flatten.direction = action.direction;
}

void ViewerModel::Apply::operator()(const SetKFactor& action)
{
    std::optional<KFactor> k;
    if (!action.k_factor.empty())
        k = spia::k_factor(action.k_factor);
    if (k == session.options.k_factor)
        return;
    if (k && session.part && session.part->solid && session.part->solid->skin != Skin::middle)
        throw InputError(
            "A K factor needs the middle surface, but the lengths are those of a skin: choose \"middle\" as \"Skin\" "
            "in the step Part first.");
    const bool unsaved = state.document.unsaved;
    change("Change the K factor", true);
    session.options.k_factor = std::move(k);
    if (session.blank)
        run_of_change(session.surface ? Stage::fit : Stage::solve, "Unfolding with this K factor", unsaved);
}

std::array<int, 4> ViewerModel::Apply::corners_now() const
{
    if (session.options.corners)
        return *session.options.corners;
    if (!session.grid)
        throw InputError("Make the grid first; then its corners can be moved.");
    std::array<int, 4> corners{};
    for (size_t k = 0; k < 4; ++k)
        corners[k] = number_of(part(), session.grid->boundary.corner[k]);
    return corners;
}

void ViewerModel::Apply::require_one_patch() const
{
    if (made_of_patches(session))
        throw InputError(
            "The surface is made of patches, which have corners of their own: choose \"One patch\" in the step NURBS surface first.");
}

/// Who moves a corner or changes the grid wants one patch, as near to the part as the program's
/// choice was.
void ViewerModel::Apply::take_one_patch()
{
    if (!std::exchange(session.options.best_surface, false))
        return;
    if (session.part && !session.options.tolerance)
        session.options.tolerance = surface_tolerance(session);
    if (session.surface)
        model.say(Severity::hint, "The surface is made of one patch from now on, see the step NURBS surface.");
}

void ViewerModel::Apply::operator()(const SetCorner& action)
{
    // whatever comes: the next grid is a fine one
    const bool on_the_way = std::exchange(model.dragging_, false);
    if (!session.blank)
        throw InputError("Unfold the part first; then its corners can be chosen.");
    if (action.corner < 0 || action.corner > 3)
        throw InputError(fmt::format("There is no corner {}; they count from 0 to 3.", action.corner));
    require_one_patch();
    if (action.vertex < 0 || action.vertex >= part().mesh.vertices())
        throw InputError(fmt::format("The part has no vertex {}.", action.vertex));
    const std::vector<int>& outline = model.pickers_.outline(session);
    if (std::find(outline.begin(), outline.end(), action.vertex) == outline.end())
        throw InputError(fmt::format("Vertex {} is not on the outer outline of the blank; corners must lie there.",
                                     part().source_vertex[size_t(action.vertex)]));
    std::array<int, 4> corners = corners_now();
    const int in_file = number_of(part(), action.vertex);
    for (int k = 0; k < 4; ++k)
        // two corners at one place: the mouse is on its way past the other one
        if (k != action.corner && corners[size_t(k)] == in_file) {
            if (!action.dragging && session.grid)
                model.run_to(Stage::fit, "Making the grid");
            return;
        }
    if (!on_the_way && corners[size_t(action.corner)] == in_file) {
        model.say(Severity::hint, fmt::format("Corner {} stays where it is: corners lie at vertices of the mesh, and "
                                              "no other one of the outline is nearer to the mouse.",
                                              action.corner + 1));
        return;
    }
    const bool unsaved = state.document.unsaved;
    change(fmt::format("Move corner {}", action.corner + 1), true);
    if (!action.dragging)
        state.history.close();
    corners[size_t(action.corner)] = in_file;
    session.options.corners = corners;
    take_one_patch();
    model.dragging_ = action.dragging;
    if (action.dragging)
        model.run_to(Stage::lift, "Making the grid");
    else
        run_of_change(Stage::fit, "Making the grid", unsaved);
}

void ViewerModel::Apply::operator()(const ProposeCorners&)
{
    require_one_patch();
    const bool unsaved = state.document.unsaved;
    change("Propose corners");
    session.options.corners.reset();
    take_one_patch();
    if (session.blank)
        run_of_change(Stage::fit, "Making the grid", unsaved);
}

void ViewerModel::Apply::operator()(const SetGrid& action)
{
    const GridOptions& grid = action.grid;
    if (grid.columns < 0 || grid.rows < 0 || grid.columns > 2000 || grid.rows > 2000 || grid.cells < 1 ||
        grid.cells > 2000)
        throw InputError("A grid has from 1 to 2000 cells in each direction (0: automatic).");
    const bool unsaved = state.document.unsaved;
    change("Change grid", true);
    session.options.grid = grid;
    take_one_patch();
    if (session.blank)
        run_of_change(Stage::fit, "Making the grid", unsaved);
}

void ViewerModel::Apply::operator()(const SetFit& action)
{
    SessionOptions options = session.options;
    set_fit(options, action.fit);
    const bool unsaved = state.document.unsaved;
    change("Change the surface");
    session.options = std::move(options);
    if (session.lifted || (session.blank && (session.options.patches || session.options.best_surface)))
        run_of_change(Stage::fit, "Fitting the surface", unsaved);
}

void ViewerModel::Apply::operator()(const SetLimits& action)
{
    Session judged = as_made(document);
    judged.options.limits = limits_options(action.limits);
    if (session.blank)
        judged = judge_limits(std::move(judged));
    change("Change forming limits", true);
    document.limits = action.limits;
    session.options.limits = document.made_with.limits = judged.options.limits;
    session.limits = judged.limits;
}

} // namespace spia::viewer
