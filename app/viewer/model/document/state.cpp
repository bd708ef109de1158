#include "app/viewer/model/document/state.h"

#include <algorithm>

#include "app/viewer/model/actions/names.h"
#include "app/viewer/model/document/chain.h"

namespace spia::viewer {

std::string_view name(View view) { return name_in_table(view); }

const char* title(View view)
{
    switch (view) {
    case View::part: return "Part";
    case View::blank: return "Blank";
    case View::quads: return "Quad mesh";
    case View::surface: return "NURBS surface";
    }
    return "";
}

std::string_view name(Tool tool) { return name_in_table(tool); }

const PartFile* examined(const ViewerState& state)
{
    const bool of_other = state.refused_file && !state.refused_file->shown;
    return state.refused && !of_other ? state.refused.get() : state.document.session.part.get();
}

bool shows_refused(const ViewerState& state)
{
    return state.refused && state.refused_file && state.refused_file->shown;
}

ViewSettings kept_view(const ViewerState& state)
{
    ViewSettings view = state.view;
    if (shows_refused(state))
        view.camera = state.refused_file->camera;
    return view;
}

static LaterResults shown(const ViewerState& state, bool there)
{
    const Session& session = state.document.session;
    if (there)
        return {session.blank, session.grid, session.lifted, session.surface};
    return session.blank && state.before.blank == session.blank ? state.before : LaterResults{};
}

bool has_scale(SurfaceLook look)
{
    return look != SurfaceLook::plain && look != SurfaceLook::patches && look != SurfaceLook::zebra;
}

LaterResults quads_shown(const ViewerState& state)
{
    const Session& session = state.document.session;
    return shown(state, session.lifted || (session.surface && session.surface->patches));
}

LaterResults surface_shown(const ViewerState& state) { return shown(state, state.document.session.surface != nullptr); }

bool is_old(const ViewerState& state, View view)
{
    const auto stale = first_stale(state.document);
    if (!stale)
        return false;
    switch (view) {
    case View::part:
        if (step_shown(state) || step_position(state) > 0) // which has an age of its own
            return false;
        [[fallthrough]];
    case View::blank: return state.document.session.blank && *stale <= Stage::solve;
    case View::quads: {
        const LaterResults made = quads_shown(state);
        const bool of_patches = made.surface && made.surface->patches;
        return (made.lifted || of_patches) && *stale <= (of_patches ? Stage::fit : Stage::lift);
    }
    case View::surface: return surface_shown(state).surface != nullptr;
    }
    return false;
}

double step_position(const ViewerState& state)
{
    return std::clamp(state.view.unfolded, 0., double(steps_done(state.document)));
}

const PlannedStep* step_shown(const ViewerState& state)
{
    const StepList& steps = state.document.steps;
    const auto chosen = state.view.step;
    return chosen && *chosen >= 0 && size_t(*chosen) < steps.size() ? steps[size_t(*chosen)].get() : nullptr;
}

std::string window_title(const ViewerState& state)
{
    const Session& session = state.document.session;
    if (state.project.empty() && !session.part) // a file that is being read may be refused
        return "SPIA";
    const std::filesystem::path& about = state.project.empty() ? session.file : state.project;
    return about.stem().string() + (state.document.unsaved ? "*" : "") + " - SPIA";
}

} // namespace spia::viewer
