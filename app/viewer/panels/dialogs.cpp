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

void export_dialog(Frame& frame)
{
    if (frame.ui.show_export) {
        ImGui::OpenPopup("Export");
        if (frame.ui.export_folder.empty())
            frame.ui.export_folder =
                (std::filesystem::absolute(frame.state.document.session.file).parent_path() / "spia-out").string();
    }
    frame.ui.show_export = false;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(520 * frame.ui.scale, screen.x - 40), 0});
    if (!ImGui::BeginPopupModal("Export", nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove))
        return;
    const Session& session = frame.state.document.session;
    const Palette p = palette_of(frame.state.view.dark);
    if (session.surface) {
        const double worst = session.surface->deviation.max();
        coloured(worst > 0.1 ? p.warning : p.good,
                 fmt::format("The surface is within {:.3g} mm of the part (95 % of it within {:.3g} mm).", worst,
                             session.surface->deviation.mesh_to_surface.p95));
    } else
        coloured(p.warning, "There is no surface yet: IGES and STEP are left out.");
    struct Choice {
        const char *format, *text;
    };
    static constexpr Choice choices[] = {{"iges", "IGES: the NURBS surface for CAD"},
                                         {"step", "STEP AP242: the NURBS surface for CAD"},
                                         {"glb", "glTF binary: part, blank, quads, surface with their fields"},
                                         {"vtu", "VTU: all fields, for ParaView"},
                                         {"dxf", "DXF: outline of the blank"},
                                         {"csv", "CSV: fields per vertex, outline"},
                                         {"png", "PNG: one picture of the whole chain"}};
    auto& formats = frame.ui.export_formats;
    for (const Choice& choice : choices) {
        bool on = std::find(formats.begin(), formats.end(), choice.format) != formats.end();
        if (ImGui::Checkbox(choice.text, &on)) {
            std::erase(formats, choice.format);
            if (on)
                formats.push_back(choice.format);
        }
    }
    muted(frame, "Lengths in mm (glTF: metres, as its specification wants).");
    ImGui::SetNextItemWidth(-90 * frame.ui.scale);
    text_input("##folder", frame.ui.export_folder, false, "folder");
    ImGui::SameLine();
    if (ImGui::Button("Choose...")) {
        ImGui::CloseCurrentPopup();
        frame.ui.files.open(FileDialog::Purpose::export_folder, frame.ui.export_folder);
    }
    ImGui::Dummy({0, 2});
    if (primary_button(frame, "Export", !formats.empty() && !frame.ui.export_folder.empty())) {
        frame.actions.push(ExportFiles{frame.ui.export_folder, formats});
        ImGui::CloseCurrentPopup();
    }
    if (ImGui::Button("Cancel", {-1, 0}) || escape(frame))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
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
    shortcuts_window(frame);
    const auto path = frame.ui.files.show(frame.ui.scale);
    if (!path)
        return;
    switch (frame.ui.files.purpose()) {
    case FileDialog::Purpose::open_part: frame.actions.push(OpenPart{*path, ""}); break;
    case FileDialog::Purpose::open_project: frame.actions.push(OpenProject{*path}); break;
    case FileDialog::Purpose::save_project: frame.actions.push(SaveProject{*path}); break;
    case FileDialog::Purpose::open_material: frame.actions.push(SetMaterial{path->string()}); break;
    case FileDialog::Purpose::save_report: frame.actions.push(WriteReport{*path}); break;
    case FileDialog::Purpose::save_picture: frame.actions.push(Screenshot{*path, {}, 0, 0}); break;
    case FileDialog::Purpose::export_folder:
        frame.ui.export_folder = path->string();
        frame.ui.show_export = true;
        break;
    }
}

} // namespace spia::viewer
