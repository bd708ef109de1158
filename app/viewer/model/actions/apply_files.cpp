#include "app/viewer/model/actions/apply.h"

#include <fmt/core.h>

#include "app/viewer/model/document/recent_files.h"
#include "engine/options/option.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {

void ViewerModel::Apply::go(void (History::*way)(Document&))
{
    if (model.chain_job_ || model.steps_job_)
        throw Busy("Cancel the running job first; then undo.");
    const std::string name = way == &History::undo ? state.history.undo_name() : state.history.redo_name();
    if (name.empty())
        return;
    (state.history.*way)(document);
    if (state.refused_file)
        return;
    state.refused.reset(); // of another way to read the part
    state.fault.reset();
}

void ViewerModel::Apply::operator()(const OpenProject& action)
{
    require_no_export();
    Project project = open_project(action.file, model.assets() / "materials");
    const bool left_behind = is_autosave(action.file); // of a part without a project `recovers` is
                                                       // empty
    Opening opening{project.document, {}, left_behind ? project.recovers : action.file, left_behind};
    opening.project = std::move(project);
    const std::filesystem::path file = opening.document.session.file;
    std::error_code problem;
    if (!std::filesystem::exists(file, problem)) {
        model.without_part_ = std::move(opening);
        const std::string open = session.part ? session.file.filename().string() : "";
        throw InputError(fmt::format(
            "The project's part {} no longer exists: put it back, or open it from where it is now, and the project's "
            "settings come with it.{}",
            file.string(),
            open.empty()              ? ""
            : open == file.filename() ? " What is shown stays as it is."
                                      : fmt::format(" {} is still open.", open)));
    }
    begin_with(std::move(opening));
}

void ViewerModel::Apply::operator()(const TakeOpened& action)
{
    if (!model.waiting_)
        throw InputError("No file is waiting to be opened.");
    if (state.document.unsaved && !action.without_saving)
        return; // saving has failed: the user is asked again
    state.read_and_waits.reset();
    model.take_result(std::move(*std::exchange(model.waiting_, std::nullopt)), "Opening");
}

void ViewerModel::Apply::operator()(const DropOpened&)
{
    if (model.waiting_)
        model.forget_waiting();
}

void ViewerModel::Apply::operator()(const SaveProject& action)
{
    const std::filesystem::path file = action.file.empty() ? state.project : action.file;
    if (file.empty())
        throw InputError("Give the project a name: Save project as.");
    save_project(file, document, kept_view(state));
    state.project = file;
    // What undo or redo bring back now is not what the file holds.
    state.history.update_since(0, [](Document& other) { other.unsaved = true; });
    document.unsaved = false;
    model.say(Severity::done, fmt::format("Saved {}", file.string()));
}

void ViewerModel::Apply::operator()(const ExportFiles& action)
{
    if (model.busy())
        throw Busy("Wait for the running job to end, then export.");
    if (!session.blank)
        throw InputError("There is nothing to export yet: unfold the part first.");
    if (state.exported) // why the one before failed is of the past
        for (Message& message : state.messages)
            message.dismissed |=
                message.severity == Severity::error && message.text == sentence(window_text(state.exported->error));
    state.exported.reset();
    state.job = JobView{};
    state.job.running = true;
    state.job.title = "Exporting";
    model.cancelled_at_.reset();
    model.exported_so_far_ = std::make_shared<Mailbox<ViewerModel::Files>>();
    model.export_job_ = std::make_unique<Job<ViewerModel::Files>>(
        [session = as_made(document), action, so_far = model.exported_so_far_](const Progress& progress) {
            ViewerModel::Files files;
            return write_outputs(session, action.folder, action.formats, action.options, progress,
                                 [&](const std::filesystem::path& file) {
                                     files.push_back(file);
                                     so_far->post(files);
                                 });
        },
        model.wake_);
}

void ViewerModel::Apply::operator()(const DismissMessages&)
{
    for (Message& message : state.messages)
        message.dismissed = true;
}

void ViewerModel::apply(const Action& action)
{
    const int posted_before = messages_posted_, document_before = state_.history.now();
    try {
        visit_action(Apply{*this}, action);
    } catch (const Busy& error) {
        say(Severity::error, error.what(), about_job());
    } catch (const std::exception& error) {
        say(Severity::error, error.what(), about_refusal(state_));
    }
    follow_reference();
    follow_doubts();
    const Subject subject = state_.history.now() == document_before ? about_refusal(state_) : about_change(state_);
    for (Message& message : state_.messages) // of the action
        if (message.number > posted_before && message.subject.kind == Subject::Kind::none)
            message.subject = subject;
    follow_messages();
}

} // namespace spia::viewer
