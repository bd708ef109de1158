#include <GLFW/glfw3.h>
#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/reports/comparison.h"
#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/gui_frame.h"
#include "app/viewer/panels/lights.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"

namespace spia::viewer {
namespace {

/// What can be done with the selection, at the right end of the status bar.
struct SelectionRow {
    std::string text;
    std::vector<std::pair<const char*, Action>> acts;
    float gap = 0, width = 0; ///< pixels
};

SelectionRow selection_row(const Frame& frame)
{
    SelectionRow row;
    const size_t faces = frame.state.document.selected.size(), vertices = frame.state.document.vertices.size();
    if (faces == 0 && vertices == 0)
        return row;
    const auto count = [](size_t n, const char* one, const char* many) {
        return n == 0 ? "" : fmt::format("{} {}", n, n == 1 ? one : many);
    };
    row.text = count(faces, "face", "faces") + (faces && vertices ? ", " : "") + count(vertices, "vertex", "vertices") +
               " selected";
    if (faces > 0)
        row.acts = {{"Grow", GrowSelection{}}, {"Shrink", ShrinkSelection{}}, {"Invert", InvertSelection{}}};
    row.acts.emplace_back("Clear", ClearSelection{});
    row.gap = 6 * frame.ui.scale;
    row.width = ImGui::CalcTextSize(row.text.c_str()).x + 14 * frame.ui.scale;
    for (const auto& [label, action] : row.acts)
        row.width += ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x + row.gap;
    return row;
}

float selection_width(const Frame& frame)
{
    const float width = selection_row(frame).width;
    return width > 0 ? width + 16 * frame.ui.scale : 14 * frame.ui.scale;
}

void selection_actions(Frame& frame)
{
    const SelectionRow row = selection_row(frame);
    if (row.acts.empty())
        return;
    const auto& [text, acts, gap, width] = row;
    ImGui::SameLine(ImGui::GetWindowWidth() - width);
    ImGui::TextColored(palette_of(frame.state.view.dark).accent, "%s", text.c_str());
    for (const auto& [label, action] : acts) {
        ImGui::SameLine(0, gap);
        if (ImGui::SmallButton(label))
            frame.actions.push(action);
    }
}

void animation_status(Frame& frame, AnimationRun& run)
{
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Making the animation");
    ImGui::SameLine();
    ImGui::ProgressBar(float(run.fraction), {180 * frame.ui.scale, ImGui::GetFrameHeight() * 0.8f},
                       fmt::format("{:.0f} %", 100 * run.fraction).c_str());
    ImGui::SameLine();
    ImGui::BeginDisabled(run.cancelling);
    if (small_button(frame, run.cancelling ? "Cancelling..." : "Cancel"))
        run.cancelling = true;
    ImGui::EndDisabled();
}

/// What is under the mouse has a place of its own, right of what there is to look at. @param room
/// pixels
void under_mouse(Frame& frame, float room)
{
    const ViewerState& state = frame.state;
    const Session& session = state.document.session;
    const auto& probe = frame.model.under_mouse();
    const auto& vertex = state.hovered_vertex;
    if (!session.part || (!probe && !vertex))
        return;
    const TriMesh& part = session.part->mesh;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    if (vertex)
        at = part.position.col(*vertex);
    else
        for (int a = 0; a < 3; ++a)
            at += probe->barycentric[a] * part.position.col(part.triangle(a, probe->face));
    at /= millimetres(frame.lengths());
    const std::string what = vertex ? fmt::format("Vertex {}", session.part->source_vertex[size_t(*vertex)])
                                    : fmt::format("Face {}", probe->face);
    const std::string place = fmt::format("    {1:.{0}f}, {2:.{0}f}, {3:.{0}f} {4}", 2 + more_decimals(frame.lengths()),
                                          at[0], at[1], at[2], length_word(frame.lengths()));
    std::string value;
    const Field field = state.document.display.field;
    if (field != Field::none && available(session, field)) {
        const Figures& now = figures(frame);
        value = fmt::format("    {} {}{}", label_of_field(state),
                            value_text(vertex ? now.at_vertex[*vertex] : now.face.value[probe->face], info(field).unit,
                                       frame.lengths()),
                            vertex && is_smoothed(state.document.display) ? ", mean of the faces around it" : "");
    }
    // as much as there is room for
    for (const std::string& text : {what + place + value, what + value, what})
        if (ImGui::CalcTextSize(text.c_str()).x <= room) {
            ImGui::TextUnformatted(text.c_str());
            return;
        }
}

void status_bar(Frame& frame)
{
    const ViewerState& state = frame.state;
    const Palette p = palette_of(state.view.dark);
    if (state.job.running) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(state.job.title.c_str());
        ImGui::SameLine();
        ImGui::ProgressBar(float(state.job.fraction), {180 * frame.ui.scale, ImGui::GetFrameHeight() * 0.8f},
                           fmt::format("{:.0f} %", 100 * state.job.fraction).c_str());
        ImGui::SameLine();
        ImGui::TextColored(p.muted, "%s",
                           state.job.cancelling
                               ? "cancelling..."
                               : fmt::format("{}    Esc cancels", engine_words(frame, state.job.step)).c_str());
        return;
    }
    if (frame.ui.animation) {
        animation_status(frame, *frame.ui.animation);
        return;
    }
    ImGui::AlignTextToFramePadding();
    ready_light(frame);
    ImGui::SameLine(0, 24 * frame.ui.scale);
    // Where it stands does not change with what is said before it, unless that is long.
    constexpr float usual = 0.34f; // of the window
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), usual * ImGui::GetWindowWidth()));
    under_mouse(frame, std::max(0.f, ImGui::GetWindowWidth() - ImGui::GetCursorPosX() - selection_width(frame)));
}

