#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/panels/steps/step_parts.h"

namespace spia::viewer {
namespace {

/// A row of three numbers with its name.
bool place_row(Frame& frame, const char* label, Eigen::Vector3d& v)
{
    ImGui::SetNextItemWidth(190 * frame.ui.scale);
    return typed_numbers(frame, label, v.data(), 3, "%.4g");
}

/// Likewise of a place.
bool length_row(Frame& frame, const char* label, Eigen::Vector3d& v)
{
    ImGui::SetNextItemWidth(190 * frame.ui.scale);
    return length_inputs(frame, label, v.data(), 3, frame.lengths(), {});
}

/// The numbers of a target of one's own.
bool target_numbers(Frame& frame, StepTarget& target)
{
    const float width = 86 * frame.ui.scale;
    bool changed = false;
    if (target.plane) {
        changed |= length_row(frame, "Through", target.plane->origin);
        Eigen::Vector3d normal = target.plane->normal;
        if (place_row(frame, "Normal", normal) && normal.norm() > 0) {
            target.plane->normal = normal;
            changed = true;
        }
    } else if (target.cylinder) {
        changed |= length_row(frame, "On axis", target.cylinder->origin);
        Eigen::Vector3d axis = target.cylinder->axis;
        if (place_row(frame, "Axis", axis) && axis.norm() > 0) {
            target.cylinder->axis = axis;
            changed = true;
        }
        ImGui::SetNextItemWidth(width);
        changed |= length_input(frame, "Radius", target.cylinder->radius, {.mm = "%.5g"});
        target.cylinder->radius = std::max(1e-6, target.cylinder->radius);
    } else if (target.cone) {
        changed |= length_row(frame, "Apex", target.cone->apex);
        Eigen::Vector3d axis = target.cone->axis;
        if (place_row(frame, "Axis", axis) && axis.norm() > 0) {
            target.cone->axis = axis;
            changed = true;
        }
        ImGui::SetNextItemWidth(width);
        changed |= typed_number(frame, "Half angle, \u00b0", target.cone->half_angle_deg, "%.5g");
        target.cone->half_angle_deg = std::clamp(target.cone->half_angle_deg, 1e-3, 89.999);
    }
    return changed;
}

/// The face onto which a step lays: fitted, or by numbers, or from what is selected. @returns
/// whether `edited` has changed
bool target_editor(Frame& frame, int number, ChangeStep& edited)
{
    const Document& document = frame.state.document;
    const PlannedStep& step = *document.steps[size_t(number)];
    StepTarget target = numbers_of(step);
    static constexpr const char* names[] = {"fitted to the fixed faces", "plane", "cylinder", "cone"};
    const int now = int(kind_of(target));
    int wanted = now;
    bool changed = false;
    wide_item("Target");
    if (ImGui::Combo("Target", &wanted, names, 4) && wanted != now) {
        const double before = double(std::min(size_t(number), steps_done(document)));
        target = suggested_target(TargetKind(wanted),
                                  {unfolded_places(document, before), document.session.part->mesh.triangle}, step);
        changed = true;
    }
    note_place(frame, "target");
    tooltip("Target surface onto which the faces are unfolded, translucent in the view");
    changed |= target_numbers(frame, target);
    if (changed)
        edited.target = target;
    const bool nothing = document.selected.empty();
    ImGui::BeginDisabled(nothing);
    if (small_button(frame, "Plane of selection"))
        frame.actions.push(SetTargetPlane{number, {}});
    ImGui::EndDisabled();
    tooltip(nothing ? "Select faces first; the target becomes the plane through them"
                    : "The target becomes the plane through the selected faces");
    ImGui::SameLine();
    ImGui::BeginDisabled(nothing);
    if (small_button(frame, "Fit to selection"))
        frame.actions.push(SetCarrying{number, {}});
    ImGui::EndDisabled();
    tooltip(nothing ? "Select fixed faces first; the target is fitted to them"
                    : "Fits the target to the selected faces, which stay fixed");
    return changed;
}

/// What the target rubs. @returns whether it has changed
bool friction_editor(Frame& frame, std::optional<StepFriction>& friction)
{
    bool rubs = friction.has_value(), changed = false;
    if (ImGui::Checkbox("Friction on the target", &rubs)) {
        friction = rubs ? std::optional(StepFriction{.pressure_MPa = 1}) : std::nullopt;
        changed = true;
    }
    tooltip("Friction between sheet and target during forming");
    if (!friction)
        return changed;
    const float width = 86 * frame.ui.scale;
    int by_pressure = friction->pressure_MPa.has_value();
    double amount = by_pressure ? *friction->pressure_MPa : *friction->force_N / 1000;
    ImGui::SetNextItemWidth(width);
    bool other_amount = typed_number(frame, "##amount", amount, "%.4g");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    other_amount |= ImGui::Combo("##unit", &by_pressure, "kN\0MPa\0");
    tooltip("kN: total force normal to the target. MPa: pressure on the sheet.");
    ImGui::SetNextItemWidth(width);
    changed |= typed_number(frame, "Coefficient", friction->friction, "%.3g");
    tooltip("Coulomb friction coefficient per side");
    bool both = friction->sides == 2;
    changed |= ImGui::Checkbox("On both sides", &both);
    tooltip("A pad on the other side adds its friction");
    friction->sides = both ? 2 : 1;
    friction->friction = std::clamp(friction->friction, 0., 10.);
    if (other_amount) { // else it stays to the last digit: kN and back does not
        amount = std::clamp(amount, 1e-6, 1e5);
        friction->force_N = by_pressure ? std::nullopt : std::optional(1000 * amount);
        friction->pressure_MPa = by_pressure ? std::optional(amount) : std::nullopt;
    }
    return changed || other_amount;
}

std::string own_name(const std::string& name) { return name; }

/// A region to choose, or something else (-1) that has a name of its own.
void region_combo(Frame& frame, const char* label, int& chosen, const std::string& other,
                  std::string (*words)(const std::string&))
{
    const Document& document = frame.state.document;
    const int first = other.empty() ? 0 : -1;
    const auto text = [&](int k) { return k < 0 ? other : words(document.regions[size_t(k)].name); };
    chosen = std::clamp(chosen, first, int(document.regions.size()) - 1);
    wide_item(label);
    if (!ImGui::BeginCombo(label, text(chosen).c_str()))
        return;
    for (int k = first; k < int(document.regions.size()); ++k) {
        ImGui::PushID(k);
        if (ImGui::Selectable(text(k).c_str(), k == chosen))
            chosen = k;
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

bool extent_editor(Frame& frame, std::optional<double>& extent_mm, float width)
{
    double length = extent_mm.value_or(0);
    ImGui::SetNextItemWidth(width);
    const bool changed = length_input(frame, "Extent", length);
    if (changed)
        extent_mm = length > 0 ? std::optional(length) : std::nullopt;
    tooltip(
        "How far the target extends beyond the yellow faces. 0: as far as the sheet. Faces that end up beyond it are reported.");
    return changed;
}

} // namespace

void step_editor(Frame& frame, int number)
{
    const PlannedStep& step = *frame.state.document.steps[size_t(number)];
    ChangeStep edited = ChangeStep::unchanged(number, step);
    ImGui::SetNextItemWidth(-1);
    bool changed = typed_text(frame, "##name", edited.name, "name");
    const float width = 86 * frame.ui.scale;
    if (step.kind == UnfoldKind::lay) {
        changed |= target_editor(frame, number, edited);
        ImGui::SetNextItemWidth(width);
        changed |= length_input(frame, "Offset", edited.offset_mm);
        tooltip("Shifts the target towards its outer side");
        if (!step.pick.target) {
            ImGui::SetNextItemWidth(width);
            changed |= length_input(frame, "Within", edited.within_mm);
            edited.within_mm = std::max(0., edited.within_mm);
            tooltip(
                "Allowed distance of the yellow faces from the fitted plane, cylinder or cone. 0: automatic; if none fits, a smooth surface through them is used.");
        }
        if (!carrying_faces(step).empty())
            changed |= extent_editor(frame, edited.extent_mm, width);
        changed |= friction_editor(frame, edited.friction);
    }
    if (step.kind != UnfoldKind::unroll) {
        double tolerance = edited.tolerance.value_or(FlattenOptions{}.tolerance);
        ImGui::SetNextItemWidth(width);
        if (typed_number(frame, "Tolerance", tolerance, "%.1e")) {
            edited.tolerance = std::clamp(tolerance, least_step_tolerance, most_step_tolerance);
            changed = true;
        }
        tooltip("Convergence tolerance of the solver; a larger value accepts a step that nearly converges");
    }
    if (changed)
        frame.actions.push(edited);
    const int last = int(frame.state.document.steps.size()) - 1;
    ImGui::BeginDisabled(number == 0);
    if (small_button(frame, "Up"))
        frame.actions.push(MoveStep{number, number - 1});
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(number == last);
    if (small_button(frame, "Down"))
        frame.actions.push(MoveStep{number, number + 1});
    note_place(frame, "down");
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (small_button(frame, "Remove"))
        frame.actions.push(RemoveStep{number});
    ImGui::SameLine();
    if (small_button(frame, "Select faces"))
        frame.actions.push(SelectFaces{step.pick.freed});
    tooltip("Selects the moving faces of this step");
}

void new_step(Frame& frame)
{
    const Document& document = frame.state.document;
    if (!ImGui::TreeNodeEx("Add a step", ImGuiTreeNodeFlags_NoTreePushOnOpen))
        return;
    if (document.regions.empty())
        return muted(frame,
                     "Make a region of the fixed faces (below), then select the faces to unfold onto their surface.");
    Ui& ui = frame.ui;
    region_combo(frame, "stays", ui.step_fixed, "", own_name);
    tooltip("Fixed region; its plane, cylinder, cone or smooth surface is the target");
    region_combo(frame, "unfolds", ui.step_freed, fmt::format("{} selected", document.selected.size()), own_name);
    tooltip("Moving faces, including the bend between them");
    region_combo(frame, "onto", ui.step_onto, "surface of the fixed region",
                 [](const std::string& name) { return fmt::format("plane of {}", name); });
    tooltip(
        "Target: fitted to the fixed region, or the plane through another region. Numbers can be given once the step is in the list.");
    const bool nothing = ui.step_freed < 0 && document.selected.empty();
    ImGui::BeginDisabled(nothing || ui.step_fixed == ui.step_freed);
    if (ImGui::Button("Add step", {-1, 0}))
        frame.actions.push(AddStep{ui.step_fixed,
                                   ui.step_freed < 0 ? std::nullopt : std::optional(ui.step_freed),
                                   {},
                                   {},
                                   ui.step_onto < 0 ? std::nullopt : std::optional(ui.step_onto)});
    ImGui::EndDisabled();
    if (nothing)
        muted(frame, "Select the faces to unfold.");
}

} // namespace spia::viewer
