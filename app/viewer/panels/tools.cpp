#include <GLFW/glfw3.h>
#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <imgui_internal.h> // ClearActiveID

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/tool_table.h"
#include "app/viewer/panels/view_tools.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {

/// The keys that turn and zoom a view, held down or not; a step of the mouse in pixels. @returns
/// whether there was any
static bool camera_keys(Frame& frame, View view)
{
    const auto held = [&](int key) {
        return pressed(frame, key) || (ImGui::GetIO().KeysDownDuration[key] > 0 && ImGui::IsKeyPressed(key, true));
    };
    constexpr double step = 24; // pixels at content scale 1: some 5 degrees in a view of usual size
    glm::dvec2 drag(0);
    drag.x = (held(GLFW_KEY_RIGHT) ? step : 0) - (held(GLFW_KEY_LEFT) ? step : 0);
    drag.y = (held(GLFW_KEY_DOWN) ? step : 0) - (held(GLFW_KEY_UP) ? step : 0);
    const int zooms = (held(GLFW_KEY_PAGE_UP) ? 1 : 0) - (held(GLFW_KEY_PAGE_DOWN) ? 1 : 0);
    if (drag == glm::dvec2(0) && zooms == 0)
        return false;
    const glm::dvec2 size = glm::max(glm::dvec2(1), dvec(frame.ui.view_size[size_t(view)]));
    const Camera& now = frame.state.view.camera[size_t(view)];
    const glm::dvec2 by = drag * double(frame.ui.scale);
    const bool pans = view == View::blank || ImGui::GetIO().KeyShift;
    Camera camera = pans ? pan(now, by, size) : orbit(now, by, size);
    if (zooms != 0)
        camera = zoom(camera, std::pow(1.15, zooms), size / 2., size);
    ViewSettings settings = frame.state.view;
    take_camera(settings, view, camera);
    frame.actions.push(SetViewSettings{settings});
    return true;
}

/// The chosen corner goes along the outline of the blank; Return chooses the next one. @returns
/// whether a key did it
static bool corner_keys(Frame& frame)
{
    const Session& session = frame.state.document.session;
    if (frame.state.view.tool != Tool::corners || *frame.ui.focus != View::blank || !session.grid || !session.blank)
        return false;
    int& chosen = frame.ui.keyed_corner;
    if (enter_pressed(frame)) {
        chosen = (chosen + 1) % 4;
        return true;
    }
    const int way = (pressed(frame, GLFW_KEY_RIGHT) || pressed(frame, GLFW_KEY_UP) ? 1 : 0) -
                    // counter-clockwise
                    (pressed(frame, GLFW_KEY_LEFT) || pressed(frame, GLFW_KEY_DOWN) ? 1 : 0);
    if (way == 0)
        return false;
    const CornerTrack& track = frame.pickers.track(session);
    const bool to_turn = pressed(frame, GLFW_KEY_UP) || pressed(frame, GLFW_KEY_DOWN);
    const std::vector<int>& outline = to_turn && !track.sharp.empty() ? track.sharp : track.vertex;
    const auto wanted = frame.pickers.corners(session);
    if (!wanted)
        return false;
    const std::array<int, 4>& corner = *wanted;
    const int count = int(track.vertex.size());
    const auto at = std::find(track.vertex.begin(), track.vertex.end(), corner[size_t(chosen)]);
    if (at == track.vertex.end())
        return false;
    int to = int(at - track.vertex.begin());
    do
        to = (to + way + count) % count;
    while (std::find(outline.begin(), outline.end(), track.vertex[size_t(to)]) == outline.end());
    if (std::find(corner.begin(), corner.end(), track.vertex[size_t(to)]) == corner.end())
        frame.actions.push(SetCorner{chosen, track.vertex[size_t(to)], false});
    return true;
}

