#include <GLFW/glfw3.h>
#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/document/project_file.h"
#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/gui_frame.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

void shortcuts_window(Frame& frame)
{
    if (!frame.ui.show_shortcuts)
        return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    if (ImGui::Begin("Keyboard and mouse", &frame.ui.show_shortcuts,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse)) {
        const MouseStyle style = frame.state.view.mouse;
        constexpr const char* rows[][2] = {
            {"Left button", "uses the tool"},
            {"Shift, Ctrl", "picking adds, takes away"},
            {"View cube", "a click looks from there, a drag turns"},
            {"Double click on a title", "one view, four views"},
            {"F4, Shift + F4", "give the keyboard to the next view, the one before; a click in a view does so, too"},
            {"Arrows, Page up, down", "turn and zoom the view that has the keyboard; Shift: pan"},
            {"Return", "in a view reached by F4: uses the tool at the cross; Corners: the next corner"},
            {"Arrows with Corners",
             "move the corner along the outline of the blank: right, left to the next vertex, up, down to the next sharp corner"},
            {"Alt", "opens the menus: arrows move, Return chooses"},
            {"Arrows, Tab, Space, Return", "in panels: move, next field, press a button, accept what is typed"},
            {"V P B L U R N", "tools: look, face, box, lasso, brush, flood, smooth"},
            {"D G W C", "tools: vertex, outline, line, corners"},
            {"O X M K", "tools: probe, section, measure, shape"},
            {"F5, F6", "run all, unfold"},
            {"F", "fit all"},
            {"1 2 3 4, 5", "top, front, right, isometric; perspective"},
            {"E, T, H", "triangle edges; dark or light; clip"},
            {"F2, F3", "show or hide the panels"},
            {"Ctrl + Z, Y", "undo, redo (also Ctrl + Shift + Z)"},
            {"I, +, -", "invert, grow, shrink the selection"},
            {"Ctrl + O, S, E, Q", "open, save, export, quit"},
            {"Ctrl + comma", "preferences"},
            {"Esc", "close a menu or dialog; cancel the job; back from a spot; clear the selection"}};
        if (ImGui::BeginTable("keys", 2)) {
            const auto row = [](const char* how, const char* does) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(how);
                ImGui::TableNextColumn();
                ImGui::TextDisabled("%s", does);
            };
            row("Mouse", fmt::format("as in {}; others in View > Mouse", title(style)).c_str());
            for (const MouseHabit& habit : habits(style))
                row(habit.how.c_str(), habit.does.c_str());
            for (const auto& each : rows)
                row(each[0], each[1]);
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

/// Before the program ends, or what was read takes the place of work that is not saved.
void unsaved_dialog(Frame& frame)
{
    Ui& ui = frame.ui;
    const auto& waits = frame.state.read_and_waits;
    const bool asks = ui.held || (waits && !ui.after_save);
    if (!asks || !begin_dialog(frame, "Unsaved changes", true, 420, true))
        return;
    const std::filesystem::path &project = frame.state.project, &part = frame.state.document.session.file;
    wrapped(project.empty()
                ? fmt::format("Your changes to {} are not saved in a project.", part.filename().string())
                : fmt::format("Your changes to the project {} are not saved.", project.filename().string()));
    if (!ui.held)
        muted(frame, fmt::format("{} has been read and takes its place.", waits->filename().string()));
    const auto then = [&](bool without_saving) {
        if (!ui.held)
            return Action{TakeOpened{without_saving}};
        ui.confirmed = without_saving;
        return *std::exchange(ui.held, std::nullopt);
    };
    const auto chosen = stacked_answers(frame, {{project.empty() ? "Save..." : "Save"},
                                                {ui.held ? "Quit without saving" : "Continue without saving"},
                                                {"Cancel"}});
    if (chosen)
        ImGui::CloseCurrentPopup();
    end_dialog();
    if (chosen == 0u && frame.state.project.empty()) {
        choose_project_name(frame);
        ui.after_save = then(false);
    } else if (chosen == 0u) {
        frame.actions.push(SaveProject{});
        frame.actions.push(then(false));
    } else if (chosen == 1u)
        frame.actions.push(then(true));
    else if (chosen) {
        if (!ui.held)
            frame.actions.push(DropOpened{});
        ui.held.reset();
    }
}

/// Unsaved work that is out of sight: nothing happens to it without an answer.
void recovery_dialog(Frame& frame)
{
    auto& left = frame.ui.left_work;
    if (!left || left->answer != LeftWork::Answer::none)
        return;
    if (!begin_dialog(frame, "Unsaved work", true, 440))
        return;
    wrapped(left->text);
    figure(frame, "Autosaved", left->saved);
    const std::filesystem::path& now = frame.state.document.session.file;
    if (frame.state.document.session.part && !frame.ui.sample)
        muted(frame, fmt::format("Recovering it closes {}.", now.filename().string()));
    ImGui::Dummy({0, 2 * frame.ui.scale});
    constexpr LeftWork::Answer answers[] = {LeftWork::Answer::recover, LeftWork::Answer::discard,
                                            LeftWork::Answer::later};
    if (const auto chosen = stacked_answers(
            frame,
            {{"Recover"}, {"Discard", "Deletes this work permanently"}, {"Later", "Asks again at the next start"}})) {
        left->answer = answers[*chosen];
        ImGui::CloseCurrentPopup();
    }
    end_dialog();
}

/// What was chosen in the dialog of files.
void follow_chosen_file(Frame& frame)
{
    const auto path = frame.ui.files.show(frame);
    if (!path) {
        if (!frame.ui.files.is_open()) {
            frame.ui.after_save.reset();
            MaterialEditor& editor = frame.ui.materials; // goes on where its file dialog was left
                                                         // without a file
            if (std::exchange(editor.curve_for_editor, false) ||
                (editor.test_for_editor && !frame.ui.show_material &&
                 !frame.ui.dialogs.wants("Material from a tensile test")))
                editor.appears = true, editor.test_for_editor = false;
        }
        return;
    }
    switch (frame.ui.files.purpose()) {
    case FileDialog::Purpose::open_part:
        if (path->extension() == project_ending)
            frame.actions.push(OpenProject{*path});
        else if (has_choices(*path))
            frame.actions.push(ListFile{*path});
        else
            frame.actions.push(OpenPart{*path, ""});
        break;
    case FileDialog::Purpose::open_project: frame.actions.push(OpenProject{*path}); break;
    case FileDialog::Purpose::save_project:
        frame.actions.push(SaveProject{*path});
        if (frame.ui.after_save) // asks again if saving fails
            frame.actions.push(*std::exchange(frame.ui.after_save, std::nullopt));
        break;
    case FileDialog::Purpose::open_limit_curve: {
        if (std::exchange(frame.ui.materials.curve_for_editor, false)) {
            take_limit_curve(frame, *path);
            break;
        }
        LimitsChoice choice = frame.state.document.limits;
        choice.curve = LimitsOptions::Source::points;
        choice.table = *path;
        frame.actions.push(SetLimits{choice});
        break;
    }
    case FileDialog::Purpose::open_k_table: frame.actions.push(SetKFactor{path->string()}); break;
    case FileDialog::Purpose::open_steps: frame.actions.push(OpenSteps{*path}); break;
    case FileDialog::Purpose::save_steps: frame.actions.push(SaveSteps{*path}); break;
    case FileDialog::Purpose::save_animation:
        frame.ui.animating.file = path->string();
        frame.ui.show_animation = true;
        break;
    case FileDialog::Purpose::open_material: frame.actions.push(SetMaterial{path->string()}); break;
    case FileDialog::Purpose::open_tensile_test:
        frame.ui.fitting.table = path->string();
        frame.ui.fitting.options.law = "best"; // of this test
        frame.ui.show_material = true;
        break;
    case FileDialog::Purpose::save_material:
        frame.ui.fitting.file = path->string();
        frame.ui.show_material = true;
        break;
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

} // namespace

void dialogs(Frame& frame)
{
    unsaved_dialog(frame);
    recovery_dialog(frame);
    import_dialog(frame);
    export_dialog(frame);
    picture_dialog(frame);
    report_dialog(frame);
    material_dialog(frame);
    material_editor(frame);
    preferences_dialog(frame);
    animation_dialog(frame);
    about_dialog(frame);
    follow_chosen_file(frame);
    if (frame.ui.dialogs.end_frame())
        close_dialogs();
    shortcuts_window(frame);
    messages_window(frame);
    manual_window(frame);
}

} // namespace spia::viewer
