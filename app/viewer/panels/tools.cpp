#include <GLFW/glfw3.h>
#include <algorithm>
#include <fmt/core.h>
#include <imgui.h>
#include <imgui_internal.h> // ClearActiveID

#include "app/viewer/panels/dialog_parts.h"
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
    {Tool::line, "Line",
     "Draw a drawbead, a pilot or a seam on the part, place by place; Return or a double click ends it, Escape drops it  (W)",
     GLFW_KEY_W},
    {Tool::probe, "Probe", "Pin the value at a place  (O)", GLFW_KEY_O},
    {Tool::section, "Section", "Draw a line: the field is plotted along the cut  (X)", GLFW_KEY_X},
    {Tool::shape, "Shape",
     "Pick control points of the surface, or points of its lattice, and drag them; Shift adds, Ctrl takes away  (K)",
     GLFW_KEY_K},
    {Tool::corners, "Corners", "Drag the four corners along the outline of the blank  (C)", GLFW_KEY_C},
};

void set_tool(Frame& frame, Tool tool)
{
    ViewSettings settings = frame.state.view;
    settings.tool = tool;
    frame.actions.push(SetViewSettings{settings});
}

bool begins_group(Tool tool) { return tool == Tool::pick || tool == Tool::vertex || tool == Tool::probe; }

bool has_options(Tool tool)
{
    return tool == Tool::shape || tool == Tool::line || tool == Tool::flood || tool == Tool::brush ||
           tool == Tool::box || tool == Tool::lasso;
}

/// How the tools and their options fit into the bar.
struct BarStyle {
    /// The second row has the last group of tools and the options. It is there whatever the tool, or views would jump.
    bool compact = false, two_rows = false;
    float gap, group, slider; ///< pixels
};

void push(const Frame& frame, const BarStyle& style)
{
    if (!style.compact)
        return;
    ImGui::PushFont(frame.ui.fonts.small);
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {4 * frame.ui.scale, padding.y + 1 * frame.ui.scale});
}

void pop(const BarStyle& style)
{
    if (!style.compact)
        return;
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

constexpr const char* hidden_too = "Hidden";

BarStyle bar_style(const Frame& frame, float width)
{
    const float s = frame.ui.scale;
    BarStyle style{false, false, 3 * s, 11 * s, 120 * s};
    const auto text = [](const char* label) {
        return ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
    };
    const auto buttons = [&] {
        float sum = -style.gap;
        for (const ToolButton& button : tools)
            sum += text(button.label) + style.gap + (begins_group(button.tool) ? style.group : 0);
        return sum;
    };
    const auto most = [&] { // the brush has most options
        return buttons() + style.gap + style.group + style.slider + 2 * ImGui::GetStyle().ItemInnerSpacing.x +
               ImGui::GetFrameHeight() + ImGui::CalcTextSize(hidden_too).x;
    };
    if (most() <= width)
        return style;
    style = {true, false, 2 * s, 6 * s, 56 * s};
    push(frame, style);
    style.two_rows = most() > width;
    pop(style);
    return style;
}

void tool_options(Frame& frame, const BarStyle& style)
{
    ViewSettings settings = frame.state.view;
    bool changed = false;
    ImGui::SetNextItemWidth(style.slider);
    if (settings.tool == Tool::shape) {
        ImGui::SetNextItemWidth(std::max(style.slider, 122 * frame.ui.scale));
        int kind = int(settings.handles);
        if (ImGui::Combo("##handles", &kind, "control points\0lattice\0")) {
            settings.handles = HandleKind(kind);
            frame.actions.push(SetViewSettings{settings});
        }
        tooltip("What is dragged in the view of the surface. A lattice is laid around it in the step NURBS surface.");
        return;
    }
    if (settings.tool == Tool::line) {
        ImGui::SetNextItemWidth(std::max(style.slider, 92 * frame.ui.scale));
        int kind = int(frame.ui.drawn_line);
        if (ImGui::Combo("##kind", &kind, "drawbead\0pilot\0seam\0"))
            frame.ui.drawn_line = DrawnLine(kind);
        tooltip(
            "Drawbead: restrains the sheet across it. Pilot: the sheet is held. Seam: the part is cut open along it.");
        ImGui::SameLine();
        ImGui::BeginDisabled(frame.ui.line.empty());
        if (ImGui::Button("End line"))
            end_line(frame);
        ImGui::EndDisabled();
        tooltip("Also Return, or a double click");
        return;
    }
    if (settings.tool == Tool::flood) {
        float angle = float(settings.flood_angle);
        changed = ImGui::SliderFloat("##angle", &angle, 1, 90, style.compact ? "%.0f deg" : "up to %.0f deg");
        settings.flood_angle = angle;
    } else if (settings.tool == Tool::brush) {
        float radius = float(settings.brush_radius);
        changed = ImGui::SliderFloat("##radius", &radius, 4, 100, style.compact ? "%.0f px" : "radius %.0f px");
        settings.brush_radius = radius;
        ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    }
    if (settings.tool != Tool::flood) {
        changed |= ImGui::Checkbox(hidden_too, &settings.through);
        tooltip("Take the faces behind others, too");
    }
    if (changed)
        frame.actions.push(SetViewSettings{settings});
}

} // namespace

void tool_bar(Frame& frame)
{
    const Palette p = palette_of(frame.state.view.dark);
    const BarStyle style = bar_style(frame, ImGui::GetContentRegionAvail().x);
    push(frame, style);
    for (const ToolButton& button : tools) {
        if (button.tool != Tool::look && !(style.two_rows && button.tool == Tool::probe))
            ImGui::SameLine(0, style.gap + (begins_group(button.tool) ? style.group : 0));
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
    if (has_options(frame.state.view.tool)) {
        ImGui::SameLine(0, style.gap + style.group);
        tool_options(frame, style);
    }
    pop(style);
}

float tool_bar_height(const Frame& frame, float width)
{
    const BarStyle style = bar_style(frame, width);
    return (style.two_rows ? 2 : 1) * (ImGui::GetFrameHeight() + 6 * frame.ui.scale);
}

void shortcuts(Frame& frame)
{
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId))
        return;
    if (io.WantTextInput) { // what is typed is taken first, then the key counts; undo is that of the text
        for (const KeyPress& press : frame.ui.keys)
            if ((press.key >= GLFW_KEY_F1 && press.key <= GLFW_KEY_F12) ||
                (press.modifiers == GLFW_MOD_CONTROL && (press.key == GLFW_KEY_S || press.key == GLFW_KEY_E ||
                                                         press.key == GLFW_KEY_O || press.key == GLFW_KEY_Q)))
                frame.ui.keys_later.push_back(press);
        if (!frame.ui.keys_later.empty())
            ImGui::ClearActiveID();
        return;
    }
    const auto pressed = [&](int key) {
        return std::any_of(frame.ui.keys.begin(), frame.ui.keys.end(),
                           [&](const KeyPress& press) { return press.key == key; });
    };
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
                frame.model.say(Severity::hint, frame.state.job.running
                                                    ? "There is nothing to export yet: the blank is being made."
                                                    : "There is nothing to export yet: unfold the part first  (F6).");
        }
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
        if (frame.ui.show_shortcuts || frame.ui.show_messages)
            frame.ui.show_shortcuts = frame.ui.show_messages = false;
        else if (!frame.ui.line.empty())
            frame.ui.line.clear();
        else if (frame.state.job.running)
            frame.actions.push(CancelJob{});
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
