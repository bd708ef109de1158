#include "app/viewer/panels/dialogs/dialog_parts.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <cfloat>
#include <fmt/core.h>
#include <imgui_internal.h> // CloseButton

#include "app/viewer/model/document/suggested_files.h"
#include "app/viewer/panels/gui_frame.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {

bool begin_modal(const Frame& frame, const char* title, bool appears, ImGuiWindowFlags flags, bool* stays, bool urgent)
{
    DialogQueue& queue = frame.ui.dialogs;
    queue.seen(title);
    if (appears)
        queue.want(title, urgent);
    if (!queue.shows(title))
        return false;
    if (!queue.opened(title)) {
        ImGui::OpenPopup(title);
        queue.open(title);
    }
    if (ImGui::BeginPopupModal(title, stays, flags | ImGuiWindowFlags_NoMove))
        return true;
    queue.leave(title); // it has been answered
    return false;
}

/// The x of a dialog does what Escape does in it, each dialog in its own way.
static void close_button(const Frame& frame)
{
    ImGuiWindow* window = ImGui::GetCurrentWindow();
    const ImGuiStyle& style = ImGui::GetStyle();
    const float side = ImGui::GetFontSize();
    const ImVec2 at{window->Pos.x + window->Size.x - style.FramePadding.x - side - style.WindowBorderSize,
                    window->Pos.y + style.FramePadding.y};
    ImGui::PushClipRect(window->Pos, {window->Pos.x + window->Size.x, window->Pos.y + window->Size.y}, false);
    if (ImGui::CloseButton(window->GetID("#CLOSE"), {at.x - style.FramePadding.x, at.y - style.FramePadding.y}))
        frame.ui.keys.push_back({GLFW_KEY_ESCAPE, 0});
    ImGui::PopClipRect();
    frame.ui.items["close dialog"] = {at, {at.x + side, at.y + side}};
}

bool begin_dialog(const Frame& frame, const char* title, bool appears, float width, bool urgent)
{
    if (appears || frame.ui.dialogs.shows(title)) { // else it would be the place and size of the
                                                    // next window
        const ImVec2 screen = ImGui::GetIO().DisplaySize;
        const float wide = std::min(width * frame.ui.scale, screen.x - 40);
        ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
        ImGui::SetNextWindowSizeConstraints({wide, 0}, {wide, screen.y - 20});
    }
    if (!begin_modal(frame, title, appears, ImGuiWindowFlags_AlwaysAutoResize, nullptr, urgent))
        return false;
    close_button(frame);
    ImGui::PushID(frame.ui.dialogs.openings());            // no field goes on with what was typed
                                                           // there the last time
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 1); // an empty box has nearly the colour of
                                                           // the window
    return true;
}

void end_dialog()
{
    ImGui::PopStyleVar();
    ImGui::PopID();
    ImGui::EndPopup();
}

bool pressed(const Frame& frame, int key)
{
    return std::any_of(frame.ui.keys.begin(), frame.ui.keys.end(),
                       [&](const KeyPress& press) { return press.key == key; });
}

bool enter_pressed(const Frame& frame) { return pressed(frame, GLFW_KEY_ENTER) || pressed(frame, GLFW_KEY_KP_ENTER); }

std::optional<size_t> stacked_answers(const Frame& frame, std::initializer_list<StackedAnswer> answers)
{
    size_t at = 0, k = 0;
    for (const StackedAnswer& answer : answers) {
        at = is_at(answer.label) ? k : at;
        ++k;
    }
    const auto& keys = frame.ui.keys;
    const auto tab =
        std::find_if(keys.begin(), keys.end(), [](const KeyPress& press) { return press.key == GLFW_KEY_TAB; });
    if (tab != keys.end())
        at = (at + (tab->modifiers & GLFW_MOD_SHIFT ? answers.size() - 1 : 1)) % answers.size();
    std::optional<size_t> chosen;
    k = 0;
    for (const StackedAnswer& answer : answers) {
        if (k == 0 ? primary_button(frame, answer.label) : ImGui::Button(answer.label, {-1, 0}))
            chosen = k;
        if (ImGui::IsWindowAppearing() ? k == 0 : tab != keys.end() && k == at)
            go_to_last_item();
        if (*answer.help)
            tooltip(answer.help);
        ++k;
    }
    if (!chosen && enter_pressed(frame))
        chosen = at;
    if (!chosen && pressed(frame, GLFW_KEY_ESCAPE))
        chosen = answers.size() - 1;
    return chosen;
}

void form_row(const char* label)
{
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    ImGui::TableNextColumn();
}

