#include <GLFW/glfw3.h>
#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/document/grades.h"
#include "app/viewer/model/reports/viewer_words.h"
#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"
#include "engine/core/text.h"

namespace spia::viewer {
namespace {

constexpr const char* kinds[] = {"fixed", "binder", "pad", "punch", "material", "other"};

/// What a binder or a pad presses with until it is told: the blank holder's usual pressure on
/// steel. [Schuler, Metal Forming Handbook, Springer 1998, 4.2.1: 2.5 N/mm2]
constexpr double usual_pressure_MPa = 2.5;

/// A tool that presses does so at once: a region that is called a binder and does nothing would be
/// believed to hold the sheet.
void press_as_usual(Frame& frame, int number, RegionKind kind)
{
    if (kind == RegionKind::binder || kind == RegionKind::pad)
        frame.actions.push(SetContact{number, ToolContact{.pressure_MPa = usual_pressure_MPa}});
}

/// What the tool presses with.
void contact_inputs(Frame& frame, int number, const FaceRegion& region)
{
    std::optional<ToolContact> contact = region.contact;
    bool presses = contact.has_value(), changed = false;
    if (ImGui::Checkbox("Presses on the sheet", &presses)) {
        contact = presses ? std::optional(ToolContact{.pressure_MPa = usual_pressure_MPa}) : std::nullopt;
        changed = true;
    }
    tooltip(region.kind == RegionKind::binder ? "Friction on both sides of the sheet"
                                              : "Friction on one side of the sheet");
    if (contact) {
        const float width = 86 * frame.ui.scale;
        if (frame.ui.edited_region && std::exchange(frame.ui.edited_region->asks_force, false))
            ImGui::SetKeyboardFocusHere();
        int by_pressure = contact->pressure_MPa.has_value();
        double amount = by_pressure ? *contact->pressure_MPa : *contact->force_N / 1000;
        ImGui::SetNextItemWidth(width);
        changed |= typed_number(frame, "##amount", amount, "%.4g");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(width);
        changed |= ImGui::Combo("##unit", &by_pressure, "kN\0MPa\0");
        tooltip("kN: total force along the stamping direction. MPa: pressure on the faces.");
        ImGui::SetNextItemWidth(width);
        changed |= typed_number(frame, "Friction", contact->friction, "%.3g");
        tooltip("Coulomb friction coefficient per side");
        amount = std::clamp(amount, 1e-6, 1e5);
        contact->friction = std::clamp(contact->friction, 0., 10.);
        contact->force_N = by_pressure ? std::nullopt : std::optional(1000 * amount);
        contact->pressure_MPa = by_pressure ? std::optional(amount) : std::nullopt;
    }
    if (changed)
        frame.actions.push(SetContact{number, contact});
}

/// Grade and gauge of a piece of a tailored blank.
void sheet_inputs(Frame& frame, int number, const FaceRegion& region)
{
    const Document& document = frame.state.document;
    std::optional<OwnSheet> sheet = region.sheet;
    bool own = sheet.has_value(), changed = false;
    if (ImGui::Checkbox("Different sheet (tailored blank)", &own)) {
        sheet =
            own ? std::optional(OwnSheet{document.material, document.session.options.flatten.thickness}) : std::nullopt;
        changed = true;
    }
    tooltip("Another thickness or grade in this region, as in a tailored blank");
    if (sheet) {
        ImGui::SetNextItemWidth(-1);
        if (ImGui::BeginCombo("##grade", std::filesystem::path(sheet->material).filename().c_str())) {
            for (const Grade& grade : *frame.state.grades)
                if (grade.material && ImGui::Selectable(fmt::format("{}##{}", grade.label(), grade.reference).c_str(),
                                                        grade.reference == sheet->material)) {
                    sheet->material = grade.reference;
                    changed = true;
                }
            ImGui::EndCombo();
        }
        ImGui::SetNextItemWidth(86 * frame.ui.scale);
        changed |= length_input(frame, "Thickness", sheet->thickness);
        sheet->thickness = std::clamp(sheet->thickness, 1e-3, 1e3);
    }
    if (changed)
        frame.actions.push(SetOwnSheet{number, sheet});
}

/// Name and kind of a region, to be changed in its row.
void edit_region(Frame& frame, int number, const FaceRegion& region)
{
    EditedRegion& edited = *frame.ui.edited_region;
    if (edited.name.empty() && !ImGui::IsAnyItemActive())
        edited.name = region.name;
    const float gap = 4 * frame.ui.scale, done = ImGui::CalcTextSize("ok").x + 2 * ImGui::GetStyle().FramePadding.x,
                kind_width =
                    ImGui::CalcTextSize("material").x + 2 * ImGui::GetStyle().FramePadding.x + ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(
        std::max(40 * frame.ui.scale, ImGui::GetContentRegionAvail().x - done - kind_width - 2 * gap));
    if (std::exchange(edited.appears, false))
        ImGui::SetKeyboardFocusHere();
    text_input("##name", edited.name, false, "name");
    const bool leaves = pressed(frame, GLFW_KEY_ESCAPE), takes = enter_pressed(frame);
    if (!leaves && (ImGui::IsItemDeactivatedAfterEdit() || takes) && !edited.name.empty() && edited.name != region.name)
        frame.actions.push(ChangeRegion{number, edited.name, region.kind, region.colour});
    ImGui::SameLine(0, gap);
    int kind = int(region.kind);
    ImGui::SetNextItemWidth(kind_width);
    if (ImGui::Combo("##kind", &kind, kinds, int(std::size(kinds)))) {
        frame.actions.push(
            ChangeRegion{number, edited.name.empty() ? region.name : edited.name, RegionKind(kind), region.colour});
        if (!region.contact)
            press_as_usual(frame, number, RegionKind(kind));
        edited.asks_force = is_tool(RegionKind(kind));
    }
    ImGui::SameLine(0, gap);
    const bool ends = ImGui::Button("ok") || leaves || takes;
    if (is_tool(region.kind))
        contact_inputs(frame, number, region);
    else if (region.kind == RegionKind::material)
        sheet_inputs(frame, number, region);
    if (ends)
        frame.ui.edited_region.reset();
}

void region_row(Frame& frame, int number, const FaceRegion& region)
{
    Colour colour = region.colour;
    if (ImGui::ColorEdit3("##colour", colour.data(), ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel))
        frame.actions.push(ChangeRegion{number, region.name, region.kind, colour});
    ImGui::SameLine();
    if (frame.ui.edited_region && frame.ui.edited_region->region == number)
        return edit_region(frame, number, region);
    const ImGuiStyle& style = ImGui::GetStyle();
    const float buttons =
        ImGui::CalcTextSize("edit").x + ImGui::CalcTextSize("x").x + 4 * style.FramePadding.x + 2 * style.ItemSpacing.x;
    const float row = std::max(20 * frame.ui.scale, ImGui::GetContentRegionAvail().x - buttons);
    const std::string label = fmt::format("{}  ({}, {})##row", region.name, kinds[int(region.kind)],
                                          counted(region.faces.size(), "face", "faces"));
    bool edit = false;
    ImGui::AlignTextToFramePadding();
    if (ImGui::Selectable(label.c_str(), false, ImGuiSelectableFlags_AllowDoubleClick, {row, 0})) {
        edit = ImGui::IsMouseDoubleClicked(0);
        if (!edit)
            frame.actions.push(SelectRegion{number, ImGui::GetIO().KeyShift ? PickMode::add : PickMode::replace});
    }
    tooltip(fmt::format("{}: {} region of {}. Click to select them, double-click to change name and kind.", region.name,
                        name(region.kind), counted(region.faces.size(), "face", "faces")));
    ImGui::SameLine();
    edit |= ImGui::Button("edit");
    tooltip("Change name and kind");
    ImGui::SameLine();
    if (ImGui::Button("x")) {
        frame.actions.push(RemoveRegion{number});
        frame.ui.edited_region.reset(); // the numbers of those after it change
    }
    tooltip("Remove this region; the faces are kept");
    if (edit)
        frame.ui.edited_region = edit_of(frame.state.document, number);
    if (const std::string load = load_words(region, frame.lengths()); !load.empty()) {
        ImGui::Indent(ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x);
        muted(frame, load);
        ImGui::Unindent(ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x);
    }
}

} // namespace

void make_region(Frame& frame, const std::string& called, RegionKind kind)
{
    const Document& document = frame.state.document;
    const int number = int(document.regions.size());
    frame.actions.push(MakeRegion{called, kind});
    press_as_usual(frame, number, kind);
    if (is_tool(kind) || kind == RegionKind::material) // what it does comes next
        frame.ui.edited_region =
            EditedRegion{number, called, false, document.session.part, document.selected, is_tool(kind)};
}

void regions_section(Frame& frame)
{
    const Document& document = frame.state.document;
    if (frame.ui.edited_region && !still_there(*frame.ui.edited_region, document))
        frame.ui.edited_region.reset();
    if (!document.session.part || !ImGui::CollapsingHeader("Regions", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const Palette p = palette_of(frame.state.view.dark);
    for (size_t k = 0; k < document.regions.size(); ++k) {
        ImGui::PushID(int(k));
        region_row(frame, int(k), document.regions[k]);
        ImGui::PopID();
    }
    if (document.selected.empty()) {
        coloured(p.muted, document.regions.empty()
                              ? "Select faces with a picking tool, then make a region of them here: fixed, binder, pad."
                              : "Select faces to make another region.");
        return;
    }
    const bool made = std::any_of(document.regions.begin(), document.regions.end(),
                                  [&](const FaceRegion& region) { return region.faces == document.selected; });
    if (made)
        return coloured(p.muted, "Select other faces to make another region.");
    int kind = int(frame.ui.region_kind);
    item_for("material");
    if (ImGui::Combo("##kind", &kind, kinds, int(std::size(kinds))))
        frame.ui.region_kind = RegionKind(kind);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    text_input("##regionname", frame.ui.region_name, false, "name (optional)");
    if (ImGui::Button(("Make region of " + counted(document.selected.size(), "face", "faces")).c_str(), {-1, 0}))
        make_region(frame, std::exchange(frame.ui.region_name, ""), frame.ui.region_kind);
}

} // namespace spia::viewer
