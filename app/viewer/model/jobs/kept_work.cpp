#include "app/viewer/model/jobs/kept_work.h"

#include <algorithm>
#include <fmt/chrono.h>
#include <utility>

#include "engine/core/error.h"

namespace spia::viewer {
namespace {

std::string describe(std::filesystem::file_time_type time)
{
    const auto saved = std::chrono::file_clock::to_sys(time);
    const auto age = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now() - saved);
    const std::time_t seconds =
        std::chrono::system_clock::to_time_t(std::chrono::time_point_cast<std::chrono::system_clock::duration>(saved));
    return fmt::format("{:%d %b %Y, %H:%M} ({})", fmt::localtime(seconds), ago(age));
}

std::string name_of(const UnfinishedSession& work)
{
    const std::string name = work.name();
    return name.empty() ? "your work on a part" : name;
}

void discard_of(std::optional<UnfinishedSession>& work)
{
    if (work)
        work->discard();
    work.reset();
}

/// Waits for what is being written, if anything is. @returns whether it is there
bool finish(Eventually<bool>& writing)
{
    const Eventually<bool> last = std::exchange(writing, {});
    try {
        return last.wanted() && last.get();
    } catch (const std::exception&) { // whoever needs it writes it again
        return false;
    }
}

} // namespace

bool KeptWork::look_for_left()
{
    offer_.reset();
    offered_ = unfinished_session();
    if (offered_)
        offer_ = {fmt::format("The program ended without saving {}.", name_of(*offered_)), describe(offered_->time())};
    return offer_.has_value();
}

OpenProject KeptWork::recover()
{
    offer_.reset();
    recovering_ = std::exchange(offered_, std::nullopt);
    return {recovering_->file()};
}

void KeptWork::discard()
{
    discard_of(offered_);
    look_for_left();
}

void KeptWork::later()
{
    offer_.reset();
    offered_.reset();
}

Eventually<bool> KeptWork::write(const Document& document, const ViewSettings& view,
                                 const std::filesystem::path& project)
{
    return worker_.later([autosave = autosave_, document, view, project] {
        autosave->save(document, view, project);
        return true;
    });
}

void KeptWork::open(ViewerModel& model, const Action& action)
{
    const ViewerState& state = model.state();
    const bool had_part = state.document.session.part != nullptr, leaves_work = state.document.unsaved && had_part;
    const Document document = state.document;
    const ViewSettings view = kept_view(state);
    const std::filesystem::path project = state.project;
    const int openings = model.openings(), documents = model.documents();
    model.apply(action);
    if (model.openings() == openings) // it did not even begin
        return;
    if (leaves_work)
        writing_ = write(document, view, project);
    coming_ = Coming{documents, had_part, {}};
    const auto* opened = action.as<OpenProject>();
    if (opened && recovering_ && opened->file == recovering_->file())
        coming_->recovers = std::move(recovering_);
    recovering_.reset();
}

void KeptWork::follow(ViewerModel& model, bool now_and_then, Clock::time_point now)
{
    const ViewerState& state = model.state();
    // it has taken the place of what was open
    if (coming_ && model.documents() != coming_->documents) {
        if (coming_->takes_place) {
            finish(writing_);
            autosave_->clear();
            discard_of(recovered_);
        }
        recovered_ = std::move(coming_->recovers);
        coming_.reset();
    } else if (coming_ && !model.opening_beside()) // it could not be opened: what was open still is
        coming_.reset();
    if (writing_.ready()) {
        try {
            std::exchange(writing_, {}).get();
            discard_of(recovered_); // it lives on in the new one
        } catch (const std::exception& error) {
            model.say(Severity::warning, fmt::format("Autosave failed: {}", error.what()));
        }
    }
    if (std::exchange(seen_, state.history.now()) != state.history.now())
        changed_ = now;
    if (!now_and_then || !state.document.unsaved || !state.document.session.part || model.busy() || writing_.wanted() ||
        due_in(now) > 0)
        return;
    last_ = now;
    kept_ = seen_;
    writing_ = write(state.document, kept_view(state), state.project);
}

double KeptWork::due_in(Clock::time_point now) const
{
    const Clock::time_point due = kept_ == seen_ ? last_ + interval_ : std::min(last_ + interval_, changed_ + rest_);
    return std::max(0., std::chrono::duration<double>(due - now).count());
}

void KeptWork::keep(const ViewerState& state)
{
    finish(writing_);
    autosave_->save(state.document, kept_view(state), state.project);
    discard_of(recovered_);
}

void KeptWork::forget()
{
    finish(writing_);
    autosave_->clear();
    discard_of(recovered_);
}

void KeptWork::end()
{
    finish(writing_);
    autosave_->clear();
}

} // namespace spia::viewer
