#include "app/viewer/panels/material_dialog.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/suggested_files.h"
#include "app/viewer/model/viewer_words.h"
#include "app/viewer/panels/dialog_parts.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"

namespace spia::viewer {
namespace {

using Kind = TensileOptions::Kind;

void labelled(const char* label)
{
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    ImGui::TableNextColumn();
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
    tooltip("0: the slope of the first rows of the test");
    labelled("r0, r45, r90");
    double r[] = {options.r0, options.r45, options.r90};
    ImGui::SetNextItemWidth(-1);
    if (typed_numbers(frame, "##r", r, 3, "%.4g")) {
        options.r0 = std::clamp(r[0], 1e-3, 99.);
        options.r45 = std::clamp(r[1], 1e-3, 99.);
        options.r90 = std::clamp(r[2], 1e-3, 99.);
    }
    tooltip(
        "Lankford coefficients along, at 45 degrees to and across the rolling direction: a tensile curve does not hold them");
}

/// Every law with its error; a click takes it.
void law_table(const Frame& frame, const MaterialFit& fit, MaterialFitOptions& options)
{
    if (!ImGui::BeginTable("laws", 3, ImGuiTableFlags_RowBg))
        return;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 1 * frame.ui.scale});
    ImGui::TableSetupColumn("law", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("rms error", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("fit", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    for (size_t k = 0; k < fit.fits.size(); ++k) {
        const LawFit& law = fit.fits[k];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::BeginDisabled(!law.law);
        const std::string words = law.law ? in_words(*law.law) : law.name + ": " + law.reason; // "Voce: 290 MPa ..."
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

/// True stress over plastic strain: points of the test, the law that was taken as a line, as far as the sheet may be strained.
void curve_plot(const Frame& frame, const MaterialFit& fit)
{
    const Palette p = palette_of(frame.state.view.dark);
    const float s = frame.ui.scale, height = 130 * s, line = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 low{at.x + 48 * s, at.y + height - line - 4 * s},
        high{at.x + ImGui::GetContentRegionAvail().x - 8 * s, at.y + line + 2 * s};
    const TensileTest& test = fit.test;
    const RoundRange strains = round_range(0, 1.4 * test.plastic_strain[test.plastic_strain.size() - 1]),
                     stresses = round_range(0, flow_stress(fit.material.hardening, strains.greatest).stress);
    const double last = strains.greatest, most = stresses.greatest;
    const auto place = [&](double strain, double stress) {
        return ImVec2(low.x + float(strain / last) * (high.x - low.x),
                      low.y - float(std::clamp(stress / most, 0., 1.)) * (low.y - high.y));
    };
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const int rows = (stresses.intervals + 3) / 4, columns = (strains.intervals + 7) / 8; // so many to a number
    for (int k = 0; k <= stresses.intervals; k += rows) {
        const double stress = most * k / stresses.intervals;
        const std::string text = fmt::format("{:.4g}", stress);
        const ImVec2 left = place(0, stress);
        draw->AddLine(left, {high.x, left.y}, ink(p.line));
        draw->AddText({left.x - ImGui::CalcTextSize(text.c_str()).x - 5 * s, left.y - line / 2}, ink(p.muted),
                      text.c_str());
    }
    for (int k = 0; k <= strains.intervals; k += columns) {
        const double strain = last * k / strains.intervals;
        const std::string text = fmt::format("{:.3g}", strain);
        const float wide = ImGui::CalcTextSize(text.c_str()).x, at_x = place(strain, 0).x;
        draw->AddText({std::min(at_x - wide / 2, high.x - wide), low.y + 3 * s}, ink(p.muted), text.c_str());
    }
    draw->AddText({low.x, at.y - 2 * s}, ink(p.muted), "true stress, MPa, over plastic strain; points: the test");
    const Eigen::Index each = std::max<Eigen::Index>(1, test.plastic_strain.size() / 60);
    for (Eigen::Index k = 0; k < test.plastic_strain.size(); k += each)
        draw->AddCircleFilled(place(test.plastic_strain[k], test.stress_MPa[k]), 2.2f * s, ink(p.warning));
    constexpr int pieces = 100;
    std::vector<ImVec2> curve;
    for (int k = 1; k <= pieces; ++k)
        curve.push_back(place(last * k / pieces, flow_stress(fit.material.hardening, last * k / pieces).stress));
    draw->AddPolyline(curve.data(), int(curve.size()), ink(p.accent), ImDrawFlags_None, 1.8f * s);
    ImGui::Dummy({0, height});
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
            made.problem = in_viewer_words(error.what());
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
        ImGui::TextUnformatted(fmt::format("E {:.0f} MPa {}, Rp0.2 {:.1f} MPa, Rm {:.1f} MPa, uniform strain {:.3f}",
                                           test.young_MPa, test.measured_young ? "measured" : "given",
                                           test.proof_stress_MPa, test.tensile_strength_MPa, test.uniform_strain)
                                   .c_str());
        for (const std::string& note : test.notes)
            muted(frame, as_sentence(note));
        law_table(frame, *outcome.fit, choices.options);
        curve_plot(frame, *outcome.fit);
    } else
        coloured(palette_of(frame.state.view.dark).error, as_sentence(outcome.problem));
    if (columns("material")) {
        labelled("Name");
        text_input("##name", choices.options.name, false, "that of the file");
        labelled("Material file");
        choose_file = path_input(frame, "file", choices.file, "a file for the material");
        if (!choices.file.empty())
            replaced_note(frame, choices.file);
        ImGui::EndTable();
    }
    const bool ready = outcome.fit && !choices.file.empty();
    const Answer answer = answer_buttons(frame, "Save and use it", ready, palette_of(frame.state.view.dark).accent);
    if (ready && (answer == Answer::yes || (enter_pressed(frame) && !choose_table && !choose_file))) {
        std::filesystem::path file = choices.file;
        if (file.extension() != ".json")
            file += ".json";
        frame.actions.push(FitMaterial{choices.table, file, choices.options});
        ImGui::CloseCurrentPopup();
    } else if (choose_table || choose_file) {
        ImGui::CloseCurrentPopup();
        if (choose_table)
            choose_tensile_test(frame);
        else
            frame.ui.files.open(FileDialog::Purpose::save_material, choices.file);
    }
    if (answer == Answer::cancel)
        ImGui::CloseCurrentPopup();
    end_dialog();
}

} // namespace spia::viewer