/// The view after the one that has the keyboard; after the last one it is the panels' again.
static std::optional<View> next_view(const Frame& frame, bool back)
{
    if (const auto only = frame.state.view.maximised)
        return frame.ui.focus ? std::nullopt : only;
    constexpr int count = int(std::size(all_views)), none = count;
    const int now = frame.ui.focus ? int(*frame.ui.focus) : none;
    const int next = (now + (back ? count : 1)) % (count + 1);
    return next == none ? std::nullopt : std::optional(View(next));
}

/// What single keys do in the view that has the keyboard.
static void view_keys(Frame& frame)
{
    const View focus = *frame.ui.focus;
    if (corner_keys(frame) || camera_keys(frame, focus))
        return;
    if (enter_pressed(frame) && tool_clicks(frame.state.view.tool)) { // at the cross in the middle
        const glm::dvec2 size = dvec(frame.ui.view_size[size_t(focus)]);
        click_with_tool(frame, focus, size / 2., size);
    }
    const bool dragging = ImGui::IsMouseDown(0) || ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2);
    for (const ToolButton& tool : tools)
        if (pressed(frame, tool.key()) && !dragging) {
            ViewSettings chosen = frame.state.view;
            chosen.tool = tool.tool;
            frame.actions.push(SetViewSettings{chosen});
        }
    ViewSettings view = frame.state.view;
    if (pressed(frame, GLFW_KEY_T)) {
        view.dark = !view.dark;
        frame.actions.push(SetViewSettings{view});
    }
    if (pressed(frame, GLFW_KEY_E)) {
        view.edges = !view.edges;
        frame.actions.push(SetViewSettings{view});
    }
    if (pressed(frame, GLFW_KEY_H) && frame.state.document.session.part)
        toggle_clip(frame);
    if (pressed(frame, GLFW_KEY_5)) {
        for (const View v : all_views)
            if (v != View::blank)
                view.camera[size_t(v)].perspective = !frame.state.view.camera[0].perspective;
        frame.actions.push(SetViewSettings{view});
    }
    constexpr std::pair<int, StandardView> looks[] = {{GLFW_KEY_1, StandardView::top},
                                                      {GLFW_KEY_2, StandardView::front},
                                                      {GLFW_KEY_3, StandardView::right},
                                                      {GLFW_KEY_4, StandardView::isometric}};
    for (const auto& [key, from] : looks)
        if (pressed(frame, key))
            frame.actions.push(LookFrom{focus == View::blank ? View::part : focus, from});
    if (pressed(frame, GLFW_KEY_F))
        frame.actions.push(FitView{});
    if (pressed(frame, GLFW_KEY_I) && frame.state.document.session.part)
        frame.actions.push(InvertSelection{});
    if (pressed(frame, GLFW_KEY_EQUAL) || pressed(frame, GLFW_KEY_KP_ADD))
        frame.actions.push(GrowSelection{});
    if (pressed(frame, GLFW_KEY_MINUS) || pressed(frame, GLFW_KEY_KP_SUBTRACT))
        frame.actions.push(ShrinkSelection{});
}

