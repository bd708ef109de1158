#include "app/viewer/panels/dialogs/material_editor.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/dialogs/material_fields.h"
#include "app/viewer/panels/stress_plot.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"
#include "engine/core/error.h"
#include "engine/limits/forming_limit_curve.h"

namespace spia::viewer {
namespace {

constexpr double last_strain = 0.5; // of the plot: beyond it laws are extrapolations
constexpr int pieces = 200;         // of a curve
constexpr std::string_view is_new = "new: ";

/// The grade that is looked at.
struct Shown {
    std::string key;
    const Grade* grade = nullptr; ///< null: a new one
    Material material;
    bool editable = false, changed = false, whole = false; ///< whole: it could be read
};

Shown shown_grade(Frame& frame)
{
    MaterialEditor& editor = frame.ui.materials;
    const std::vector<Grade>& grades = *frame.state.grades;
    Shown shown;
    shown.key = editor.shown;
    const auto draft = editor.draft.find(shown.key);
    if (shown.key.empty() || (draft == editor.draft.end() && !grade_called(grades, shown.key)))
        shown.key = frame.state.document.material;
    shown.grade = shown.key.starts_with(is_new) ? nullptr : grade_called(grades, shown.key);
    // a file elsewhere, not in the list
    if (!shown.grade && !shown.key.starts_with(is_new) && !grades.empty()) {
        shown.material = frame.state.document.session.options.flatten.material;
        shown.whole = true;
        return shown;
    }
    if (draft != editor.draft.end() && draft->first == shown.key) {
        shown.material = draft->second;
        shown.changed = shown.whole = true;
    } else if (shown.grade && shown.grade->material) {
        shown.material = *shown.grade->material;
        shown.whole = true;
    }
    shown.editable = !shown.grade || shown.grade->own;
    return shown;
}

/// Colours that all kinds of colour blindness keep apart [Okabe and Ito 2008], the yellow left out,
/// which paper swallows; then the same in dashes.
ImU32 line_colour(size_t k, bool dark, float opacity)
{
    const Colour colours[] = {
        {0.90f, 0.60f, 0.05f, 1}, {0.34f, 0.71f, 0.91f, 1},
        {0.05f, 0.65f, 0.48f, 1}, {0.84f, 0.37f, 0.05f, 1},
        {0.80f, 0.47f, 0.65f, 1}, dark ? Colour{0.85f, 0.87f, 0.90f, 1} : Colour{0.12f, 0.14f, 0.18f, 1}};
    return ink(colours[k % std::size(colours)], opacity);
}
float line_dash(size_t k, float scale)
{
    constexpr float dashes[] = {0, 9, 3};
    return dashes[(k / 6) % std::size(dashes)] * scale;
}

// --- the list
void sample(const Frame& frame, size_t k, ImVec2 at, float height)
{
    const float s = frame.ui.scale, y = at.y + height / 2;
    draw_dashed(ImGui::GetWindowDrawList(), {{at.x, y}, {at.x + 24 * s, y}}, line_colour(k, frame.state.view.dark, 1),
                2.4f * s, line_dash(k, s));
}

/// @returns whether it was clicked
bool list_row(Frame& frame, const std::string& key, const std::string& label, bool here, std::optional<size_t> curve,
              const std::string& mark, const ImVec4* colour)
{
    MaterialEditor& editor = frame.ui.materials;
    const float s = frame.ui.scale, height = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    const bool clicked = ImGui::Selectable(("##" + key).c_str(), here || editor.hovered == key);
    note_place(frame, "material " + label);
    if (ImGui::IsItemHovered())
        editor.hovered = key;
    if (curve)
        sample(frame, *curve, at, height);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const float mark_width = mark.empty() ? 0 : ImGui::CalcTextSize(mark.c_str()).x + 8 * s;
    draw->PushClipRect({at.x, at.y - 2}, {right - mark_width, at.y + height + 4 * s}, true);
    draw->AddText({at.x + 32 * s, at.y}, colour ? ink(*colour) : ImGui::GetColorU32(ImGuiCol_Text), label.c_str());
    draw->PopClipRect();
    if (!mark.empty())
        draw->AddText({right - mark_width + 8 * s, at.y}, ink(palette_of(frame.state.view.dark).muted), mark.c_str());
    return clicked;
}

void grade_list(Frame& frame, const Shown& shown)
{
    MaterialEditor& editor = frame.ui.materials;
    const std::vector<Grade>& grades = *frame.state.grades;
    const Palette p = palette_of(frame.state.view.dark);
    const auto choose = [&](const std::string& key) {
        editor.shown = key;
        editor.removing = false;
        editor.problem.clear();
    };
    for (const bool own : {false, true}) {
        ImGui::PushFont(frame.ui.fonts.bold);
        ImGui::TextUnformatted(own ? "Your own" : "Built in");
        ImGui::PopFont();
        bool any = false;
        for (size_t k = 0; k < grades.size(); ++k) {
            const Grade& grade = grades[k];
            if (grade.own != own)
                continue;
            any = true;
            const std::string mark = frame.state.document.material == grade.reference ? "in use"
                                     : editor.draft.contains(grade.reference)         ? "changed"
                                     : !grade.material                                ? "cannot be read"
                                                                                      : "";
            if (list_row(frame, grade.reference, grade.label(), shown.key == grade.reference,
                         grade.material ? std::optional(k) : std::nullopt, mark, grade.material ? nullptr : &p.error))
                choose(grade.reference);
            tooltip(grade.material ? grade.material->name : grade.problem);
        }
        if (own)
            for (const auto& [key, material] : editor.draft)
                if (key.starts_with(is_new)) {
                    any = true;
                    if (list_row(frame, key, material.name, shown.key == key, {}, "not saved", nullptr))
                        choose(key);
                }
        if (!any)
            muted(frame, "None yet. Copy a built-in grade, or make one from a tensile test.");
        ImGui::Dummy({0, 4 * frame.ui.scale});
    }
}

// --- the plot
void plot(Frame& frame, const Shown& shown, float height)
{
    MaterialEditor& editor = frame.ui.materials;
    const auto& grades = frame.state.grades;
    const std::vector<FlowCurve>& curves = editor.curves.of({grades}, [&] {
        std::vector<FlowCurve> made;
        for (const Grade& grade : *grades)
            made.push_back(grade.material ? flow_curve(grade.material->hardening, last_strain, pieces) : FlowCurve{});
        return made;
    });
    const bool own_line = shown.whole && (shown.changed || !shown.grade);
    const FlowCurve* mine =
        own_line ? &editor.draft_curve.of({shown.material.hardening},
                                          [&] { return flow_curve(shown.material.hardening, last_strain, pieces); })
                 : nullptr;
    double most = 100;
    for (const FlowCurve& curve : curves)
        for (const double stress : curve.stress_MPa)
            most = std::max(most, stress);
    const StressPlot axes = stress_plot(frame, height, last_strain, most, "true stress, MPa, over true plastic strain");
    const bool dark = frame.state.view.dark;
    const float s = frame.ui.scale;
    const ImVec2 mouse = ImGui::GetMousePos();
    std::optional<size_t> nearest;
    if (ImGui::IsWindowHovered() && axes.holds(mouse)) {
        float reach = 8 * s;
        for (size_t k = 0; k < curves.size(); ++k) {
            if (curves[k].strain.empty())
                continue;
            const double stress = flow_stress((*grades)[k].material->hardening, axes.strain_at(mouse.x)).stress;
            const float away = std::abs(axes.place(0, stress).y - mouse.y);
            if (away < reach) {
                reach = away;
                nearest = k;
            }
        }
    }
    const auto lit = [&](size_t k) {
        const std::string& key = (*grades)[k].reference;
        return nearest == k || (!nearest && editor.hovered == key);
    };
    const bool one_lit = nearest || (editor.hovered && *editor.hovered != shown.key);
    for (int pass = 0; pass < 2; ++pass) // those that stand out lie over the others
        for (size_t k = 0; k < curves.size(); ++k) {
            const bool chosen = (*grades)[k].reference == shown.key && !mine, out = chosen || lit(k);
            if (curves[k].strain.empty() || out != (pass == 1))
                continue;
            draw_curve(axes, curves[k],
                       line_colour(k, dark,
                                   out       ? 1.f
                                   : one_lit ? 0.35f
                                             : 0.75f),
                       (out ? 3.2f : 1.5f) * s, line_dash(k, s));
        }
    if (mine)
        draw_curve(axes, *mine, ink(palette_of(dark).accent), 3.2f * s);
    if (!nearest)
        return;
    const Grade& grade = (*grades)[*nearest];
    const double strain = axes.strain_at(mouse.x), stress = flow_stress(grade.material->hardening, strain).stress;
    ImGui::GetWindowDrawList()->AddCircleFilled(axes.place(strain, stress), 4 * s, line_colour(*nearest, dark, 1));
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(grade.material->name.c_str());
    ImGui::TextUnformatted(fmt::format("{:.0f} MPa at a plastic strain of {:.3f}", stress, strain).c_str());
    ImGui::EndTooltip();
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        editor.shown = grade.reference;
        editor.removing = false;
    }
}

void details(Frame& frame, const Shown& shown, Material& material, const std::vector<MaterialFault>& faults,
             bool& changed)
{
    MaterialEditor& editor = frame.ui.materials;
    if (!shown.whole) {
        coloured(palette_of(frame.state.view.dark).error, shown.grade ? shown.grade->problem : "");
        muted(frame, "Correct the file with a text editor, or remove it.");
        return;
    }
    if (!editor.problem.empty())
        coloured(palette_of(frame.state.view.dark).error, engine_words(frame, editor.problem));
    const GradeFigures& figures = editor.figures.of({shown.material}, [&] { return grade_figures(shown.material); });
    changed = material_fields(frame, material, shown.editable, faults, figures);
}

// --- the buttons
void copy_shown(Frame& frame, const Shown& shown)
{
    Material copy = shown.material;
    copy.name = copy_name(*frame.state.grades, copy.name);
    copy.source = "copied from " + shown.material.name + (copy.source.empty() ? "" : ": " + copy.source);
    edit_new_material(frame, std::move(copy));
}

void remove_buttons(Frame& frame, const Shown& shown)
{
    MaterialEditor& editor = frame.ui.materials;
    if (!shown.grade) {
        if (ImGui::Button("Discard")) {
            editor.draft.erase(shown.key);
            editor.shown.clear();
        }
        return;
    }
    if (shown.changed) {
        if (ImGui::Button("Undo changes"))
            editor.draft.erase(shown.key);
        ImGui::SameLine();
    }
    if (!editor.removing) {
        if (ImGui::Button("Remove..."))
            editor.removing = true;
        return;
    }
    if (coloured_button(frame, "Delete the file permanently", {0, 0}, palette_of(frame.state.view.dark).error)) {
        frame.actions.push(RemoveMaterial{shown.grade->reference});
        editor.draft.erase(shown.key);
        editor.shown.clear();
        editor.removing = false;
    }
    ImGui::SameLine();
    if (ImGui::Button("Keep it"))
        editor.removing = false;
}

void buttons(Frame& frame, const Shown& shown, bool sound)
{
    MaterialEditor& editor = frame.ui.materials;
    const Palette p = palette_of(frame.state.view.dark);
    ImGui::Separator();
    ImGui::BeginDisabled(!shown.whole);
    if (ImGui::Button("Copy as my own..."))
        copy_shown(frame, shown);
    ImGui::EndDisabled();
    note_place(frame, "copy material");
    ImGui::SameLine();
    if (ImGui::Button("From a tensile test...")) {
        editor.test_for_editor = true;
        ImGui::CloseCurrentPopup();
        choose_tensile_test(frame);
    }
    if (shown.editable) {
        ImGui::SameLine();
        remove_buttons(frame, shown);
    }
    const float s = frame.ui.scale, wide = 120 * s, gap = ImGui::GetStyle().ItemSpacing.x;
    const bool can_save = shown.editable && (shown.changed || !shown.grade);
    ImGui::SameLine();
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - 3 * wide - 2 * gap));
    if (ImGui::Button("Close", {wide, 0}) || (pressed(frame, GLFW_KEY_ESCAPE) && !frame.ui.typed))
        ImGui::CloseCurrentPopup();
    ImGui::SameLine();
    const bool in_use = shown.grade && frame.state.document.material == shown.grade->reference;
    ImGui::BeginDisabled(!shown.grade || !shown.grade->material || shown.changed || in_use);
    if (ImGui::Button(in_use ? "In use" : "Use for this part", {wide, 0}))
        frame.actions.push(SetMaterial{shown.grade->reference});
    ImGui::EndDisabled();
    if (shown.changed || !shown.grade)
        tooltip("Save it first");
    note_place(frame, "use material");
    ImGui::SameLine();
    ImGui::BeginDisabled(!can_save || !sound);
    if (coloured_button(frame, "Save", {wide, 0}, p.accent)) {
        editor.saving = shown.key;
        editor.saved_as = (own_materials() / (stem_for(shown.material.name) + ".json")).string();
        frame.actions.push(SaveMaterial{shown.material, shown.grade ? shown.grade->reference : ""});
    }
    ImGui::EndDisabled();
    note_place(frame, "save material");
    if (!shown.editable)
        tooltip("Built-in grades cannot be changed: copy one as your own");
    else if (can_save && !sound)
        tooltip("Correct what is marked red first");
}

