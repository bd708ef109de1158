#include <GLFW/glfw3.h>
#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

bool escape(const Frame& frame)
{
    return std::any_of(frame.ui.keys.begin(), frame.ui.keys.end(),
                       [](const KeyPress& press) { return press.key == GLFW_KEY_ESCAPE; });
}

void shortcuts_window(Frame& frame)
{
    if (!frame.ui.show_shortcuts)
        return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    if (ImGui::Begin("Keyboard and mouse", &frame.ui.show_shortcuts,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse)) {
        constexpr const char* rows[][2] = {{"Left button", "what the tool does; with Look: turn"},
                                           {"Right button", "turn, with every tool"},
                                           {"Middle button, Shift + right", "pan"},
                                           {"Wheel", "zoom to the place under the mouse"},
                                           {"Shift, Ctrl", "picking adds, takes away"},
                                           {"Double click on a title", "one view, four views"},
                                           {"V P B L U R N", "tools: look, face, box, lasso, brush, flood, smooth"},
                                           {"D G O X C", "tools: vertex, outline, probe, section, corners"},
                                           {"F5, F6", "run all, unfold"},
                                           {"F", "fit all"},
                                           {"1 2 3 4, 5", "top, front, right, isometric; perspective"},
                                           {"E, T", "triangle edges; dark or light"},
                                           {"F2, F3", "show or hide the panels"},
                                           {"Ctrl + Z, Y", "undo, redo"},
                                           {"Ctrl + O, S, E, Q", "open, save, export, quit"},
                                           {"Esc", "clear the selection; cancel the job"}};
        if (ImGui::BeginTable("keys", 2)) {
            for (const auto& row : rows) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(row[0]);
                ImGui::TableNextColumn();
                ImGui::TextDisabled("%s", row[1]);
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

void unsaved_dialog(Frame& frame)
{
    if (frame.ui.held && !ImGui::IsPopupOpen("Unsaved changes"))
        ImGui::OpenPopup("Unsaved changes");
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({420 * frame.ui.scale, 0});
    if (!ImGui::BeginPopupModal("Unsaved changes", nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove))
        return;
    ImGui::PushTextWrapPos(0);
    ImGui::Text("What you changed on %s is not saved in a project.",
                frame.state.document.session.file.filename().c_str());
    ImGui::PopTextWrapPos();
    const auto go_on = [&] {
        frame.ui.confirmed = true;
        frame.actions.push(*std::exchange(frame.ui.held, std::nullopt));
        ImGui::CloseCurrentPopup();
    };
    if (primary_button(frame, "Save...")) {
        if (frame.state.project.empty()) {
            frame.ui.files.open(
                FileDialog::Purpose::save_project,
                std::filesystem::path(frame.state.document.session.file).replace_extension(project_ending));
            frame.ui.held.reset(); // once saved, the way is free
            ImGui::CloseCurrentPopup();
        } else {
            frame.actions.push(SaveProject{});
            frame.actions.push(*std::exchange(frame.ui.held, std::nullopt));
            ImGui::CloseCurrentPopup();
        }
    }
    if (ImGui::Button("Go on without saving", {-1, 0}))
        go_on();
    if (ImGui::Button("Cancel", {-1, 0}) || escape(frame)) {
        frame.ui.held.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

} // namespace

void dialogs(Frame& frame)
{
    unsaved_dialog(frame);
    export_dialog(frame);
    picture_dialog(frame);
    report_dialog(frame);
    shortcuts_window(frame);
    messages_window(frame);
    const auto path = frame.ui.files.show(frame.ui.scale);
    if (!path)
        return;
    switch (frame.ui.files.purpose()) {
    case FileDialog::Purpose::open_part: frame.actions.push(OpenPart{*path, ""}); break;
    case FileDialog::Purpose::open_project: frame.actions.push(OpenProject{*path}); break;
    case FileDialog::Purpose::save_project: frame.actions.push(SaveProject{*path}); break;
    case FileDialog::Purpose::open_material: frame.actions.push(SetMaterial{path->string()}); break;
    case FileDialog::Purpose::save_report:
        frame.ui.reporting.file = path->string();
        frame.ui.show_report = true;
        break;
    case FileDialog::Purpose::save_picture:
        frame.ui.picturing.file = path->string();
        frame.ui.show_picture = true;
        break;
    case FileDialog::Purpose::export_folder:
        frame.ui.exporting.folder = path->string();
        frame.ui.show_export = true;
        break;
    }
}

} // namespace spia::viewer