void shortcuts(Frame& frame)
{
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId) || !frame.ui.dialogs.empty())
        return;
    if (io.WantTextInput) { // what is typed is taken first, then the key counts; undo is that of
                            // the text
        bool any = false;
        for (const KeyPress& press : frame.ui.keys)
            if ((press.key >= GLFW_KEY_F1 && press.key <= GLFW_KEY_F12) ||
                (press.modifiers == GLFW_MOD_CONTROL &&
                 (press.key == GLFW_KEY_S || press.key == GLFW_KEY_E || press.key == GLFW_KEY_O ||
                  press.key == GLFW_KEY_Q || press.key == GLFW_KEY_COMMA))) {
                frame.ui.keys_later.insert(frame.ui.keys_later.begin(), press);
                any = true;
            }
        if (any)
            ImGui::ClearActiveID();
        return;
    }
    if (!ImGui::GetCurrentContext()->NavWindow) // a click into nothing took it: arrows and Alt
                                                // would do nothing
        ImGui::SetWindowFocus("workbench");
    const auto pressed = [&](int key) { return viewer::pressed(frame, key); };
    const auto with = [&](int modifier) { // as it was when the key went down, which may be up again
        return std::any_of(frame.ui.keys.begin(), frame.ui.keys.end(),
                           [&](const KeyPress& press) { return (press.modifiers & modifier) != 0; });
    };
    if (with(GLFW_MOD_ALT) || with(GLFW_MOD_SUPER))
        return; // those of the desktop
    const Session& session = frame.state.document.session;
    if (with(GLFW_MOD_CONTROL)) {
        if (pressed(GLFW_KEY_Z))
            frame.actions.push(with(GLFW_MOD_SHIFT) ? Action{Redo{}} : Action{Undo{}});
        if (pressed(GLFW_KEY_Y))
            frame.actions.push(Redo{});
        if (pressed(GLFW_KEY_O))
            choose_part(frame);
        if (pressed(GLFW_KEY_S) && session.part) {
            if (frame.state.project.empty())
                choose_project_name(frame);
            else
                frame.actions.push(SaveProject{});
        }
        if (pressed(GLFW_KEY_E)) {
            if (session.blank)
                frame.ui.show_export = true;
            else
                frame.events.say(Severity::hint, frame.state.job.running
                                                     ? "There is nothing to export yet: the blank is being computed."
                                                     : "There is nothing to export yet: unfold the part first  (F6).");
        }
        if (pressed(GLFW_KEY_Q))
            frame.actions.push(Quit{});
        if (pressed(GLFW_KEY_COMMA))
            frame.ui.show_preferences = true;
        return;
    }
    if (frame.ui.focus)
        view_keys(frame);
    else if (std::any_of(frame.ui.keys.begin(), frame.ui.keys.end(), [](const KeyPress& press) {
                 return press.modifiers == 0 && press.key >= GLFW_KEY_A && press.key <= GLFW_KEY_Z;
             }))
        frame.events.say(Severity::hint,
                         "Letters choose tools when a view has the keyboard: click into one, or press F4.");
    if (pressed(GLFW_KEY_LEFT_ALT) || pressed(GLFW_KEY_RIGHT_ALT))
        frame.ui.focus.reset(); // the menus have it
    if (pressed(GLFW_KEY_F4)) {
        frame.ui.focus = next_view(frame, with(GLFW_MOD_SHIFT));
        frame.ui.by_keys = true;
    }
    if (pressed(GLFW_KEY_ESCAPE)) {
        if (frame.ui.show_shortcuts || frame.ui.show_messages || frame.ui.manual.shown)
            frame.ui.show_shortcuts = frame.ui.show_messages = frame.ui.manual.shown = false;
        else if (!frame.ui.line.empty())
            frame.ui.line.clear();
        else if (!frame.ui.measuring.empty())
            frame.ui.measuring.clear();
        else if (frame.state.job.running)
            frame.actions.push(CancelJob{});
        else if (frame.ui.animation)
            frame.ui.animation->cancelling = true;
        else if (frame.state.spot)
            frame.actions.push(HideSpot{});
        else if (frame.state.fault)
            frame.actions.push(HideFault{});
        else
            frame.actions.push(ClearSelection{});
    }
    if ((pressed(GLFW_KEY_ENTER) || pressed(GLFW_KEY_KP_ENTER)) && !frame.ui.line.empty())
        end_line(frame);
    if (pressed(GLFW_KEY_F1))
        frame.ui.show_shortcuts = !frame.ui.show_shortcuts;
    const bool narrow = is_narrow(io.DisplaySize.x, frame.ui.scale);
    if (pressed(GLFW_KEY_F2))
        frame.ui.panels.toggle(SidePanels::steps, narrow);
    if (pressed(GLFW_KEY_F3))
        frame.ui.panels.toggle(SidePanels::inspect, narrow);
    if (pressed(GLFW_KEY_F5))
        frame.actions.push(RunTo{Stage::fit});
    if (pressed(GLFW_KEY_F6))
        frame.actions.push(RunTo{Stage::solve});
}

} // namespace spia::viewer
