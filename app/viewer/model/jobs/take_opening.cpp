#include "app/viewer/model/actions/apply.h"
#include "app/viewer/model/jobs/viewer_model.h"

#include <algorithm>
#include <fmt/core.h>
#include <utility>

#include "app/viewer/model/document/k_choice.h"
#include "app/viewer/model/reports/grid_advice.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {

static std::string worst_fault(const PartFile& refused)
{
    const auto& findings = refused.doctor.findings;
    return std::find_if(findings.begin(), findings.end(),
                        [](const Finding& f) { return f.severity == spia::Severity::fatal; })
        ->text;
}

/// The new part is not there: the one before stays, with all that was made of it.
void ViewerModel::report_not_opened(const Opening& opening, const ChainResult& result)
{
    const std::string name = opening.document.session.file.filename().string(),
                      open = state_.document.session.file.filename().string();
    if (result.cancelled) {
        say(Severity::hint,
            fmt::format("Opening {}: cancelled.{}", name, open.empty() ? "" : fmt::format(" {} is still open.", open)),
            about_refusal(state_));
        return;
    }
    if (shows_refused(state_)) // of an earlier file
        state_.view.camera = state_.refused_file->camera;
    state_.refused = result.refused;
    state_.refused_file.reset();
    state_.fault.reset();
    if (state_.refused) {
        state_.refused_file = RefusedFile{opening.document.session.file, opening.document.session.options.read};
        say(Severity::error,
            fmt::format("{} was refused: {}. {} is still open; the step Part shows the faults of the other file.", name,
                        worst_fault(*state_.refused), open),
            about_refused_part(state_));
        return;
    }
    std::string why = result.message;
    const std::string path = opening.document.session.file.string();
    if (const size_t at = why.find(path); at != std::string::npos)
        why.replace(at, path.size(), name);
    if (why.find(name) == std::string::npos)
        why = name + " cannot be opened: " + why;
    say(Severity::error,
        fmt::format("{} {}", sentence(why), open == name ? "What is shown stays as it is." : open + " is still open."));
}

/// What was read for a project whose part is not where it was: if it is another part, it is opened
/// without the project. @returns whether it is
bool ViewerModel::open_by_itself(const ChainResult& result)
{
    if (!opening_beside_ || !opening_beside_->otherwise || result.cancelled)
        return false;
    Opening& opening = *opening_beside_;
    const std::filesystem::path file = opening.document.session.file;
    const std::string project = opening.project_file.empty() ? "the project" : opening.project_file.filename().string();
    if (result.session.part && fingerprint(*result.session.part) == opening.project->picks.fingerprint) {
        opening.note = fmt::format("{} has its part at {} now. Save the project to keep that.", project, file.string());
        return false;
    }
    const std::string note = fmt::format("{} is not the part that {} was saved with, and is opened without its "
                                         "settings. To get these, put the part back at {}.",
                                         file.filename().string(), project,
                                         without_part_ ? without_part_->document.session.file.string() : "its place");
    const OpenPart action = *opening.otherwise;
    const auto next = next_;
    opening_beside_.reset();
    opening_ = false;
    try {
        Apply{*this}.open_part(action, note);
        next_ = next;
    } catch (const std::exception& error) {
        say(Severity::error, error.what());
    }
    return true;
}

void ViewerModel::forget_waiting()
{
    state_.read_and_waits.reset();
    if (!std::exchange(waiting_, std::nullopt))
        return;
    opening_beside_.reset();
    opening_ = false;
    next_.reset(); // was for that part
    next_in_one_step_ = false;
}

/// What was read while another part was open takes its place, if it is there. @returns whether it
/// is
bool ViewerModel::take_opening(const ChainResult& result)
{
    Opening opening = std::move(*std::exchange(opening_beside_, std::nullopt));
    if (result.session.part) {
        replace_document(std::move(opening));
        running_.depth_at_start = state_.history.depth();
        return true;
    }
    opening_ = false;
    next_.reset(); // was for the new part
    next_in_one_step_ = false;
    report_not_opened(opening, result);
    return false;
}

