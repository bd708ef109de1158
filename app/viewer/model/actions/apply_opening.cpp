#include "app/viewer/model/actions/apply.h"

#include <fmt/core.h>

#include "app/viewer/model/document/chain.h"

namespace spia::viewer {

void ViewerModel::Apply::change(std::string name, bool merge)
{
    if (model.opening_beside_)
        throw InputError(fmt::format("{} is being read. Wait for it, or press Esc to stay with {}.",
                                     model.opening_beside_->document.session.file.filename().string(),
                                     session.file.filename().string()));
    state.history.remember(std::move(name), document, merge);
    state.document.unsaved = true;
}

void ViewerModel::Apply::end_runs()
{
    if (model.chain_job_) {
        model.chain_job_->cancel();
        model.ending_.push_back(std::move(model.chain_job_));
        ChainResult nothing; // the part may stay: a run that has given nothing is no change of it
        nothing.session = session;
        nothing.cancelled = true;
        model.forget_run_without_result(nothing, session);
    }
    if (model.steps_job_) {
        model.steps_job_->cancel();
        model.ending_steps_.push_back(std::move(model.steps_job_));
    }
    model.forget_waiting();
    model.opening_beside_.reset();
    model.steps_next_ = model.keep_step_ = false;
    model.next_.reset();
    model.next_in_one_step_ = false;
    model.blank_next_.reset();
    model.on_cancel_ = {};
    model.dragging_ = false;
    state.job = JobView{};
}

void ViewerModel::Apply::begin_with(Opening opening)
{
    end_runs();
    model.opening_ = true;
    ++model.openings_;
    const std::string title = "Opening " + opening.document.session.file.filename().string();
    if (session.part || opening.otherwise) {
        model.opening_beside_ = std::move(opening);
        model.start_chain(Stage::read, Stage::read, title, model.opening_beside_->document);
        return;
    }
    model.replace_document(std::move(opening));
    model.start_chain(Stage::read, Stage::read, title, document);
}

void ViewerModel::Apply::require_no_export() const
{
    if (model.export_job_)
        throw Busy("Wait for the export to end.");
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
    if (!std::filesystem::exists(action.file))
        throw InputError(fmt::format("There is no file {}.", action.file.string()));
    if (!model.without_part_) {
        open_part(action);
        return;
    }
    Opening opening = *model.without_part_;
    opening.document.session.file = action.file;
    opening.unsaved = true; // it has its part elsewhere now
    opening.otherwise = action;
    (*this)(CloseList{});
    begin_with(std::move(opening));
}

void ViewerModel::Apply::open_part(const OpenPart& action, std::string note)
{
    Document fresh;
    fresh.material = document.material;
    fresh.material_from = document.material_from == SheetSource::assumed ? SheetSource::assumed : SheetSource::before;
    fresh.thickness_from = document.thickness_from == SheetSource::assumed ? SheetSource::assumed : SheetSource::before;
    fresh.limits = document.limits;
    fresh.session.options.limits = session.options.limits;
    fresh.session.options.flatten.material = session.options.flatten.material;
    fresh.session.options.flatten.thickness = session.options.flatten.thickness;
    begin_as_preferred(fresh);
    if (!action.unit.empty())
        fresh.session.options.read.unit = length_unit(action.unit);
    set_reading(fresh.session.options.read, action.reading);
    fresh.session.file = action.file;
    (*this)(CloseList{});
    Opening opening{std::move(fresh)};
    opening.note = std::move(note);
    begin_with(std::move(opening));
}

void ViewerModel::Apply::operator()(const ShowRefused&)
{
    if (!state.refused_file)
        throw InputError("There is no refused file beside the part.");
    if (std::exchange(state.refused_file->shown, true))
        return;
    state.refused_file->camera = state.view.camera;
    state.fault.reset();
    if (state.view.maximised)
        state.view.maximised = View::part;
    Camera& camera = state.view.camera[size_t(View::part)];
    camera = look(camera, StandardView::isometric);
    model.fitter_.fit(state, View::part);
}

void ViewerModel::Apply::operator()(const CloseRefused&)
{
    if (!state.refused_file)
        return;
    if (shows_refused(state)) {
        state.view.camera = state.refused_file->camera;
        state.fault.reset();
    }
    state.refused.reset();
    state.refused_file.reset();
}

} // namespace spia::viewer
