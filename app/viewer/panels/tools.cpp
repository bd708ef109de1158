#include <GLFW/glfw3.h>
#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

struct ToolButton {
    Tool tool;
    const char *label, *help;
    int key;
};
constexpr ToolButton tools[] = {
    {Tool::look, "Look", "Turn with the left mouse button, pan with the middle one, zoom with the wheel  (V)",
     GLFW_KEY_V},
    {Tool::pick, "Face", "Pick single faces; Shift adds, Ctrl takes away. The right button turns  (P)", GLFW_KEY_P},
    {Tool::box, "Box", "Pick all faces in a box  (B)", GLFW_KEY_B},
    {Tool::lasso, "Lasso", "Pick all faces inside a drawn line  (L)", GLFW_KEY_L},
    {Tool::brush, "Brush", "Paint faces  (U)", GLFW_KEY_U},
    {Tool::flood, "Flood", "Pick all around a face up to an angle between neighbours  (R)", GLFW_KEY_R},
    {Tool::smooth_region, "Smooth", "Pick the smooth piece of sheet around a face  (N)", GLFW_KEY_N},
    {Tool::vertex, "Vertex", "Pick vertices; two show their distance. Shift adds, Ctrl takes away  (D)", GLFW_KEY_D},
    {Tool::outline, "Outline",
     "Pick vertices of the outline and the holes; sharp turns attract the mouse. Four of the outline can become the corners "
     "of the grid  (G)",
     GLFW_KEY_G},
    {Tool::probe, "Probe", "Pin the value at a place  (O)", GLFW_KEY_O},
    {Tool::section, "Section", "Draw a line: the field is plotted along the cut  (X)", GLFW_KEY_X},
    {Tool::corners, "Corners", "Drag the four corners along the outline of the blank  (C)", GLFW_KEY_C},
};

void set_tool(Frame& frame, Tool tool)
{
    ViewSettings settings = frame.state.view;
    settings.tool = tool;
    frame.actions.push(SetViewSettings{settings});
}

} // namespace

void tool_bar(Frame& frame)
{
    const Palette p = palette_of(frame.state.view.dark);
    for (const ToolButton& button : tools) {
        if (button.tool != Tool::look)
            ImGui::SameLine(0, 3 * frame.ui.scale);
        if (button.tool == Tool::pick || button.tool == Tool::vertex || button.tool == Tool::probe) {
            ImGui::SameLine(0, 14 * frame.ui.scale);
        }
        const bool active = frame.state.view.tool == button.tool;
        if (active) {
            ImGui::PushStyleColor(ImGuiCol_Button, p.accent);
            ImGui::PushStyleColor(ImGuiCol_ButtonHovered, p.accent);
            ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1, 1, 1, 1));
        }
        if (ImGui::Button(button.label))
            set_tool(frame, button.tool);
        if (active)
            ImGui::PopStyleColor(3);
        tooltip(button.help);
    }
    ViewSettings settings = frame.state.view;
    bool changed = false;
    ImGui::SameLine(0, 14 * frame.ui.scale);
    ImGui::SetNextItemWidth(120 * frame.ui.scale);
    if (settings.tool == Tool::flood) {
        float angle = float(settings.flood_angle);
        changed = ImGui::SliderFloat("##angle", &angle, 1, 90, "up to %.0f deg");
        settings.flood_angle = angle;
    } else if (settings.tool == Tool::brush) {
        float radius = float(settings.brush_radius);
        changed = ImGui::SliderFloat("##radius", &radius, 4, 100, "radius %.0f px");
        settings.brush_radius = radius;
    } else
        ImGui::Dummy({0, 0});
    if (settings.tool == Tool::box || settings.tool == Tool::lasso || settings.tool == Tool::brush) {
        ImGui::SameLine();
        changed |= ImGui::Checkbox("Hidden faces too", &settings.through);
    }
    if (changed)
        frame.actions.push(SetViewSettings{settings});
}

void shortcuts(Frame& frame)
{
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId))
        return;
    const auto pressed = [&](int key) {
        return std::any_of(frame.ui.keys.begin(), frame.ui.keys.end(),
                           [&](const KeyPress& press) { return press.key == key; });
    };
    const bool control = std::any_of(frame.ui.keys.begin(), frame.ui.keys.end(),
                                     [](const KeyPress& press) { return (press.modifiers & GLFW_MOD_CONTROL) != 0; });
    const Session& session = frame.state.document.session;
    if (control) {
        if (pressed(GLFW_KEY_Z))
            frame.actions.push(io.KeyShift ? Action{Redo{}} : Action{Undo{}});
        if (pressed(GLFW_KEY_Y))
            frame.actions.push(Redo{});
        if (pressed(GLFW_KEY_O))
            frame.ui.files.open(FileDialog::Purpose::open_part, session.file);
        if (pressed(GLFW_KEY_S) && session.part) {
            if (frame.state.project.empty())
                frame.ui.files.open(FileDialog::Purpose::save_project,
                                    std::filesystem::path(session.file).replace_extension(project_ending));
            else
                frame.actions.push(SaveProject{});
        }
        if (pressed(GLFW_KEY_E) && session.blank)
            frame.ui.show_export = true;
        if (pressed(GLFW_KEY_Q))
            frame.actions.push(Quit{});
        return;
    }
    const bool dragging = ImGui::IsMouseDown(0) || ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2);
    for (const ToolButton& tool : tools)
        if (pressed(tool.key) && !dragging)
            set_tool(frame, tool.tool);
    ViewSettings view = frame.state.view;
    if (pressed(GLFW_KEY_T)) {
        view.dark = !view.dark;
        frame.actions.push(SetViewSettings{view});
    }
    if (pressed(GLFW_KEY_E)) {
        view.edges = !view.edges;
        frame.actions.push(SetViewSettings{view});
    }
    if (pressed(GLFW_KEY_5)) {
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
        if (pressed(key))
            frame.actions.push(LookFrom{View::part, from});
    if (pressed(GLFW_KEY_F))
        frame.actions.push(FitView{});
    if (pressed(GLFW_KEY_I) && session.part)
        frame.actions.push(InvertSelection{});
    if (pressed(GLFW_KEY_EQUAL) || pressed(GLFW_KEY_KP_ADD))
        frame.actions.push(GrowSelection{});
    if (pressed(GLFW_KEY_MINUS) || pressed(GLFW_KEY_KP_SUBTRACT))
        frame.actions.push(ShrinkSelection{});
    if (pressed(GLFW_KEY_ESCAPE)) {
        if (frame.state.job.running)
            frame.actions.push(CancelJob{});
        else
            frame.actions.push(ClearSelection{});
    }
    if (pressed(GLFW_KEY_F1))
        frame.ui.show_shortcuts = !frame.ui.show_shortcuts;
    if (pressed(GLFW_KEY_F2))
        frame.ui.show_left = !frame.ui.show_left;
    if (pressed(GLFW_KEY_F3))
        frame.ui.show_right = !frame.ui.show_right;
    if (pressed(GLFW_KEY_F5))
        frame.actions.push(RunTo{Stage::fit});
    if (pressed(GLFW_KEY_F6))
        frame.actions.push(RunTo{Stage::solve});
}

} // namespace spia::viewer