void ViewerModel::replace_document(Opening opening)
{
    if (!opening.project) { // how fields are drawn stays chosen from part to part; each begins with
                            // the thinning
        opening.document.display = state_.document.display;
        opening.document.display.field = FieldDisplay{}.field;
        opening.document.display.range.reset();
    }
    const auto k_before = std::exchange(state_.document, std::move(opening.document)).session.options.k_factor;
    const bool k_forgotten = k_before && !opening.project && !state_.document.session.options.k_factor;
    project_ = std::move(opening.project);
    state_.project = std::move(opening.project_file);
    state_.document.unsaved = opening.unsaved;
    state_.view.unfolded = 0;
    state_.view.step.reset();
    state_.history = History{};
    for (Message& message : state_.messages)
        message.dismissed = true;
    if (shows_refused(state_))
        state_.view.camera = state_.refused_file->camera;
    state_.refused.reset();
    state_.refused_file.reset();
    state_.fault.reset();
    state_.spot.reset();
    keep_cameras_ = false;
    without_part_.reset();
    ++documents_;
    if (!opening.note.empty())
        say(Severity::hint, std::move(opening.note));
    if (k_forgotten)
        say(Severity::hint, fmt::format("The K factor is {} again; that of the part before was {}.", KFactor{}.name,
                                        k_words(k_before)));
}

void ViewerModel::report_failed(const ChainResult& result)
{
    const bool reading = *result.failed == Stage::read;
    if (reading) {
        state_.refused = result.refused;
        state_.refused_file.reset();
    }
    if (!state_.refused || !reading) {
        // the engine's advice comes after a semicolon; that of the window takes its place
        const std::string fault =
            *result.failed == Stage::grid ? result.message.substr(0, result.message.rfind(';')) : result.message;
        say(Severity::error,
            fmt::format("{}{} {}", sentence(fault), fault.ends_with(')') ? "." : "",
                        reading                         ? "Choose another file."
                        : *result.failed == Stage::grid ? grid_advice(result.session, result.message)
                                                        : advice(*result.failed, result.session.options)),
            about_change(state_));
        return;
    }
    say(Severity::error,
        fmt::format("{} was refused: {}. {}", state_.document.session.file.filename().string(),
                    worst_fault(*state_.refused), advice(*result.failed, result.session.options)),
        about_refused_part(state_));
    fitter_.fit(state_, View::part);
}

void ViewerModel::part_opened(const SessionOptions& read_with)
{
    Document& document = state_.document;
    if (!document.session.part)
        return;
    state_.view.camera[size_t(View::part)] = look(state_.view.camera[size_t(View::part)], StandardView::isometric);
    state_.view.clip.on = false; // of another part
    fitter_.fit(state_);
    const PartFile& part = *document.session.part;
    if (part.thickness_mm && !project_) {
        document.session.options.flatten.thickness = read_with.flatten.thickness;
        document.thickness_from = SheetSource::file;
    }
    const size_t notes = notes_on_reading(part).size() + part.doctor.findings.size();
    if (notes > 0)
        say(Severity::hint,
            fmt::format("Opened {}: {}, see the step Part.", document.session.file.filename().string(),
                        notes == 1 ? "1 note" : fmt::format("{} notes", notes)),
            about_part(state_));
}

/// The picks of a project on its part, which may have changed since; then the stages it had.
void ViewerModel::project_opened(const std::shared_ptr<const ClosestPointSearch>& search)
{
    const Project project = std::move(*std::exchange(project_, std::nullopt));
    Document& document = state_.document;
    if (!document.session.part)
        return;
    // the rest of the project is sound
    for (const std::string& lost : restore(document, project.picks, search))
        say(Severity::warning, lost);
    const bool dark = state_.view.dark; // of the one who opens it, as the mouse's habits are
    const MouseStyle mouse = state_.view.mouse;
    state_.view = project.view;
    state_.view.dark = dark;
    state_.view.mouse = mouse;
    steps_next_ = keep_step_ = project.steps_ran && !document.steps.empty();
    keep_cameras_ = project.ran && *project.ran > Stage::read; // else nobody has seen a blank yet
    if (keep_cameras_ && project.blank_of_steps && steps_next_)
        blank_next_ = BlankNext{*project.blank_of_steps, *project.ran};
    else if (keep_cameras_) {
        if (project.blank_of_steps)
            say(Severity::warning,
                "The steps have changed since their blank was computed; the part is unfolded in one step. Run the steps and use their blank again.");
        next_ = std::max(next_.value_or(*project.ran), *project.ran);
    }
}

} // namespace spia::viewer
