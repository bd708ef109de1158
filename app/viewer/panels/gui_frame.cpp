#include "app/viewer/panels/gui_frame.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace spia::viewer {

bool close_menus()
{
    const auto& open = ImGui::GetCurrentContext()->OpenPopupStack;
    int keep = open.Size;
    while (keep > 0 && open[keep - 1].Window && !(open[keep - 1].Window->Flags & ImGuiWindowFlags_Modal))
        --keep;
    if (keep == open.Size)
        return false;
    ImGui::ClosePopupToLevel(keep, true);
    return true;
}

bool menus_are_open()
{
    const auto& open = ImGui::GetCurrentContext()->OpenPopupStack;
    return open.Size > 0 && open.back().Window && !(open.back().Window->Flags & ImGuiWindowFlags_Modal);
}

bool take_return_in_menus()
{
    ImGuiIO& io = ImGui::GetIO();
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    const auto& open = context.OpenPopupStack;
    const bool menu = open.Size > 0 ? open.back().Window && !(open.back().Window->Flags & ImGuiWindowFlags_Modal)
                                    : context.NavWindow && context.NavLayer == ImGuiNavLayer_Menu;
    const auto down = [&](ImGuiKey key) { return io.KeyMap[key] >= 0 && io.KeysDown[io.KeyMap[key]]; };
    if (!menu || io.WantTextInput || (!down(ImGuiKey_Enter) && !down(ImGuiKey_KeyPadEnter)))
        return false;
    io.NavInputs[ImGuiNavInput_Activate] = 1;
    return true;
}

std::optional<std::array<ImVec2, 2>> marked_item()
{
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    if (!context.NavWindow || context.NavId == 0 || context.NavDisableHighlight)
        return std::nullopt;
    const ImRect& item = context.NavWindow->NavRectRel[context.NavLayer];
    const ImVec2 from = context.NavWindow->DC.CursorStartPos;
    return std::array<ImVec2, 2>{ImVec2(from.x + item.Min.x, from.y + item.Min.y),
                                 ImVec2(from.x + item.Max.x, from.y + item.Max.y)};
}

bool is_at(const char* label) { return ImGui::GetCurrentContext()->NavId == ImGui::GetID(label); }

void go_to_last_item()
{
    ImGuiContext& context = *ImGui::GetCurrentContext();
    ImGui::SetFocusID(context.LastItemData.ID, context.CurrentWindow);
    context.NavDisableHighlight = false;
}

void close_dialogs()
{
    const auto& open = ImGui::GetCurrentContext()->OpenPopupStack;
    if (open.Size > 0 && open[0].Window && (open[0].Window->Flags & ImGuiWindowFlags_Modal))
        ImGui::ClosePopupToLevel(0, true);
}

void end_broken_frame()
{
    ImGuiContext& context = *ImGui::GetCurrentContext();
    if (!context.WithinFrameScope)
        return;
    context.FontStack.clear(); // the only stack that is not unwound next, and it must be before
    ImGui::ErrorCheckEndFrameRecover(nullptr);
    ImGui::EndFrame();
}

} // namespace spia::viewer
