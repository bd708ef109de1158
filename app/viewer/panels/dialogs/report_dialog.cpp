#include "app/viewer/panels/dialogs/report_dialog.h"

#include <algorithm>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

void column_heading(const Frame& frame, const char* text)
{
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
}

void pictures_column(const Frame& frame, ViewerReportOptions& options)
{
    const Session& session = frame.state.document.session;
    column_heading(frame, "Pictures");
    auto& chosen = options.pictures;
    for (const View view : all_views) {
        const bool there = (view != View::quads || session.lifted) && (view != View::surface || session.surface);
        bool on = std::find(chosen.begin(), chosen.end(), view) != chosen.end();
        ImGui::BeginDisabled(!there);
        if (ImGui::Checkbox(title(view), &on)) {
            std::erase(chosen, view);
            if (on)
                chosen.push_back(view);
        }
        ImGui::EndDisabled();
    }
    column_heading(frame, "Appearance");
    if (ImGui::RadioButton("Standard: light, whole part, thinning", options.standard_look))
        options.standard_look = true;
    if (ImGui::RadioButton("Current views", !options.standard_look))
        options.standard_look = false;
}

void tables_column(const Frame& frame, ReportTables& tables)
{
    column_heading(frame, "Tables");
    ImGui::Checkbox("Key figures", &tables.key_figures);
    ImGui::Checkbox("Largest thinning", &tables.worst_spots);
    ImGui::Checkbox("Assumptions", &tables.assumptions);
    ImGui::Checkbox("Convergence of the solver", &tables.solver);
    ImGui::Checkbox("Input part", &tables.repairs);
    muted(frame, "Warnings about the result are always in the report.");
}

} // namespace

void report_dialog(Frame& frame)
{
    ReportChoices& choices = frame.ui.reporting;
    ViewerReportOptions& options = choices.options;
    const Session& session = frame.state.document.session;
    const bool appears = std::exchange(frame.ui.show_report, false);
    if (appears) {
        follow(choices.file, choices.suggested, suggested_file(frame, ".html").string());
        if (choices.about != session.file.string())
            options.title = options.remarks = "";
        choices.about = session.file.string();
    }
    if (!begin_dialog(frame, "Report", appears, 600))
        return;
    old_results_banner(frame);
    const float s = frame.ui.scale;
    ImGui::SetNextItemWidth(-1);
    text_input("##title", options.title, false, ("Title: " + session.file.filename().string()).c_str());
    const bool typing = text_area("##remarks", options.remarks, {-1, 5 * ImGui::GetTextLineHeight() + 10 * s});
    if (options.remarks.empty() && !typing) {
        const ImVec2 at = ImGui::GetItemRectMin(), pad = ImGui::GetStyle().FramePadding;
        ImGui::GetWindowDrawList()->AddText({at.x + pad.x, at.y + pad.y}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
                                            "Remarks");
    }
    if (ImGui::BeginTable("columns", 2, ImGuiTableFlags_SizingStretchSame)) {
        ImGui::TableNextColumn();
        pictures_column(frame, options);
        ImGui::TableNextColumn();
        tables_column(frame, options.tables);
        ImGui::EndTable();
    }
    ImGui::Separator();
    const bool choose = path_input(frame, "file", choices.file, "a file for the report");
    std::filesystem::path file = choices.file;
    if (file.extension() != ".html")
        file += ".html";
    if (!choices.file.empty())
        replaced_note(frame, file);
    if (choose) {
        ImGui::CloseCurrentPopup();
        frame.ui.files.open(FileDialog::Purpose::save_report, choices.file);
    }
    const bool ready = !choices.file.empty();
    const Answer answer = answer_buttons(frame, "Write the report", ready, palette_of(frame.state.view.dark).accent);
    if (ready && (answer == Answer::yes || (enter_pressed(frame) && !typing))) {
        options.lengths = frame.lengths();
        frame.actions.push(WriteReport{file, options});
        ImGui::CloseCurrentPopup();
    }
    if (answer == Answer::cancel)
        ImGui::CloseCurrentPopup();
    end_dialog();
}

} // namespace spia::viewer
