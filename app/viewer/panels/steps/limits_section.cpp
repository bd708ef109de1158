#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/option_fields.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"
#include "engine/core/text.h"
#include "engine/options/sheet_options.h"
#include "engine/report/figures/face_values.h"
#include "engine/report/text/number_text.h"
#include "engine/report/text/sentence.h"
#include "engine/report/text/zone_look.h"

namespace spia::viewer {
namespace {

using Source = LimitsOptions::Source;

/// Where the curve comes from.
void curve_input(Frame& frame, LimitsChoice& choice)
{
    constexpr std::pair<Source, const char*> sources[] = {{Source::automatic, "Curve: of the material"},
                                                          {Source::keeler_brazier, "Curve: Keeler-Brazier"},
                                                          {Source::points, "Curve: from a table..."},
                                                          {Source::none, "No curve"}};
    const auto now = std::find_if(std::begin(sources), std::end(sources),
                                  [&](const auto& each) { return each.first == choice.curve; });
    const std::string shown =
        choice.curve == Source::points ? "Curve: " + choice.table.filename().string() : std::string(now->second);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##curve", shown.c_str())) {
        for (const auto& [source, label] : sources)
            if (ImGui::Selectable(label, source == choice.curve)) {
                if (source == Source::points)
                    frame.ui.files.open(FileDialog::Purpose::open_limit_curve, choice.table);
                else
                    choice.curve = source;
            }
        ImGui::EndCombo();
    }
    tooltip(
        "Of the material: its own points where it has some, else Keeler-Brazier (from thickness and n) for steel and none for other "
        "metals. A table has two columns, minor and major strain; its heading says engineering or true.");
}

/// A share that is typed in percent. @returns whether it was changed
bool percent_input(Frame& frame, const char* label, double& share, const std::string& help)
{
    double percent = 100 * share;
    ImGui::SetNextItemWidth(86 * frame.ui.scale);
    const bool changed = typed_number(frame, label, percent, "%.4g %%");
    tooltip(help);
    if (!changed)
        return false;
    share = std::clamp(percent / 100, 0., 1.);
    return true;
}

void percent_input(Frame& frame, const Option& option, double& share)
{
    percent_input(frame, std::string(option.label).c_str(), share, help_text(option));
}

void settings(Frame& frame)
{
    const Document& document = frame.state.document;
    LimitsChoice choice = document.limits;
    curve_input(frame, choice);
    const auto& limits = document.session.limits;
    if (choice.curve == Source::keeler_brazier || (choice.curve == Source::automatic && limits && limits->curve)) {
        double n = choice.n.value_or(0);
        ImGui::SetNextItemWidth(86 * frame.ui.scale);
        if (typed_number(frame, "Hardening exponent n", n, choice.n ? "%.4g" : "of material"))
            choice.n = n > 0 ? std::optional(std::min(n, 1.)) : std::nullopt;
        tooltip("For the curve of Keeler-Brazier; 0: that of the material");
    }
    double margin = choice.margin.value_or(limits ? limits->settings.margin : ZoneOptions{}.margin);
    if (percent_input(
            frame, "Required margin", margin,
            "Safety margin below the curve, in percentage points of engineering major strain. Faces with less are "
            "marginal, with less than half of it at risk."))
        choice.margin = margin;
    percent_input(frame, option::max_thinning, choice.max_thinning);
    percent_input(frame, option::max_thickening, choice.max_thickening);
    percent_input(frame, "Low strain below", choice.low_strain,
                  "Engineering strain; faces with both principal strains below it are hardly stretched");
    if (!(choice == document.limits))
        frame.actions.push(SetLimits{choice});
}

/// A row per zone that has faces; a click selects them.
void zone_rows(Frame& frame, const LimitsResult& limits)
{
    const float side = ImGui::GetTextLineHeight();
    for (const Zone zone : all_zones) {
        const ZoneShare& share = limits.zones.share[size_t(zone)];
        if (share.faces == 0)
            continue;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const std::string figures =
            fmt::format("{:.1f} %   {} {}", 100 * share.share, share.faces, share.faces == 1 ? "face" : "faces");
        ImGui::PushID(int(zone));
        if (ImGui::Selectable("##zone", false)) {
            std::vector<int> faces;
            for (size_t f = 0; f < limits.zones.zone.size(); ++f)
                if (limits.zones.zone[f] == zone)
                    faces.push_back(int(f));
            frame.actions.push(SelectFaces{std::move(faces), pick_mode()});
        }
        ImGui::PopID();
        tooltip(fmt::format("{}: {}. Share of the area and number of faces; click to select them.", zone_words(zone),
                            definition(zone, limits.settings)));
        ImDrawList* draw = ImGui::GetWindowDrawList();
        draw->AddRectFilled({at.x, at.y + 1}, {at.x + side - 2, at.y + side - 1}, ink(zone_colour(zone)), 2);
        const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text);
        draw->AddText({at.x + side + 6 * frame.ui.scale, at.y}, text, zone_words(zone).c_str());
        const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
        draw->AddText({right - ImGui::CalcTextSize(figures.c_str()).x, at.y}, text, figures.c_str());
    }
}

