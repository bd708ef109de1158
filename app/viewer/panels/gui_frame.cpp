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
