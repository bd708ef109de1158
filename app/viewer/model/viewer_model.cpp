#include "app/viewer/model/viewer_model.h"

#include <algorithm>
#include <chrono>
#include <fmt/core.h>
#include <mutex>

#include "app/viewer/model/grades.h"
#include "app/viewer/model/grid_advice.h"
#include "app/viewer/model/handles.h"
#include "app/viewer/model/lengths.h"
#include "app/viewer/model/measuring.h"
#include "app/viewer/model/viewer_words.h"
#include "engine/core/error.h"
#include "engine/forming/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/outputs.h"
#include "engine/pipeline/report.h"
#include "engine/pipeline/shortcomings.h"

namespace spia::viewer {

/// Filled on the solver's thread, emptied on the window's.
struct ViewerModel::Live {
    Mailbox<std::shared_ptr<const Eigen::Matrix2Xd>> blank;
    Mailbox<ChainResult> so_far; ///< the stages that have ended
    std::mutex mutex;
    std::vector<double> residual;
    std::chrono::steady_clock::time_point last;

    void see(const Eigen::Matrix2Xd& position, const NewtonStep& step)
    {
        {
            const std::lock_guard lock(mutex);
            residual.push_back(step.residual);
        }
        const auto now = std::chrono::steady_clock::now();
        if (now - last < std::chrono::milliseconds(50)) // nobody sees more
            return;
        last = now;
        blank.post(std::make_shared<Eigen::Matrix2Xd>(position));
    }
};

ViewerModel::ViewerModel(std::filesystem::path assets, std::function<void()> wake)
    : assets_(std::move(assets)), wake_(std::move(wake)), pickers_(wake_)
{
    Document& document = state_.document;
    document.session.options.flatten.material = find_material(document.material, assets_ / "materials");
    state_.view.camera[size_t(View::blank)].flat = true;
    state_.grades = std::make_shared<const std::vector<Grade>>(read_grades(assets_ / "materials", own_materials()));
}

ViewerModel::~ViewerModel() = default;

void ViewerModel::say(Severity severity, std::string text, Subject subject)
{
    Message message{severity, std::move(text)};
    message.subject = std::move(subject);
    say(std::move(message));
}

void ViewerModel::say(Message message)
{
    message.text = sentence(in_viewer_words(std::move(message.text)));
    message.number = ++said_;
    constexpr size_t most = 50;
    std::erase_if(state_.messages, [&](const Message& before) { // said again, it is the newest once more
        return before.severity == message.severity && before.text == message.text &&
               (before.shown() || same(before.subject, message.subject));
    });
    state_.messages.push_back(std::move(message));
    if (state_.messages.size() > most)
        state_.messages.erase(state_.messages.begin());
}

void ViewerModel::follow_messages()
{
    for (Message& message : state_.messages) {
        message.gone = !holds(message.subject, state_);
        message.dismissed |=
            message.gone && message.subject.kind == Subject::Kind::refusal; // not to come back with undo
    }
}

void ViewerModel::follow_doubts()
{
    DoubtsOf now = doubts_of(state_.document, state_.preferences.lengths);
    if (state_.doubts && now == doubts_of_)
        return;
    doubts_of_ = std::move(now);
    state_.doubts =
        std::make_shared<const std::vector<Doubt>>(find_doubts(state_.document, state_.preferences.lengths));
}

void ViewerModel::start(Stage from, Stage to, std::string title, const Document& document)
{
    live_ = std::make_shared<Live>();
    cancelled_at_.reset();
    depth_at_start_ = state_.history.depth();
    Session session = document.session;
    if (session.options.steps) { // the tools are not in them
        const bool skins = session.options.flatten.skins;
        session.options.flatten = sheet_of_steps(session.options.flatten);
        session.options.flatten.skins = skins;
    }
    session.options.flatten.watch = [live = live_](const Eigen::Matrix2Xd& X, const NewtonStep& step) {
        live->see(X, step);
    };
    if (dragging_) {
        constexpr int few = 14;
        session.options.grid.columns = session.options.grid.rows = 0;
        session.options.grid.cells = std::min(session.options.grid.cells, few);
    }
    state_.job = JobView{};
    state_.job.running = true;
    state_.job.title = std::move(title);
    chain_job_ = std::make_unique<Job<ChainResult>>(
        [session = std::move(session), made_with = document.made_with, from, to,
         live = live_](const Progress& progress) {
            return run_chain(session, made_with, from, to, progress,
                             [&](const ChainResult& result) { live->so_far.post(result); });
        },
        wake_);
}

void ViewerModel::run_to(Stage to, const std::string& title)
{
    if (state_.document.session.file.empty()) {
        say(Severity::hint, "Open a part first.");
        return;
    }
    if (export_job_) {
        say(Severity::hint, "Wait for the export to end.");
        return;
    }
    if (steps_job_) {
        say(Severity::hint, "Wait for the steps to end, or cancel them.");
        return;
    }
    if (chain_job_) { // the newest wish counts, from what is there then
        next_ = std::max(next_.value_or(to), to);
        return;
    }
    const std::optional<Stage> from = first_stale(state_.document);
    std::optional<BlankOfSteps>& steps = state_.document.session.options.steps;
    if (steps && from && *from <= Stage::solve && to >= Stage::solve &&
        (*from == Stage::read || !holds(state_.document, *steps))) { // what is read may be another part
        steps.reset();
        say(Severity::hint,
            "The steps, the part or its sheet have changed since the blank of the steps was computed; the part is unfolded in one step again.");
    }
    if (from && *from <= to)
        start(*from, to, title, state_.document);
}

bool ViewerModel::poll()
{
    bool news = false;
    JobView& view = state_.job;
    std::erase_if(ending_, [](const auto& job) { return job->finished(); });
    std::erase_if(ending_steps_, [](const auto& job) { return job->finished(); });
    std::erase_if(ending_lists_, [](const auto& job) { return job->finished(); });
    pickers_.follow(state_.document.session);
    pickers_.follow_steps(state_);
    if (chain_job_) {
        view.fraction = chain_job_->fraction();
        view.step = chain_job_->step();
        view.cancelling = chain_job_->cancelling();
        if (auto blank = live_->blank.fetch()) {
            const bool first = !view.blank && !state_.document.session.blank;
            view.blank = std::move(*blank);
            if ((first && !keep_cameras_) || fitter_.is_fitted(state_, View::blank))
                fitter_.fit(state_, View::blank); // it moves and grows until it has converged
            news = true;
        }
        {
            const std::lock_guard lock(live_->mutex);
            news |= live_->residual.size() != view.residual.size();
            view.residual = live_->residual;
        }
        if (chain_job_->finished() || waited_long_for_cancel()) {
            take_chain_result();
            news = true;
        }
    }
    if (list_job_) {
        follow_list();
        news = true;
    }
    if (steps_job_) {
        view.fraction = steps_job_->fraction();
        view.step = steps_job_->step();
        view.cancelling = steps_job_->cancelling();
        if (steps_job_->finished()) {
            take_steps_result();
            news = true;
        }
    }
    if (export_job_) {
        view.fraction = export_job_->fraction();
        view.step = export_job_->step();
        view.cancelling = export_job_->cancelling();
        if (export_job_->finished()) {
            take_export_result();
            news = true;
        }
    }
    if (news) {
        follow_reference();
        follow_doubts();
        follow_messages();
    }
    return news;
}

void ViewerModel::follow_list()
{
    FileListing& listing = *state_.listing;
    listing.fraction = list_job_->fraction();
    listing.step = list_job_->step();
    if (!list_job_->finished())
        return;
    const auto job = std::move(list_job_);
    try {
        listing.listed = std::make_shared<const ListedFile>(job->take());
    } catch (const std::exception& error) {
        listing.failure = error.what();
    }
}

/// Whether the running job was cancelled and has not come to its next checkpoint for as long as a person waits without wondering.
bool ViewerModel::waited_long_for_cancel() const
{
    constexpr auto patience = std::chrono::milliseconds(500); // half of the second that a cancel may take
    return cancelled_at_ && std::chrono::steady_clock::now() - *cancelled_at_ > patience;
}

/// Lets the running chain end by itself. @returns the stages that it has finished
ChainResult ViewerModel::leave_chain()
{
    ChainResult result;
    if (auto so_far = live_->so_far.fetch()) {
        result = std::move(*so_far);
    } else {
        const Document& document = opening_beside_ ? opening_beside_->document : state_.document;
        result.session = document.session;
        result.made_with = document.made_with;
    }
    result.cancelled = true;
    ending_.push_back(std::move(chain_job_));
    return result;
}

void ViewerModel::take_chain_result()
{
    const std::string title = state_.job.title;
    state_.job = JobView{};
    ChainResult result;
    try {
        result = chain_job_->finished() ? std::exchange(chain_job_, nullptr)->take() : leave_chain();
    } catch (const std::exception& error) { // no memory for a copy of the session
        opening_beside_.reset();
        say(Severity::error, error.what());
        return;
    }
    if (opening_beside_ && !take_opening(result))
        return;
    Document& document = state_.document;
    const bool had_blank = document.session.blank != nullptr;
    result.made_with.flatten.watch = nullptr;
    const Session before = document.session;
    const LaterResults quads = quads_shown(state_), surface = surface_shown(state_);
    for (const std::string& lost : take_over(document, result))
        say(Severity::warning, lost, about_results(state_));
    // What was picked during the run is taken back without it.
    state_.history.update_since(depth_at_start_, [&](Document& changed) { take_over(changed, result); });
    keep_before(result, quads, surface);
    forget_run_without_result(result, before);
    opening_ = false;
    if (document.session.part != before.part) {
        state_.refused.reset();
        state_.refused_file.reset();
        state_.fault.reset();
        part_opened();
    }
    if (project_)
        project_opened(result.search);
    if (document.session.blank && ((!had_blank && !keep_cameras_) || fitter_.is_fitted(state_, View::blank)))
        fitter_.fit(state_, View::blank);
    if (document.session.blank)
        keep_cameras_ = false;
    if (result.cancelled)
        say(Severity::hint, fmt::format("{}: cancelled. Finished results are kept.", title), about_refusal(state_));
    else if (result.failed)
        say_failed(result);
    else
        for (const std::string& text : shortcomings(document.session))
            say(Severity::warning, text, about_results(state_));
    const bool in_one_step = std::exchange(next_in_one_step_, false);
    if (const auto next = std::exchange(next_, std::nullopt); next && !result.cancelled && !result.failed) {
        if (in_one_step)
            document.session.options.steps.reset();
        run_to(*next, *next == Stage::solve ? "Unfolding" : "Updating all");
    }
    if (!chain_job_ && std::exchange(steps_next_, false) && !result.cancelled)
        run_missing_steps();
}

/// A run that was cancelled or failed before it had anything new is no change: nothing to take back or to save.
void ViewerModel::forget_run_without_result(const ChainResult& result, const Session& before)
{
    const auto unsaved_before = std::exchange(unsaved_before_, std::nullopt);
    const Session& now = result.session;
    if (!unsaved_before || !(result.cancelled || result.failed) || state_.history.depth() != depth_at_start_ ||
        now.part != before.part || now.blank != before.blank || now.grid != before.grid)
        return;
    state_.history.forget_last();
    state_.unsaved &= *unsaved_before;
    if (now.blank)
        state_.document.session.options.steps = state_.document.made_with.steps;
    else
        state_.document.session.options.steps.reset();
}

/// A run that has made another grid and went no further leaves the quad mesh and the surface of the last one to be looked at;
/// where one of them cannot be made of the grid, there is none.
void ViewerModel::keep_before(const ChainResult& result, const LaterResults& quads, const LaterResults& surface)
{
    const Session& session = state_.document.session;
    state_.before = {};
    if (result.failed == Stage::lift || result.failed == Stage::fit || session.surface || !session.grid)
        return;
    const LaterResults& last = surface.surface ? surface : quads;
    if (last.blank == session.blank)
        state_.before = last;
}

/// The lattice bends whatever surface there is; what control points were moved belongs to the surface they are of.
/// @param before  the surface that there was; null: none, the moves are those of a project
/// @returns in words what could not be kept
static std::vector<std::string> deform_again(Document& document, const std::shared_ptr<const SurfaceStage>& before)
{
    Session& session = document.session;
    auto& deformation = session.options.deformation;
    session.deformed = nullptr;
    std::vector<std::string> lost;
    if (before && before != session.surface) {
        document.controls.clear();
        if (deformation && !deformation->moves.empty()) {
            deformation = reset(deformation, HandleKind::control);
            lost.push_back("The moved control points were reset: the surface has new control points.");
        }
    }
    if (deformation && session.surface)
        try {
            session = deform_surface(std::move(session));
        } catch (const InputError& error) {
            deformation.reset();
            lost.push_back(fmt::format("The deformation of the surface was dropped: {}.", error.what()));
        }
    document.made_with.deformation = deformation;
    return lost;
}

/// Puts the results of a run into a document. On a part that was read otherwise the picks stay where they are in space.
/// @returns in words what was not found again
std::vector<std::string> ViewerModel::take_over(Document& document, const ChainResult& result) const
{
    const std::shared_ptr<const PartFile> before = document.session.part, after = result.session.part;
    const bool renumbered =
        before && after && before != after &&
        (before->mesh.triangle.cols() != after->mesh.triangle.cols() || before->mesh.triangle != after->mesh.triangle);
    std::optional<StoredPicks> picks;
    if (renumbered)
        picks = store_picks(document);
    const std::shared_ptr<const SurfaceStage> surface_before = document.session.surface;
    SessionOptions wanted = std::move(document.session.options); // may have changed meanwhile
    document.session = result.session;
    document.session.options = std::move(wanted);
    document.made_with = result.made_with;
    std::vector<std::string> lost = deform_again(document, surface_before);
    if (document.session.blank && document.session.options.limits != document.made_with.limits) { // changed meanwhile
        document.made_with.limits = document.session.options.limits;
        document.session.limits = judge_limits(as_made(document)).limits;
    }
    if (before && before != after)
        document.section.reset();
    if (!picks) {
        if (before && after && before != after)
            measure_again(document);
        return lost;
    }
    document.selected.clear();
    document.vertices.clear();
    document.probes.clear();
    document.measurements.clear();
    document.regions.clear();
    document.lines.clear();
    document.steps.clear();
    for (std::string& text : restore(document, *picks, result.search))
        lost.push_back(std::move(text));
    return lost;
}

/// Picks and, made of them, the process. @returns in words what was not found again, or why nothing was
std::vector<std::string> ViewerModel::restore(Document& document, const StoredPicks& picks,
                                              const std::shared_ptr<const ClosestPointSearch>& search) const
{
    std::vector<std::string> lost;
    try {
        lost = restore_picks(document, picks, search);
        document.session.options.flatten.process = process_of(document, assets() / "materials");
    } catch (const InputError& error) {
        lost.push_back(error.what());
    }
    return lost;
}

static std::string worst_fault(const PartFile& refused)
{
    const auto& findings = refused.doctor.findings;
    return std::find_if(findings.begin(), findings.end(),
                        [](const Finding& f) { return f.severity == spia::Severity::fatal; })
        ->text;
}

/// The new part is not there: the one before stays, with all that was made of it.
void ViewerModel::say_not_opened(const Opening& opening, const ChainResult& result)
{
    const std::string name = opening.document.session.file.filename().string(),
                      open = state_.document.session.file.filename().string();
    if (result.cancelled) {
        say(Severity::hint, fmt::format("Opening {}: cancelled. {} is still open.", name, open), about_refusal(state_));
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
    say(Severity::error, fmt::format("{} {} is still open.", sentence(why), open));
}

/// What was read while another part was open takes its place, if it is there. @returns whether it is
bool ViewerModel::take_opening(const ChainResult& result)
{
    Opening opening = std::move(*std::exchange(opening_beside_, std::nullopt));
    if (result.session.part) {
        replace_document(std::move(opening));
        depth_at_start_ = state_.history.depth();
        return true;
    }
    opening_ = false;
    next_.reset(); // was for the new part
    next_in_one_step_ = false;
    say_not_opened(opening, result);
    return false;
}

void ViewerModel::replace_document(Opening opening)
{
    if (!opening.project) { // a field stays chosen from part to part
        opening.document.display = state_.document.display;
        opening.document.display.range.reset();
    }
    state_.document = std::move(opening.document);
    project_ = std::move(opening.project);
    state_.project = std::move(opening.project_file);
    state_.unsaved = opening.unsaved;
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
    keep_cameras_ = false;
    ++documents_;
}

void ViewerModel::say_failed(const ChainResult& result)
{
    const bool reading = *result.failed == Stage::read;
    if (reading) {
        state_.refused = result.refused;
        state_.refused_file.reset();
    }
    if (!state_.refused || !reading) {
        say(Severity::error,
            fmt::format("{} {}", sentence(result.message),
                        reading                         ? "Choose another file."
                        : *result.failed == Stage::grid ? grid_advice(result.session)
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

void ViewerModel::take_export_result()
{
    const auto job = std::move(export_job_);
    state_.job = JobView{};
    try {
        const auto files = job->take();
        state_.exported = ExportOutcome{files, {}};
        std::string names;
        for (const auto& file : files)
            names += (names.empty() ? "" : ", ") + file.filename().string();
        say(Severity::done, fmt::format("Wrote {} to {}", names, files.empty() ? "" : files[0].parent_path().string()));
    } catch (const std::exception& error) {
        state_.exported = ExportOutcome{{}, error.what()};
        say(Severity::error, error.what());
    }
}

void ViewerModel::part_opened()
{
    Document& document = state_.document;
    if (!document.session.part)
        return;
    state_.view.camera[size_t(View::part)] = look(state_.view.camera[size_t(View::part)], StandardView::isometric);
    state_.view.clip.on = false; // of another part
    fitter_.fit(state_);
    const PartFile& part = *document.session.part;
    double& thickness = document.session.options.flatten.thickness;
    if (const auto found = part.thickness_mm; found && !project_) {
        thickness = *found;
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
    for (const std::string& lost : restore(document, project.picks, search)) // the rest of the project is sound
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

void ViewerModel::hover(View view, glm::dvec2 pixel, glm::dvec2 size, double reach)
{
    hover_nothing();
    if (view == View::part && shows_refused(state_))
        return;
    pickers_.follow_steps(state_);
    const RayPicker* picker = pickers_.ready_picker(state_.document.session, view);
    if (!picker)
        return;
    const Camera& camera = state_.view.camera[size_t(view)];
    if (const Tool tool = state_.view.tool; tool == Tool::vertex || tool == Tool::outline)
        state_.hovered_vertex = pickers_.vertex_at(
            state_.document.session,
            {.view = view, .pixel = pixel, .size = size, .boundary = tool == Tool::outline, .reach = reach}, camera,
            kept_in(state_.view, view));
    const RayHit hit = hit_at(camera, *picker, pixel, size, kept_in(state_.view, view));
    if (hit.face < 0)
        return;
    state_.hovered = hit.face;
    under_mouse_ = Probe{hit.face, hit.barycentric};
}

void ViewerModel::hover_nothing()
{
    state_.hovered.reset();
    state_.hovered_vertex.reset();
    under_mouse_.reset();
}

} // namespace spia::viewer
