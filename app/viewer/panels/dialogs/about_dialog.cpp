#include <GLFW/glfw3.h>
#include <utility>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {

void about_dialog(Frame& frame)
{
    const bool appears = std::exchange(frame.ui.show_about, false);
    if (!begin_dialog(frame, "About SPIA", appears, 520))
        return;
    const auto& versions = frame.ui.versions;
    ImGui::PushFont(frame.ui.fonts.heading);
    ImGui::TextUnformatted(versions.empty() ? "SPIA" : (versions[0].first + " " + versions[0].second).c_str());
    ImGui::PopFont();
    wrapped("From a stamped sheet-metal part to its flat blank, its strains and its NURBS surface.");
    muted(frame, "Free software under the GNU General Public License, version 3 or later, without any warranty.\n"
                 "Licence: GPL-3.0-or-later");
    ImGui::Dummy({0, 4 * frame.ui.scale});
    if (ImGui::BeginTable("versions", 2, ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, 170 * frame.ui.scale);
        ImGui::TableSetupColumn("version", ImGuiTableColumnFlags_WidthStretch);
        for (size_t k = 1; k < versions.size(); ++k) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(versions[k].first.c_str());
            ImGui::TableNextColumn();
            muted(frame, versions[k].second);
        }
        ImGui::EndTable();
    }
    ImGui::Dummy({0, 2 * frame.ui.scale});
    const float wide = 130 * frame.ui.scale;
    if (ImGui::Button("Copy all", {wide, 0})) {
        std::string text;
        for (const auto& [name, version] : versions)
            text += name + " " + version + "\n";
        ImGui::SetClipboardText(text.c_str());
    }
    tooltip("Copies the list of versions, for a bug report");
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - wide);
    if (ImGui::Button("Close", {wide, 0}) || pressed(frame, GLFW_KEY_ESCAPE) || enter_pressed(frame))
        ImGui::CloseCurrentPopup();
    end_dialog();
}

} // namespace spia::viewer