/// What is left up to the curve and what the sheet became thinner by are two things: a column each.
void spots(Frame& frame, const LimitsResult& limits)
{
    constexpr size_t most = 6;
    if (limits.zones.spots.empty())
        return;
    const float number = ImGui::CalcTextSize("-88.8 %").x;
    if (!ImGui::BeginTable("spots", 3, ImGuiTableFlags_SizingFixedFit))
        return;
    ImGui::TableSetupColumn("spot", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("margin", ImGuiTableColumnFlags_WidthFixed,
                            std::max(number, ImGui::CalcTextSize("margin").x));
    ImGui::TableSetupColumn("thinning", ImGuiTableColumnFlags_WidthFixed,
                            std::max(number, ImGui::CalcTextSize("thinning").x));
    ImGui::TableNextColumn();
    ImGui::TextDisabled("Worst spots");
    ImGui::TableNextColumn();
    right_aligned("margin", true);
    tooltip("Margin below the forming limit curve, in percentage points of engineering major strain; below 0 the sheet "
            "cracks");
    ImGui::TableNextColumn();
    right_aligned("thinning", true);
    tooltip("Negative: thicker than before");
    for (size_t k = 0; k < std::min(most, limits.zones.spots.size()); ++k) {
        const WorstSpot& spot = limits.zones.spots[k];
        const auto margin = margin_of(limits, spot.face);
        const bool here = frame.state.spot && frame.state.spot->face == spot.face;
        ImGui::TableNextColumn();
        if (ImGui::Selectable(fmt::format("{}.  {}##spot{}", k + 1, zone_words(spot.zone), spot.face).c_str(), here,
                              ImGuiSelectableFlags_SpanAllColumns))
            frame.actions.push(FlyTo{spot.face});
        const Eigen::Vector3d at = spot.position / millimetres(frame.lengths());
        const ShownUnit area = as_shown("mm\u00b2", frame.lengths());
        tooltip(fmt::format(
            "Face {} at {:.4g}, {:.4g}, {:.4g} {}: major strain {:.3f}, minor {:.3f}, thinning {} %. The worst "
            "of a region of {}, {:.4g} {}. Click to look at it.",
            spot.face, at[0], at[1], at[2], length_word(frame.lengths()), spot.strain_major, spot.strain_minor,
            figure_text(100 * spot.thinning, 1), counted(spot.region_faces, "face", "faces"),
            area.factor * spot.region_area_mm2, area.unit));
        ImGui::TableNextColumn();
        right_aligned(margin ? figure_text(100 * *margin, 1) + " %" : "-");
        ImGui::TableNextColumn();
        right_aligned(figure_text(100 * spot.thinning, 1) + " %");
    }
    ImGui::EndTable();
}

} // namespace

void limits_section(Frame& frame)
{
    const Session& session = frame.state.document.session;
    const bool open = ImGui::CollapsingHeader("Forming limits", ImGuiTreeNodeFlags_DefaultOpen);
    tooltip("Zones of cracking, risk of cracking, excessive thinning or thickening, wrinkling tendency and low strain");
    if (!open)
        return;
    settings(frame);
    if (!session.limits)
        return;
    const LimitsResult& limits = *session.limits;
    if (limits.curve) {
        figure(frame, "Limit at plane strain",
               fmt::format("{:.1f} %", 100 * engineering_strain(limits.curve->at_plane_strain())));
        tooltip("FLC0: engineering major strain at the onset of necking in plane strain (minor strain 0)");
    }
    for (const std::string& note : limits.notes)
        muted(frame, as_sentence(engine_words(frame, note)));
    zone_rows(frame, limits);
    const FieldDisplay& display = frame.state.document.display;
    if (display.field != Field::zone && small_button(frame, "Colour the zones"))
        frame.actions.push(SetDisplay{with_field(display, Field::zone, frame.state.preferences.map)});
    spots(frame, limits);
}

} // namespace spia::viewer