/// A draft that has become a file is none any more.
void follow_saving(Frame& frame)
{
    MaterialEditor& editor = frame.ui.materials;
    if (editor.saving.empty())
        return;
    const Grade* saved = grade_called(*frame.state.grades, editor.saved_as);
    const auto draft = editor.draft.find(editor.saving);
    if (saved && saved->material && draft != editor.draft.end() && *saved->material == draft->second) {
        editor.draft.erase(draft);
        editor.shown = editor.saved_as;
        editor.saving.clear();
    }
}

} // namespace

void open_material_editor(Frame& frame, std::string shown)
{
    frame.ui.materials.shown = std::move(shown);
    frame.ui.materials.removing = false;
    frame.ui.materials.appears = true;
}

void edit_new_material(Frame& frame, Material material)
{
    MaterialEditor& editor = frame.ui.materials;
    std::string key = std::string(is_new) + material.name;
    for (int k = 2; editor.draft.contains(key); ++k)
        key = fmt::format("{}{} {}", is_new, material.name, k);
    editor.shown = key;
    editor.removing = false;
    editor.problem.clear();
    editor.draft[key] = std::move(material);
}

void take_limit_curve(Frame& frame, const std::filesystem::path& file)
{
    MaterialEditor& editor = frame.ui.materials;
    editor.appears = true;
    editor.problem.clear();
    try {
        const FormingLimitCurve curve = read_forming_limit_curve(file);
        Shown shown = shown_grade(frame);
        shown.material.limit = {};
        for (size_t k = 0; k < curve.minor.size(); ++k) {
            shown.material.limit.minor.push_back(engineering_strain(curve.minor[k]));
            shown.material.limit.major.push_back(engineering_strain(curve.major[k]));
        }
        if (shown.editable)
            editor.draft[shown.key] = shown.material;
    } catch (const std::exception& error) {
        editor.problem = error.what();
    }
}

