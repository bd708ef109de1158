#include "app/viewer/panels/lights.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/actions/remedies.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

const char* name_of(ChainStep step)
{
    switch (step) {
    case ChainStep::part: return "Part";
    case ChainStep::sheet: return "Sheet";
    case ChainStep::unfold: return "Unfold";
    case ChainStep::grid: return "Corners and grid";
    case ChainStep::surface: return "NURBS surface";
    }
    return "";
}

/// @returns whether it was clicked
bool show_place(Frame& frame, const Doubt& doubt)
{
    if (!doubt.face && !doubt.place)
        return false;
    const bool pressed = small_button(frame, "Show");
    note_place(frame, fmt::format("show {}", name_of(doubt.step)));
    if (!pressed)
        return false;
    if (const auto face = face_of(doubt, frame.state.document.session.part->mesh))
        frame.actions.push(FlyTo{*face, doubt.field});
    return true;
}

/// @returns whether a click asked to see something in the views
bool doubt_row(Frame& frame, const Doubt& doubt)
{
    coloured(palette_of(frame.state.view.dark).warning, doubt.text);
    if (!doubt.next.empty())
        muted(frame, doubt.next);
    const Document& document = frame.state.document;
    const bool looks = show_place(frame, doubt);
    if (doubt.button.empty())
        return looks;
    if (doubt.face || doubt.place)
        beside_if_room(doubt.button.c_str());
    ImGui::BeginDisabled(frame.model.busy());
    const bool pressed = small_button(frame, doubt.button.c_str());
    note_place(frame, doubt.button);
    ImGui::EndDisabled();
    if (pressed)
        for (Action& action : actions_of(doubt, document))
            frame.actions.push(std::move(action));
    return looks;
}

const std::vector<Doubt>& doubts(const Frame& frame)
{
    static const std::vector<Doubt> none;
    return frame.state.doubts ? *frame.state.doubts : none;
}

constexpr const char* list = "things to look at";

void list_of_doubts(Frame& frame)
{
    const float s = frame.ui.scale;
    ImGui::SetNextWindowSize({std::min(420 * s, ImGui::GetIO().DisplaySize.x - 40 * s), 0});
    if (!ImGui::BeginPopup(list))
        return;
    if (all_doubt_rows(frame) || doubts(frame).empty())
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace

Status light(const Frame& frame, ChainStep step, Status made)
{
    const bool doubted =
        std::any_of(doubts(frame).begin(), doubts(frame).end(), [&](const Doubt& doubt) { return doubt.step == step; });
    return made == Status::done && doubted ? Status::poor : made;
}

bool all_doubt_rows(Frame& frame)
{
    bool looks = false;
    std::optional<ChainStep> last;
    for (size_t k = 0; k < doubts(frame).size(); ++k) {
        const Doubt& doubt = doubts(frame)[k];
        if (last != doubt.step) {
            if (last)
                ImGui::Separator();
            ImGui::PushFont(frame.ui.fonts.bold);
            ImGui::TextUnformatted(name_of(doubt.step));
            ImGui::PopFont();
        }
        last = doubt.step;
        ImGui::PushID(int(k));
        looks |= doubt_row(frame, doubt);
        ImGui::PopID();
    }
    return looks;
}

void doubt_rows(Frame& frame, ChainStep step)
{
    for (size_t k = 0; k < doubts(frame).size(); ++k)
        if (doubts(frame)[k].step == step) {
            ImGui::PushID(int(k));
            doubt_row(frame, doubts(frame)[k]);
            ImGui::PopID();
        }
}

void ready_light(Frame& frame)
{
    const Palette p = palette_of(frame.state.view.dark);
    if (frame.drawing) {
        ImGui::TextColored(p.muted, "Drawing...");
        return;
    }
    const Readiness ready = readiness(frame.state);
    if (ready.fine) {
        ImGui::TextColored(p.muted, "%s", ready.text.c_str());
        return;
    }
    const float r = 4 * frame.ui.scale;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + r, at.y + ImGui::GetFrameHeight() / 2}, r, ink(p.warning));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 4 * r);
    const bool listed = !doubts(frame).empty() && ready.lists_doubts;
    if (!listed) {
        ImGui::TextColored(p.warning, "%s", ready.text.c_str());
        return;
    }
    ImGui::PushStyleColor(ImGuiCol_Text, p.warning);
    if (small_button(frame, ready.text.c_str()))
        ImGui::OpenPopup(list);
    ImGui::PopStyleColor();
    note_place(frame, list);
    tooltip("Why a light is amber, and what to do");
    list_of_doubts(frame);
}

} // namespace spia::viewer
