#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <imgui.h>

#include "app/viewer/model/picking/measuring.h"
#include "app/viewer/panels/tool_icons.h"
#include "app/viewer/panels/tool_table.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

void set_tool(Frame& frame, Tool tool)
{
    ViewSettings settings = frame.state.view;
    settings.tool = tool;
    frame.actions.push(SetViewSettings{settings});
}

bool has_options(Tool tool)
{
    return tool == Tool::shape || tool == Tool::line || tool == Tool::flood || tool == Tool::brush ||
           tool == Tool::box || tool == Tool::lasso || tool == Tool::measure;
}

/// How the tools and their options fit into the bar.
struct BarStyle {
    bool stacked = false;           ///< names under the signs; else only the chosen tool has its
                                    ///< name, beside
    bool two_rows = false;          ///< options below. The row is there whatever the tool, or views
                                    ///< would jump.
    float icon, gap, group, slider; ///< pixels
};

constexpr const char* hidden_too = "Hidden";

float name_width(const Frame& frame, const char* label)
{
    ImFont* const font = frame.ui.fonts.small;
    return font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, label).x;
}

ImVec2 button_size(const Frame& frame, const BarStyle& style, const ToolButton& button, bool chosen)
{
    const float s = frame.ui.scale, line = frame.ui.fonts.small->FontSize;
    if (style.stacked)
        return {std::round(std::max(name_width(frame, button.label) + 10 * s, 34 * s)),
                std::round(style.icon + line + 9 * s)};
    const float side = std::round(style.icon + 8 * s);
    return {side + (chosen ? std::round(name_width(frame, button.label) + 4 * s) : 0), side};
}

float options_width(const Frame& frame, const BarStyle& style) // the brush has most
{
    return style.slider + 2 * ImGui::GetStyle().ItemInnerSpacing.x + ImGui::GetFrameHeight() +
           name_width(frame, hidden_too);
}

BarStyle bar_style(const Frame& frame, float width)
{
    const float s = frame.ui.scale;
    const auto tools_width = [&](const BarStyle& style) {
        float sum = 0, widest = 0;
        for (const ToolButton& button : tools) {
            sum += button_size(frame, style, button, false).x + style.gap + (button.begins_group ? style.group : 0);
            widest = std::max(widest,
                              button_size(frame, style, button, true).x - button_size(frame, style, button, false).x);
        }
        return sum + widest;
    };
    BarStyle style{true, false, std::round(18 * s), 1 * s, 11 * s, 80 * s};
    if (const float rest = width - tools_width(style) - style.group - options_width(frame, style); rest >= 0) {
        style.slider += std::min(rest, 60 * s);
        return style;
    }
    style = {false, false, std::round(16 * s), 1 * s, 7 * s, 56 * s};
    style.two_rows = tools_width(style) + style.group + options_width(frame, style) > width;
    return style;
}

float row_height(const Frame& frame, const BarStyle& style)
{
    return button_size(frame, style, tools[0], false).y + 4 * frame.ui.scale;
}

/// @returns whether it was pressed
bool tool_button(Frame& frame, const BarStyle& style, const ToolButton& button)
{
    const Palette p = palette_of(frame.state.view.dark);
    const bool chosen = frame.state.view.tool == button.tool;
    const ImVec2 size = button_size(frame, style, button, chosen);
    const float s = frame.ui.scale;
    // The chosen one stands out, the others are signs on the ground of the bar.
    const ImVec4 none(0, 0, 0, 0);
    ImGui::PushStyleColor(ImGuiCol_Button, chosen ? p.accent : none);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, chosen ? p.accent : ImGui::GetStyleColorVec4(ImGuiCol_ButtonHovered));
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::Button(fmt::format("##tool {}", button.label).c_str(), size);
    ImGui::PopStyleVar();
    ImGui::PopStyleColor(2);
    note_place(frame, fmt::format("tool {}", button.label));
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImU32 white = IM_COL32_WHITE, text = chosen ? white : ImGui::GetColorU32(ImGuiCol_Text);
    const float left = style.stacked ? std::round((size.x - style.icon) / 2) : 4 * s;
    draw_tool_icon(draw, button.tool, {std::round(at.x + left), std::round(at.y + (style.stacked ? 3 : 4) * s)},
                   style.icon, text, chosen ? white : ink(p.accent));
    ImFont* const font = frame.ui.fonts.small;
    if (style.stacked)
        draw->AddText(
            font, font->FontSize,
            {std::round(at.x + (size.x - name_width(frame, button.label)) / 2), std::round(at.y + style.icon + 5 * s)},
            text, button.label);
    else if (chosen)
        draw->AddText(font, font->FontSize,
                      {std::round(at.x + style.icon + 8 * s), std::round(at.y + (size.y - font->FontSize) / 2)}, text,
                      button.label);
    tooltip(fmt::format("{}  ({})\n{}", button.label, button.letter, button.help),
            clip_bar_height(frame) + 6 * s); // the row of the clipping plane stays in sight
    return pressed;
}

