#include "app/viewer/model/jobs/viewer_model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <mutex>
#include <utility>

#include "app/viewer/model/document/grades.h"
#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/options/option.h"
#include "engine/report/text/lengths.h"
#include "engine/report/text/sentence.h"

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
    if (severity == Severity::error && message.subject.kind == Subject::Kind::none)
        message.subject = about_refusal(state_); // what could not be done is of the past once
                                                 // something else is
    say(std::move(message));
}

void ViewerModel::say(Message message)
{
    message.text = sentence(window_text(message.text));
    message.number = ++messages_posted_;
    constexpr size_t most = 50;
    // said again, it is the newest once more
    std::erase_if(state_.messages, [&](const Message& before) {
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
            // not to come back with undo
            message.gone && message.subject.kind == Subject::Kind::refusal;
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

void ViewerModel::start_chain(Stage from, Stage to, std::string title, const Document& document)
{
    live_ = std::make_shared<Live>();
    cancelled_at_.reset();
    progress_from_ = 0;
    progress_to_ = 1;
    Session session = document.session;
    if (session.options.steps) { // the tools are not in them
        const bool skins = session.options.flatten.skins;
        session.options.flatten = sheet_of_steps(session.options.flatten);
        session.options.flatten.skins = skins;
    }
    if (dragging_) {
        constexpr int few = 14;
        session.options.grid.columns = session.options.grid.rows = 0;
        session.options.grid.cells = std::min(session.options.grid.cells, few);
    }
    const size_t depth = state_.history.depth();
    running_ = {session.options, to, dragging_, depth, depth};
    state_.job = JobView{};
    state_.job.running = true;
    state_.job.title = std::move(title);
    ChainWishes wishes;
    // has the thickness that its user chose
    if (opening_beside_ ? opening_beside_->project : project_)
        wishes.thickness = session.options.flatten.thickness;
    chain_job_ = std::make_unique<Job<ChainResult>>(
        [session = std::move(session), made_with = document.made_with, from, to, wishes = std::move(wishes),
         live = live_](const Progress& progress) {
            return run_and_note(
                session, made_with, from, to, progress, wishes,
                [&](ChainResult result) { live->so_far.post(std::move(result)); },
                [&](const Eigen::Matrix2Xd& X, const NewtonStep& step) { live->see(X, step); });
        },
        wake_);
}

/// Whether what the running job of the chain makes is out of date before it is there.
bool ViewerModel::is_superseded() const
{
    if (opening_ || opening_beside_)
        return false;
    if (running_.coarse) // a coarse grid is of use as long as its corner is dragged
        return !dragging_;
    return running_.to > Stage::solve && !makes_same_surface(running_.options, state_.document.session.options);
}

void ViewerModel::run_to(Stage to, const std::string& title)
{
    if (state_.document.session.file.empty()) {
        say(Severity::hint, "Open a part first.");
        return;
    }
    if (export_job_) {
        say(Severity::hint, "Wait for the export to end.", about_job());
        return;
    }
    if (steps_job_) {
        say(Severity::hint, "Wait for the steps to end, or cancel them.", about_job());
        return;
    }
    if (chain_job_) { // the newest wish counts, from what is there then
        next_ = std::max(next_.value_or(to), to);
        if (is_superseded()) {
            const size_t changes = state_.history.depth() - std::exchange(running_.depth_noted, state_.history.depth());
            on_cancel_.undo &= changes <= 1; // else something else was done meanwhile
            on_cancel_.changes += changes;
            running_.superseded = true;
            chain_job_->cancel();
            cancelled_at_ = cancelled_at_.value_or(std::chrono::steady_clock::now());
        }
        return;
    }
    const std::optional<Stage> from = first_stale(state_.document);
    std::optional<BlankOfSteps>& steps = state_.document.session.options.steps;
    if (steps && from && *from <= Stage::solve && to >= Stage::solve &&
        // what is read may be another part
        (*from == Stage::read || !holds(state_.document, *steps))) {
        steps.reset();
        say(Severity::hint,
            "The steps, the part or its sheet have changed since the blank of the steps was computed; the part is unfolded in one step again.");
    }
    if (!from || *from > to)
        return;
    // Blank and strains can be looked at while grid and surface are still being made.
    const Stage first = *from <= Stage::solve && to > Stage::solve ? Stage::solve : to;
    start_chain(*from, first, title, state_.document);
    progress_to_ = share_of_time(*from, first) / share_of_time(*from, to);
    if (first < to)
        next_ = to;
}

bool ViewerModel::poll()
{
    bool news = false;
    JobView& view = state_.job;
    std::erase_if(ending_, [](const auto& job) { return job->finished(); });
    std::erase_if(ending_steps_, [](const auto& job) { return job->finished(); });
    std::erase_if(ending_exports_, [](const auto& job) { return job->finished(); });
    std::erase_if(ending_lists_, [](const auto& job) { return job->finished(); });
    pickers_.follow(state_.document.session);
    pickers_.follow_steps(state_);
    if (chain_job_) {
        // A fit whose next round has more to do than the last one goes back; its bar stands.
        view.fraction = std::max(view.fraction, std::lerp(progress_from_, progress_to_, chain_job_->fraction()));
        view.step = chain_job_->step();
        view.cancelling = chain_job_->cancelling() && !running_.superseded;
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
        if (steps_job_->finished() || waited_long_for_cancel()) {
            take_steps_result();
            news = true;
        }
    }
    if (export_job_) {
        view.fraction = export_job_->fraction();
        view.step = export_job_->step();
        view.cancelling = export_job_->cancelling();
        if (export_job_->finished() || waited_long_for_cancel()) {
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

/// Whether the running job was cancelled and has not come to its next checkpoint for as long as a
/// person waits without wondering.
bool ViewerModel::waited_long_for_cancel() const
{
    // half of the second that a cancel may take
    constexpr auto waiting_limit = std::chrono::milliseconds(500);
    return cancelled_at_ && std::chrono::steady_clock::now() - *cancelled_at_ > waiting_limit;
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

void ViewerModel::take_export_result()
{
    auto job = std::move(export_job_);
    state_.job = JobView{};
    const auto cancelled = [&] {
        state_.exported = ExportOutcome{exported_so_far_->fetch().value_or(Files{}), {}, true};
        const size_t written = state_.exported->files.size();
        say(Severity::hint, written == 0
                                ? "Exporting: cancelled. Nothing was written."
                                : fmt::format("Exporting: cancelled. {} written before and {} kept.",
                                              written == 1 ? "1 file was" : fmt::format("{} files were", written),
                                              written == 1 ? "is" : "are"));
    };
    if (!job->finished()) { // what it has not written by now it never will
        ending_exports_.push_back(std::move(job));
        cancelled();
        return;
    }
    try {
        const auto files = job->take();
        state_.exported = ExportOutcome{files, {}};
        std::string names;
        for (const auto& file : files)
            names += (names.empty() ? "" : ", ") + file.filename().string();
        say(Severity::done, fmt::format("Wrote {} to {}", names, files.empty() ? "" : files[0].parent_path().string()));
    } catch (const Cancelled&) {
        cancelled();
    } catch (const std::exception& error) {
        state_.exported = ExportOutcome{exported_so_far_->fetch().value_or(Files{}), error.what()};
        say(Severity::error, error.what());
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