void material_editor(Frame& frame)
{
    MaterialEditor& editor = frame.ui.materials;
    follow_saving(frame);
    const bool appears = std::exchange(editor.appears, false);
    if (!begin_dialog(frame, "Materials", appears, 1200))
        return;
    const float s = frame.ui.scale, row = ImGui::GetFrameHeightWithSpacing();
    const float height = std::min(760 * s, ImGui::GetIO().DisplaySize.y - 150 * s) - row;
    const Shown shown = shown_grade(frame);
    const std::optional<std::string> hovered = std::exchange(editor.hovered, std::nullopt);
    ImGui::BeginChild("grades", {250 * s, height}, true);
    editor.hovered = hovered; // rows are marked by what was hovered before, and say anew what is
    const ImVec2 mouse = ImGui::GetMousePos();
    const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    if (mouse.x < from.x || mouse.x > from.x + size.x || mouse.y < from.y || mouse.y > from.y + size.y)
        editor.hovered.reset();
    grade_list(frame, shown);
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginGroup();
    const float plot_height = 0.40f * height;
    plot(frame, shown, plot_height);
    ImGui::BeginChild("details", {0, height - plot_height - ImGui::GetStyle().ItemSpacing.y}, true);
    Material edited = shown.material;
    bool changed = false;
    const std::string replaces = shown.grade ? shown.grade->reference : "";
    const std::vector<MaterialFault> none;
    const std::vector<MaterialFault>& faults =
        shown.editable && shown.whole
            ? editor.faults.of({frame.state.grades, shown.material, replaces},
                               [&] { return faults_to_save(*frame.state.grades, shown.material, replaces); })
            : none;
    details(frame, shown, edited, faults, changed);
    ImGui::EndChild();
    ImGui::EndGroup();
    if (changed) {
        if (shown.grade && shown.grade->material == edited)
            editor.draft.erase(shown.key);
        else
            editor.draft[shown.key] = edited;
    }
    buttons(frame, shown, faults.empty());
    end_dialog();
}

} // namespace spia::viewer
