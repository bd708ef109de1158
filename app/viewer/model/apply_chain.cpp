#include "app/viewer/model/apply.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/chain.h"
#include "engine/exchange/vertex_numbers.h"

namespace spia::viewer {

void ViewerModel::Apply::begin_with(Document fresh)
{
    if (model.chain_job_) {
        model.chain_job_->cancel();
        model.ending_.push_back(std::move(model.chain_job_));
    }
    if (model.steps_job_) {
        model.steps_job_->cancel();
        model.ending_steps_.push_back(std::move(model.steps_job_));
    }
    model.steps_next_ = model.keep_step_ = false;
    state.view.unfolded = 0;
    state.view.step.reset();
    model.next_.reset();
    model.next_in_one_step_ = false;
    model.blank_next_.reset();
    model.unsaved_before_.reset();
    model.project_.reset();
    state.job = JobView{};
    document = std::move(fresh);
    state.history = History{};
    for (Message& message : state.messages)
        message.dismissed = true;
    state.refused.reset();
    state.fault.reset();
    model.dragging_ = false;
    model.keep_cameras_ = false;
    model.opening_ = true;
    ++model.openings_;
    model.start(Stage::read, Stage::read, "Opening " + document.session.file.filename().string());
}

void ViewerModel::Apply::require_no_export() const
{
    if (model.export_job_)
        throw InputError("Wait for the export to end.");
}

void ViewerModel::Apply::operator()(const ListFile& action)
{
    if (action.again && action.file != session.file)
        throw InputError("Only the file of the part can be read again.");
    (*this)(CloseList{});
    state.listing = FileListing{action.file, action.again};
    model.list_job_ = std::make_unique<Job<ListedFile>>(
        [file = action.file](const Progress& progress) { return look_into(file, progress); }, model.wake_);
}

void ViewerModel::Apply::operator()(const CloseList&)
{
    if (model.list_job_) {
        model.list_job_->cancel();
        model.ending_lists_.push_back(std::move(model.list_job_));
    }
    state.listing.reset();
}

void ViewerModel::Apply::operator()(const OpenPart& action)
{
    require_no_export();
    Document fresh;
    fresh.display = document.display;
    fresh.display.range.reset();
    fresh.material = document.material;
    fresh.material_from = document.material_from;
    fresh.thickness_from = document.thickness_from == SheetSource::assumed ? SheetSource::assumed : SheetSource::before;
    fresh.limits = document.limits;
    fresh.session.options.limits = session.options.limits;
    fresh.session.options.flatten.material = session.options.flatten.material;
    fresh.session.options.flatten.thickness = session.options.flatten.thickness;
    fresh.session.options.interpolate = session.options.interpolate;
    set_fit(fresh.session.options, fit_choice(session.options));
    begin_as_preferred(fresh);
    if (!action.unit.empty())
        fresh.session.options.read.unit = length_unit(action.unit);
    set_reading(fresh.session.options.read, action.reading);
    fresh.session.file = action.file;
    if (!std::filesystem::exists(action.file))
        throw InputError(fmt::format("There is no file {}.", action.file.string()));
    (*this)(CloseList{});
    state.project.clear();
    state.unsaved = false;
    begin_with(std::move(fresh));
}

template <class Edit> void ViewerModel::Apply::read_again(std::string name, const Edit& edit)
{
    if (session.file.empty())
        throw InputError("Open a part first.");
    if (model.busy())
        throw InputError("Cancel the running job first; then read the part otherwise.");
    change(std::move(name));
    (*this)(DismissMessages{}); // of the part as it was read before
    edit(session.options.read);
    model.opening_ = true;
    model.run_to(Stage::read, "Reading the part again");
}

void ViewerModel::Apply::operator()(const SetUnit& action)
{
    const LengthUnit unit = length_unit(action.unit);
    if (part().cad && part().cad->unit_stated)
        throw InputError("The file says itself what its lengths are in.");
    if (part().unit != unit)
        read_again("Change unit", [&](ReadOptions& read) { read.unit = unit; });
}

void ViewerModel::Apply::operator()(const SetReading& action)
{
    if (reading_of(session.options.read) != action.reading)
        read_again("Read the part otherwise", [&](ReadOptions& read) { set_reading(read, action.reading); });
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
        read_again("Read the part otherwise", [&](ReadOptions& read) { read = wanted; });
    (*this)(CloseList{});
}

void ViewerModel::Apply::operator()(const SetSeam& action)
{
    if ((action.seam.mode == SeamOptions::Mode::given) == action.seam.path.empty())
        throw InputError("A seam that is given needs a path, any other has none.");
    if (session.options.read.seam == action.seam)
        return;
    read_again("Change seam", [&](ReadOptions& read) { read.seam = action.seam; });
}

void ViewerModel::Apply::operator()(const SetRemeshing& action)
{
    const ReadOptions& now = session.options.read;
    if (now.remesh != action.remesh || now.cad.keep_triangles != !action.remesh)
        read_again(action.remesh ? "Remesh" : "Take the triangles of the file", [&](ReadOptions& read) {
            read.remesh = action.remesh;
            read.cad.keep_triangles = !action.remesh;
        });
}

void ViewerModel::Apply::operator()(const RunTo& action)
{
    if (state.refused && !session.part && !model.opening_)
        throw InputError("The part was refused: mend its faults in the step Part first, or open another one.");
    if (model.opening_) { // as soon as the part is there
        model.next_ = action.stage;
        return;
    }
    // Asked for by name, the one-step solve takes the place of the blank of the steps; else only where that does not hold.
    const bool instead = session.options.steps && action.stage == Stage::solve;
    if (!instead && (!first_stale(document) || *first_stale(document) > action.stage)) {
        model.say(Severity::hint, session.options.steps
                                      ? "Everything is up to date, from the blank of the steps. Unfold (F6) solves the "
                                        "part in one step instead."
                                      : "Everything is up to date.");
        return;
    }
    part();
    dismiss_before_run(state.messages);
    if (model.export_job_)
        throw InputError("Wait for the export to end.");
    if (model.steps_job_)
        throw InputError("Wait for the steps to end, or cancel them.");
    if (model.chain_job_) { // the newest wish counts
        model.next_ = std::max(model.next_.value_or(action.stage), action.stage);
        model.next_in_one_step_ |= instead;
        return;
    }
    const bool unsaved = state.unsaved;
    change(action.stage == Stage::solve ? "Unfold" : "Run the chain");
    if (instead) {
        session.options.steps.reset();
        model.say(Severity::hint,
                  "The blank is that of one step again. That of the steps is kept with them, to be used "
                  "once more.");
    }
    model.run_to(action.stage, action.stage == Stage::solve ? "Unfolding" : "Running the chain");
    if (model.chain_job_)
        model.unsaved_before_ = unsaved;
}

void ViewerModel::Apply::operator()(const CancelJob&)
{
    model.next_.reset();
    model.next_in_one_step_ = false;
    model.blank_next_.reset();
    model.steps_next_ = false;
    if (model.steps_job_)
        model.steps_job_->cancel();
    if (model.chain_job_) {
        model.chain_job_->cancel();
        if (!model.cancelled_at_)
            model.cancelled_at_ = std::chrono::steady_clock::now();
    }
    if (model.export_job_)
        model.export_job_->cancel();
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
    if (session.options.patches)
        throw InputError(
            "The surface is made of patches, which have corners of their own: choose \"One patch\" in the step NURBS surface first.");
}

void ViewerModel::Apply::operator()(const SetCorner& action)
{
    model.dragging_ = false; // whatever comes: the next grid is a fine one
    if (!session.blank)
        throw InputError("Unfold the part first; then its corners can be chosen.");
    if (action.corner < 0 || action.corner > 3)
        throw InputError(fmt::format("There is no corner {}; they count from 0 to 3.", action.corner));
    require_one_patch();
    if (action.vertex < 0 || action.vertex >= part().mesh.vertices())
        throw InputError(fmt::format("The part has no vertex {}.", action.vertex));
    const std::vector<int>& outline = model.pickers_.outline(session);
    if (std::find(outline.begin(), outline.end(), action.vertex) == outline.end())
        throw InputError(fmt::format("Vertex {} is not on the outer outline of the blank, where corners have to be.",
                                     part().source_vertex[size_t(action.vertex)]));
    std::array<int, 4> corners = corners_now();
    const int in_file = number_of(part(), action.vertex);
    for (int k = 0; k < 4; ++k)
        if (k != action.corner &&
            corners[size_t(k)] == in_file) { // two corners at one place: the mouse is on its way past the other one
            if (!action.dragging && session.grid)
                model.run_to(Stage::fit, "Making the grid");
            return;
        }
    change(fmt::format("Move corner {}", action.corner + 1), true);
    if (!action.dragging)
        state.history.close();
    corners[size_t(action.corner)] = in_file;
    session.options.corners = corners;
    model.dragging_ = action.dragging;
    model.run_to(action.dragging ? Stage::lift : Stage::fit, "Making the grid");
}

void ViewerModel::Apply::operator()(const ProposeCorners&)
{
    require_one_patch();
    change("Propose corners");
    session.options.corners.reset();
    if (session.blank)
        model.run_to(Stage::fit, "Making the grid");
}

void ViewerModel::Apply::operator()(const SetGrid& action)
{
    const GridOptions& grid = action.grid;
    if (grid.columns < 0 || grid.rows < 0 || grid.columns > 2000 || grid.rows > 2000 || grid.cells < 1 ||
        grid.cells > 2000)
        throw InputError("A grid has from 1 to 2000 cells each way (0: automatic).");
    change("Change grid", true);
    session.options.grid = grid;
    if (session.blank)
        model.run_to(Stage::fit, "Making the grid");
}

void ViewerModel::Apply::operator()(const SetFit& action)
{
    SessionOptions options = session.options;
    set_fit(options, action.fit);
    change("Change the surface");
    session.options = std::move(options);
    if (session.lifted || (session.blank && session.options.patches))
        model.run_to(Stage::fit, "Fitting the surface");
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
