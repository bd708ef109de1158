#include "app/viewer/panels/dialogs/preferences_dialog.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/actions/json_members.h"
#include "app/viewer/model/document/grades.h"
#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/widgets.h"
#include "engine/report/text/lengths.h"

namespace spia::viewer {
namespace {

/// One of two, side by side.
template <class T> void either(const Frame& frame, const char* first, T one, const char* second, T other, T& chosen)
{
    if (ImGui::RadioButton(first, chosen == one))
        chosen = one;
    ImGui::SameLine(0, 16 * frame.ui.scale);
    if (ImGui::RadioButton(second, chosen == other))
        chosen = other;
}

void interface_rows(Frame& frame, Preferences& edited)
{
    form_row("Theme");
    either(frame, "Dark", true, "Light", false, edited.dark);
    form_row("Interface size");
    ImGui::SetNextItemWidth(110 * frame.ui.scale);
    if (ImGui::BeginCombo("##size", fmt::format("{} %", edited.interface_percent).c_str())) {
        for (const int percent : {75, 90, 100, 110, 125, 150, 175, 200})
            if (ImGui::Selectable(fmt::format("{} %", percent).c_str(), percent == edited.interface_percent))
                edited.interface_percent = percent;
        ImGui::EndCombo();
    }
    form_row("Lengths in");
    either(frame, "mm", LengthUnit::mm, "inch", LengthUnit::inch, edited.lengths);
    tooltip("On the screen and in reports. The unit of exported files is chosen in the export dialog.");
    form_row("Mouse as in");
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##mouse", title(edited.mouse))) {
        for (const MouseStyle style : all_mouse_styles)
            if (ImGui::Selectable(title(style), style == edited.mouse))
                edited.mouse = style;
        ImGui::EndCombo();
    } else
        tooltip("How the mouse turns, pans and zooms; its gestures are in the list of F1");
    form_row("Field colours");
    constexpr std::pair<std::optional<ColourMap>, const char*> maps[] = {
        {std::nullopt, "Automatic: blue to orange about 0, else blue to yellow"},
        {ColourMap::viridis, "Blue to yellow (viridis)"},
        {ColourMap::diverging, "Blue to orange"},
        {ColourMap::grey, "Grey"}};
    const auto chosen =
        std::find_if(std::begin(maps), std::end(maps), [&](const auto& each) { return each.first == edited.map; });
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##map", chosen != std::end(maps) ? chosen->second : "")) {
        for (const auto& [map, label] : maps)
            if (ImGui::Selectable(label, map == edited.map))
                edited.map = map;
        ImGui::EndCombo();
    }
}

/// A length that is chosen or not.
void chosen_length(Frame& frame, const char* label, const char* id, std::optional<double>& chosen, double& offered,
                   LengthUnit unit, const LengthFormat& format, const Between& range)
{
    bool given = chosen.has_value();
    if (ImGui::Checkbox(label, &given))
        chosen = given ? std::optional(offered) : std::nullopt;
    ImGui::SameLine(0, 8 * frame.ui.scale);
    ImGui::BeginDisabled(!given);
    ImGui::SetNextItemWidth(90 * frame.ui.scale);
    double value = chosen.value_or(offered);
    if (length_inputs(frame, fmt::format("{}{}", length_word(unit), id).c_str(), &value, 1, unit, format)) {
        value = std::clamp(value, range.least, range.greatest);
        chosen = offered = value;
    }
    ImGui::EndDisabled();
}

void part_rows(Frame& frame, PreferenceChoices& choices)
{
    Preferences& edited = choices.edited;
    form_row("Grade");
    const Grade* now = edited.material.empty() ? nullptr : grade_called(*frame.state.grades, edited.material);
    const std::string none = "None chosen: mild_steel is assumed";
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##grade", edited.material.empty() ? none.c_str()
                                     : now                   ? now->label().c_str()
                                                             : edited.material.c_str())) {
        if (ImGui::Selectable(none.c_str(), edited.material.empty()))
            edited.material.clear();
        for (const Grade& grade : *frame.state.grades) {
            ImGui::BeginDisabled(!grade.material);
            if (ImGui::Selectable(fmt::format("{}##{}", grade.label(), grade.reference).c_str(),
                                  grade.reference == edited.material))
                edited.material = grade.reference;
            ImGui::EndDisabled();
        }
        ImGui::EndCombo();
    }
    form_row("Thickness");
    chosen_length(frame, "of all parts", "##thickness", edited.thickness_mm, choices.thickness_mm, edited.lengths,
                  {.mm = "%.4g"}, {1e-3, 1e3});
    form_row("Surface");
    ImGui::Checkbox("of one patch", &edited.one_patch);
    tooltip("Otherwise the program chooses between one patch and several");
    form_row("");
    chosen_length(frame, "fitted within", "##tolerance", edited.tolerance_mm, choices.tolerance_mm, edited.lengths,
                  {.mm = "%.4g", .inch = "%.3g"}, {1e-6, 1e3});
    tooltip(
        "Largest distance from the part; without it 1/1000 of the part's diagonal, or of one patch through the nodes of the grid");
}

} // namespace

void preferences_dialog(Frame& frame)
{
    PreferenceChoices& choices = frame.ui.preferring;
    const bool appears = std::exchange(frame.ui.show_preferences, false);
    if (appears) {
        choices.edited = frame.state.preferences;
        choices.edited.dark = frame.state.view.dark;
        choices.edited.mouse = frame.state.view.mouse;
        choices.thickness_mm = choices.edited.thickness_mm.value_or(choices.thickness_mm);
        choices.tolerance_mm = choices.edited.tolerance_mm.value_or(choices.tolerance_mm);
    }
    if (!begin_dialog(frame, "Preferences", appears, 540))
        return;
    const auto table = [&](const char* id) {
        if (!ImGui::BeginTable(id, 2))
            return false;
        ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 120 * frame.ui.scale);
        ImGui::TableSetupColumn("choice", ImGuiTableColumnFlags_WidthStretch);
        return true;
    };
    if (table("window")) {
        interface_rows(frame, choices.edited);
        ImGui::EndTable();
    }
    ImGui::Dummy({0, 4 * frame.ui.scale});
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted("New parts");
    ImGui::PopFont();
    muted(frame, "Used when a part is opened whose file does not give them.");
    if (table("parts")) {
        part_rows(frame, choices);
        ImGui::EndTable();
    }
    const Answer answer = answer_buttons(frame, "Save", true, palette_of(frame.state.view.dark).accent);
    if (answer == Answer::yes || enter_pressed(frame)) {
        frame.actions.push(SetPreferences{choices.edited});
        ImGui::CloseCurrentPopup();
    } else if (answer == Answer::cancel)
        ImGui::CloseCurrentPopup();
    end_dialog();
}

} // namespace spia::viewer