bool path_input(const Frame& frame, const char* id, std::string& path, const char* hint)
{
    const float button = ImGui::CalcTextSize("Choose...").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::PushID(id);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - 6 * frame.ui.scale);
    text_input("##path", path, false, hint);
    ImGui::SameLine(0, 6 * frame.ui.scale);
    const bool chosen = ImGui::Button("Choose...");
    ImGui::PopID();
    return chosen;
}

void replaced_note(const Frame& frame, const std::filesystem::path& file)
{
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored))
        coloured(palette_of(frame.state.view.dark).warning, "This file exists already and will be replaced.");
    else
        muted(frame, "A new file.");
}

float answer_buttons_height(const Frame& frame)
{
    return 2 * frame.ui.scale + ImGui::GetStyle().ItemSpacing.y + ImGui::GetFrameHeight() * 1.15f;
}

Answer answer_buttons(const Frame& frame, const char* yes, bool enabled, const ImVec4& colour)
{
    const float gap = 8 * frame.ui.scale, height = ImGui::GetFrameHeight() * 1.15f;
    const ImFont* bold = frame.ui.fonts.bold;
    const auto width = [&](const char* label) {
        const float text = bold->CalcTextSizeA(bold->FontSize, FLT_MAX, 0, label).x;
        return std::max(110 * frame.ui.scale, text + 28 * frame.ui.scale);
    };
    ImGui::Dummy({0, 2 * frame.ui.scale});
    const float whole = width(yes) + gap + width("Cancel");
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.f, ImGui::GetContentRegionAvail().x - whole));
    Answer answer = Answer::none;
    if (ImGui::Button("Cancel", {width("Cancel"), height}) || pressed(frame, GLFW_KEY_ESCAPE))
        answer = Answer::cancel;
    ImGui::SameLine(0, gap);
    ImGui::BeginDisabled(!enabled);
    if (coloured_button(frame, yes, {width(yes), height}, colour))
        answer = Answer::yes;
    ImGui::EndDisabled();
    return answer;
}

std::filesystem::path suggested_file(const Frame& frame, const std::string& ending)
{
    return suggested_file(frame.state, frame.ui.recent, frame.model.assets(), ending);
}

void choose_part(Frame& frame)
{
    const std::filesystem::path& file = frame.state.document.session.file;
    const std::filesystem::path folder = working_folder(frame.state, frame.ui.recent, frame.model.assets());
    const bool here = file.has_filename() && std::filesystem::absolute(file).parent_path() == folder;
    frame.ui.files.open(FileDialog::Purpose::open_part, here ? std::filesystem::absolute(file) : folder);
}

void choose_project(Frame& frame)
{
    frame.ui.files.open(FileDialog::Purpose::open_project,
                        frame.state.project.empty() ? working_folder(frame.state, frame.ui.recent, frame.model.assets())
                                                    : frame.state.project);
}

void choose_project_name(Frame& frame)
{
    frame.ui.files.open(FileDialog::Purpose::save_project, suggested_file(frame, std::string(project_ending)));
}

void follow(std::string& path, std::string& suggested, const std::string& suggestion)
{
    if (path.empty() || path == suggested)
        path = suggestion;
    suggested = suggestion;
}

void old_results_banner(Frame& frame)
{
    const JobView& job = frame.state.job;
    if (job.running && !frame.model.exporting()) {
        ImGui::TextUnformatted(job.title.c_str());
        ImGui::SameLine();
        muted(frame, job.cancelling ? "Stopping..." : engine_words(frame, job.step));
        const float cancel = ImGui::CalcTextSize("Stop").x + 2 * ImGui::GetStyle().FramePadding.x;
        ImGui::ProgressBar(float(job.fraction),
                           {ImGui::GetContentRegionAvail().x - cancel - ImGui::GetStyle().ItemSpacing.x, 0},
                           fmt::format("{:.0f} %", 100 * job.fraction).c_str());
        ImGui::SameLine();
        ImGui::BeginDisabled(job.cancelling);
        if (ImGui::Button("Stop"))
            frame.actions.push(CancelJob{});
        ImGui::EndDisabled();
        ImGui::Dummy({0, 4 * frame.ui.scale});
        return;
    }
    const std::string text = out_of_date(frame.state.document);
    if (text.empty())
        return;
    coloured(palette_of(frame.state.view.dark).warning, text);
    if (ImGui::Button("Update all first"))
        frame.actions.push(RunTo{Stage::fit}); // the dialog stays and shows how far it is
    ImGui::Dummy({0, 4 * frame.ui.scale});
}

} // namespace spia::viewer