/// Where there is room for one panel, both are still to be seen.
void choice_of_panel(Frame& frame)
{
    const float gap = 4 * frame.ui.scale, width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    const auto tab = [&](const char* label, SidePanels::Which which) {
        const bool shown = frame.ui.panels.shown(which, true);
        ImGui::PushStyleColor(ImGuiCol_Button,
                              ImGui::GetStyleColorVec4(shown ? ImGuiCol_HeaderActive : ImGuiCol_Button));
        if (ImGui::Button(label, {width, 0}) && !shown)
            frame.ui.panels.toggle(which, true);
        ImGui::PopStyleColor();
    };
    tab("Steps", SidePanels::steps);
    tooltip("The steps from part to surface  (F2)");
    ImGui::SameLine(0, gap);
    tab("Inspect", SidePanels::inspect);
    tooltip("The field and its charts  (F3)");
}

} // namespace

void workbench(Frame& frame)
{
    if (pressed(frame, GLFW_KEY_ESCAPE) && close_menus())
        std::erase_if(frame.ui.keys, [](const KeyPress& press) { return press.key == GLFW_KEY_ESCAPE; });
    points_for_commas();
    frame.ui.items.clear();
    frame.ui.wake_at = 0;
    const ImGuiIO& io = ImGui::GetIO();
    const float s = frame.ui.scale;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(io.DisplaySize);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("workbench", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_MenuBar | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    menu_bar(frame);
    const float status = ImGui::GetFrameHeight() + 4 * s;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = io.DisplaySize.y - at.y - status;
    // Narrow windows keep room for the views; their one panel is on the left, whichever it is.
    const bool narrow = is_narrow(io.DisplaySize.x, s);
    const bool steps = frame.ui.panels.shown(SidePanels::steps, narrow),
               inspect = frame.ui.panels.shown(SidePanels::inspect, narrow);
    const float left = steps || (narrow && inspect)
                           ? std::min(frame.ui.left_width * s,
                                      std::max(io.DisplaySize.x * 0.3f, std::min(230 * s, io.DisplaySize.x / 2)))
                           : 0,
                right = inspect && !narrow ? std::min(frame.ui.right_width * s, io.DisplaySize.x * 0.25f) : 0;
    const Palette p = palette_of(frame.state.view.dark);
    if (left > 0) {
        ImGui::SetCursorScreenPos(at);
        ImGui::BeginChild("left", {left, height}, false,
                          ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar |
                              ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NavFlattened);
        if (narrow)
            choice_of_panel(frame);
        if (steps)
            steps_panel(frame);
        else
            inspect_panel(frame);
        ImGui::EndChild();
    }
    const float middle = io.DisplaySize.x - left - right, bar = tool_bar_height(frame, middle - 12 * s) + 4 * s;
    ImGui::SetCursorScreenPos({at.x + left + 6 * s, at.y + 4 * s});
    ImGui::BeginChild("tools", {middle - 12 * s, bar - 4 * s}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                          ImGuiWindowFlags_NavFlattened);
    tool_bar(frame);
    ImGui::EndChild();
    const float clip = clip_bar_height(frame);
    if (clip > 0) {
        ImGui::SetCursorScreenPos({at.x + left + 6 * s, at.y + bar});
        ImGui::BeginChild("clip", {middle - 12 * s, clip}, false,
                          ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                              ImGuiWindowFlags_NavFlattened);
        clip_bar(frame);
        ImGui::EndChild();
    }
    const MessageStrip messages = message_strip(frame, middle);
    ImGui::SetCursorScreenPos({at.x + left, at.y + bar + clip});
    ImGui::BeginChild("views", {middle, height - bar - clip - messages.height}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    view_area(frame);
    ImGui::EndChild();
    if (messages.height > 0) {
        ImGui::SetCursorScreenPos({at.x + left, at.y + height - messages.height});
        ImGui::BeginChild("messages", {middle, messages.height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
        draw_messages(frame, messages);
        ImGui::EndChild();
    }
    if (right > 0) {
        ImGui::SetCursorScreenPos({at.x + left + middle, at.y});
        ImGui::BeginChild("right", {right, height}, false,
                          ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar |
                              ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NavFlattened);
        inspect_panel(frame);
        ImGui::EndChild();
    }
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddLine({0, at.y + height}, {io.DisplaySize.x, at.y + height}, ink(p.line));
    ImGui::SetCursorScreenPos({at.x + 12 * s, at.y + height + 2 * s});
    status_bar(frame);
    selection_actions(frame);
    ImGui::End();
    // The key that answers a dialog means nothing else.
    const bool answers = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId) || !frame.ui.dialogs.empty();
    dialogs(frame);
    if (!answers)
        shortcuts(frame);
}

} // namespace spia::viewer
