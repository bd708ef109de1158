#include "app/viewer/panels/dialogs/material_dialog.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/document/suggested_files.h"
#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/stress_plot.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"
#include "engine/options/option.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {
namespace {

using Kind = TensileOptions::Kind;

void labelled(const char* label)
{
    form_row(label);
    ImGui::SetNextItemWidth(-1);
}

/// A choice of which the first says nothing: what is said in the file counts.
template <class T>
void choice(const char* id, const char* names, std::optional<T>& value, const std::array<T, 2>& values)
{
    int now = !value ? 0 : *value == values[0] ? 1 : 2;
    if (ImGui::Combo(id, &now, names))
        value = now == 0 ? std::nullopt : std::optional(values[size_t(now) - 1]);
}

void test_inputs(Frame& frame, MaterialFitOptions& options)
{
    labelled("Stress and strain");
    choice("##kind", "As the heading says\0Engineering\0True\0", options.test.kind, {Kind::engineering, Kind::truly});
    labelled("Unit of strain");
    choice("##strain", "As the heading says, or by its size\0Fraction\0Percent\0", options.test.in_percent,
           {false, true});
    labelled("Young's modulus");
    double young = options.test.young_MPa.value_or(0);
    ImGui::SetNextItemWidth(110 * frame.ui.scale);
    if (typed_number(frame, "MPa##young", young, options.test.young_MPa ? "%.6g" : "of the test"))
        options.test.young_MPa = young > 0 ? std::optional(std::clamp(young, 1e3, 1e6)) : std::nullopt;
    tooltip("0: from the slope of the first rows of the test");
    labelled("r0, r45, r90");
    double r[] = {options.r0, options.r45, options.r90};
    ImGui::SetNextItemWidth(-1);
    if (typed_numbers(frame, "##r", r, 3, "%.4g")) {
        options.r0 = std::clamp(r[0], 1e-3, 99.);
        options.r45 = std::clamp(r[1], 1e-3, 99.);
        options.r90 = std::clamp(r[2], 1e-3, 99.);
    }
    tooltip(
        "r-values (Lankford coefficients) along, at 45\u00b0 to and across the rolling direction; a tensile curve does not contain them");
}

/// Every law with its error; a click takes it.
void law_table(const Frame& frame, const MaterialFit& fit, MaterialFitOptions& options)
{
    if (!ImGui::BeginTable("laws", 3, ImGuiTableFlags_RowBg))
        return;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 1 * frame.ui.scale});
    ImGui::TableSetupColumn("Law", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("Error, rms", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("Fitted to the test", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    for (size_t k = 0; k < fit.fits.size(); ++k) {
        const LawFit& law = fit.fits[k];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::BeginDisabled(!law.law);
        // "Voce: 290 MPa ..."
        const std::string words = law.law ? describe(*law.law) : law.name + ": " + law.reason;
        const size_t colon = words.find(": ");
        if (ImGui::RadioButton(words.substr(0, colon).c_str(), k == fit.taken))
            options.law = law.name;
        ImGui::EndDisabled();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(law.law ? fmt::format("{:.2f} MPa", law.rms_MPa).c_str() : "-");
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(words.c_str() + colon + 2);
        tooltip(words);
    }
    ImGui::PopStyleVar();
    ImGui::EndTable();
}

/// Points of the test, the law that was taken as a line, as far as the sheet may be strained.
void curve_plot(const Frame& frame, const MaterialFit& fit)
{
    const Palette p = palette_of(frame.state.view.dark);
    const float s = frame.ui.scale;
    const TensileTest& test = fit.test;
    const double last = 1.4 * test.plastic_strain[test.plastic_strain.size() - 1];
    const StressPlot plot = stress_plot(frame, 130 * s, last, flow_stress(fit.material.hardening, last).stress,
                                        "true stress, MPa, over true plastic strain; points: the test");
    const Eigen::Index each = std::max<Eigen::Index>(1, test.plastic_strain.size() / 60);
    for (Eigen::Index k = 0; k < test.plastic_strain.size(); k += each)
        ImGui::GetWindowDrawList()->AddCircleFilled(plot.place(test.plastic_strain[k], test.stress_MPa[k]), 2.2f * s,
                                                    ink(p.warning));
    draw_curve(plot, flow_curve(fit.material.hardening, plot.strain, 100), ink(p.accent), 1.8f * s);
}

const MaterialChoices::Outcome& outcome_of(MaterialChoices& choices)
{
    std::error_code ignored;
    const auto time = std::filesystem::last_write_time(choices.table, ignored);
    return choices.outcome.of({choices.table, time, choices.options}, [&] {
        MaterialChoices::Outcome made;
        try {
            made.fit = fit_material(choices.table, choices.options);
        } catch (const std::exception& error) {
            made.problem = window_text(error.what());
        }
        return made;
    });
}

} // namespace

void choose_tensile_test(Frame& frame)
{
    const std::string& last = frame.ui.fitting.table;
    frame.ui.files.open(FileDialog::Purpose::open_tensile_test,
                        last.empty() ? working_folder(frame.state, frame.ui.recent, frame.model.assets())
                                     : std::filesystem::path(last));
}

void material_dialog(Frame& frame)
{
    MaterialChoices& choices = frame.ui.fitting;
    const bool appears = std::exchange(frame.ui.show_material, false);
    if (!begin_dialog(frame, "Material from a tensile test", appears, 620))
        return;
    std::filesystem::path beside(choices.table);
    follow(choices.file, choices.suggested, beside.replace_extension(".json").string());
    bool choose_table = false, choose_file = false;
    const auto columns = [&](const char* id) {
        if (!ImGui::BeginTable(id, 2))
            return false;
        ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 130 * frame.ui.scale);
        ImGui::TableSetupColumn("choice", ImGuiTableColumnFlags_WidthStretch);
        return true;
    };
    if (columns("test")) {
        labelled("Tensile test");
        choose_table = path_input(frame, "table", choices.table, "two columns, strain and stress in MPa");
        test_inputs(frame, choices.options);
        ImGui::EndTable();
    }
    const MaterialChoices::Outcome& outcome = outcome_of(choices);
    if (outcome.fit) {
        const TensileTest& test = outcome.fit->test;
        ImGui::TextUnformatted(
            fmt::format("E = {:.0f} MPa ({}), Rp0.2 = {:.1f} MPa, Rm = {:.1f} MPa, uniform true strain {:.3f}",
                        test.young_MPa, test.measured_young ? "measured" : "given", test.proof_stress_MPa,
                        test.tensile_strength_MPa, test.uniform_strain)
                .c_str());
        for (const std::string& note : test.notes)
            muted(frame, as_sentence(engine_words(frame, note)));
        law_table(frame, *outcome.fit, choices.options);
        curve_plot(frame, *outcome.fit);
    } else
        coloured(palette_of(frame.state.view.dark).error, as_sentence(outcome.problem));
    const bool for_editor = frame.ui.materials.test_for_editor;
    if (columns("material")) {
        labelled("Name");
        text_input("##name", choices.options.name, false, "that of the file");
        if (!for_editor) {
            labelled("Material file");
            choose_file = path_input(frame, "file", choices.file, "a file for the material");
            if (!choices.file.empty())
                replaced_note(frame, choices.file);
        }
        ImGui::EndTable();
    }
    const bool ready = outcome.fit && (for_editor || !choices.file.empty());
    const Answer answer = answer_buttons(frame, for_editor ? "Open in the material editor" : "Save and use it", ready,
                                         palette_of(frame.state.view.dark).accent);
    if (ready && (answer == Answer::yes || (enter_pressed(frame) && !choose_table && !choose_file))) {
        if (for_editor) {
            Material material = outcome.fit->material;
            if (material.name.empty())
                material.name = std::filesystem::path(choices.table).stem().string();
            edit_new_material(frame, std::move(material));
        } else {
            std::filesystem::path file = choices.file;
            if (file.extension() != ".json")
                file += ".json";
            frame.actions.push(FitMaterial{choices.table, file, choices.options});
        }
        ImGui::CloseCurrentPopup();
    } else if (choose_table || choose_file) {
        ImGui::CloseCurrentPopup();
        if (choose_table)
            choose_tensile_test(frame);
        else
            frame.ui.files.open(FileDialog::Purpose::save_material, choices.file);
    }
    if (for_editor && (answer != Answer::none || (ready && enter_pressed(frame))) && !choose_table) {
        frame.ui.materials.test_for_editor = false;
        frame.ui.materials.appears = true;
    }
    if (answer == Answer::cancel)
        ImGui::CloseCurrentPopup();
    end_dialog();
}

} // namespace spia::viewer