void tool_options(Frame& frame, const BarStyle& style)
{
    ViewSettings settings = frame.state.view;
    bool changed = false;
    ImGui::SetNextItemWidth(style.slider);
    if (settings.tool == Tool::shape) {
        item_for("control points");
        int kind = int(settings.handles);
        if (ImGui::Combo("##handles", &kind, "control points\0lattice\0")) {
            settings.handles = HandleKind(kind);
            frame.actions.push(SetViewSettings{settings});
        }
        tooltip("Points to drag in the surface view. Add a lattice in the step NURBS surface.");
        return;
    }
    if (settings.tool == Tool::measure) {
        item_for("Radius of a fillet or bend");
        if (ImGui::BeginCombo("##measure", title(settings.measure))) {
            for (const MeasureKind kind : {MeasureKind::distance, MeasureKind::angle, MeasureKind::faces,
                                           MeasureKind::circle, MeasureKind::rounding})
                if (ImGui::Selectable(title(kind), kind == settings.measure)) {
                    settings.measure = kind;
                    frame.ui.measuring.clear();
                    frame.actions.push(SetViewSettings{settings});
                }
            ImGui::EndCombo();
        } else
            tooltip(advice(settings.measure));
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
        changed = ImGui::SliderFloat("##angle", &angle, 1, 90, !style.stacked ? "%.0f deg" : "up to %.0f deg");
        settings.flood_angle = angle;
    } else if (settings.tool == Tool::brush) {
        float radius = float(settings.brush_radius);
        changed = ImGui::SliderFloat("##radius", &radius, 4, 100, !style.stacked ? "%.0f px" : "radius %.0f px");
        settings.brush_radius = radius;
        ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    }
    if (settings.tool != Tool::flood) {
        changed |= ImGui::Checkbox(hidden_too, &settings.through);
        tooltip("Select hidden faces too");
    }
    if (changed)
        frame.actions.push(SetViewSettings{settings});
}

} // namespace

void tool_bar(Frame& frame)
{
    const BarStyle style = bar_style(frame, ImGui::GetContentRegionAvail().x);
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const float s = frame.ui.scale, height = row_height(frame, style) - 4 * s;
    for (const ToolButton& button : tools) {
        if (button.tool != Tool::look)
            ImGui::SameLine(0, style.gap + (button.begins_group ? style.group : 0));
        if (button.begins_group) {
            const float x = std::round(ImGui::GetCursorScreenPos().x - style.gap / 2 - style.group / 2);
            ImGui::GetWindowDrawList()->AddLine({x, start.y + 4 * s}, {x, start.y + height - 4 * s},
                                                ink(palette_of(frame.state.view.dark).line), s);
        }
        if (tool_button(frame, style, button))
            set_tool(frame, button.tool);
    }
    if (!has_options(frame.state.view.tool))
        return;
    if (!style.two_rows)
        ImGui::SameLine(0, style.gap + style.group);
    ImGui::PushFont(style.stacked ? frame.ui.fonts.text : frame.ui.fonts.small);
    if (!style.two_rows) // in the middle of the row
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() + std::round((height - ImGui::GetFrameHeight()) / 2));
    tool_options(frame, style);
    ImGui::PopFont();
}

float tool_bar_height(const Frame& frame, float width)
{
    const BarStyle style = bar_style(frame, width);
    return row_height(frame, style) + (style.two_rows ? ImGui::GetFrameHeight() + 6 * frame.ui.scale : 0);
}

} // namespace spia::viewer
