#include "app/viewer/model/document/message.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/document/state.h"
#include "engine/options/option.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {
namespace {

using Objects = std::vector<std::weak_ptr<const void>>;

bool same(const std::weak_ptr<const void>& a, const std::weak_ptr<const void>& b)
{
    return !a.owner_before(b) && !b.owner_before(a);
}

bool same(const Objects& a, const Objects& b)
{
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) { return same(x, y); });
}

Objects results_of(const Session& session) { return {session.part, session.blank, session.grid, session.surface}; }

} // namespace

Subject about_part(const ViewerState& state) { return {Subject::Kind::results, {state.document.session.part}}; }
Subject about_results(const ViewerState& state) { return {Subject::Kind::results, results_of(state.document.session)}; }
Subject about_steps(const ViewerState& state) { return {Subject::Kind::steps, {state.document.unfolding}}; }
Subject about_refused_part(const ViewerState& state) { return {Subject::Kind::refused, {state.refused}}; }
Subject about_change(const ViewerState& state) { return {Subject::Kind::change, {}, state.history.now()}; }
Subject about_refusal(const ViewerState& state) { return {Subject::Kind::refusal, {}, state.history.now()}; }

Subject about_job() { return {Subject::Kind::busy}; }

bool holds(const Subject& subject, const ViewerState& state)
{
    switch (subject.kind) {
    case Subject::Kind::none: return true;
    case Subject::Kind::results: {
        Objects now = results_of(state.document.session);
        now.resize(std::min(now.size(), subject.object.size())); // those it is about
        return same(subject.object, now);
    }
    case Subject::Kind::steps: return same(subject.object, {state.document.unfolding});
    case Subject::Kind::refused: return same(subject.object, {state.refused});
    case Subject::Kind::change: return state.history.has(subject.change);
    case Subject::Kind::refusal: return state.history.now() == subject.change;
    case Subject::Kind::busy: return state.job.running;
    }
    return true;
}

bool same(const Subject& a, const Subject& b)
{
    return a.kind == b.kind && a.change == b.change && same(a.object, b.object);
}

void dismiss_failed_run(std::vector<Message>& messages)
{
    for (Message& message : messages)
        message.dismissed |= message.severity == Severity::error && message.subject.kind == Subject::Kind::change;
}

void dismiss_before_run(std::vector<Message>& messages)
{
    dismiss_failed_run(messages);
    for (Message& message : messages) {
        const Subject::Kind about = message.subject.kind;
        const bool of_results = about == Subject::Kind::results || about == Subject::Kind::steps;
        message.dismissed |= !of_results && message.severity != Severity::error;
    }
}

std::vector<std::string> notes_on_reading(const PartFile& part)
{
    std::vector<std::string> notes;
    for (const std::string& note : part.notes)
        if (std::find(part.doubts.begin(), part.doubts.end(), note) == part.doubts.end())
            notes.push_back(sentence(window_text(note)));
    return notes;
}

} // namespace spia::viewer
