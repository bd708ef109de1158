#include "app/viewer/panels/steps/patch_list.h"

#include <algorithm>
#include <fmt/core.h>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "app/viewer/panels/option_fields.h"
#include "engine/mesh/closest_point.h"
#include "engine/report/figures/figures.h"
#include "engine/report/text/lengths.h"

namespace spia::viewer {
namespace {

struct PatchColumn {
    PatchMeasure measure;
    const char* name;
    const char* meaning;
};
constexpr PatchColumn patch_columns[] = {
    {PatchMeasure::number, "No.", "Number of the patch in files and reports"},
    {PatchMeasure::least_scaled, "Least", "Least scaled Jacobian: 1 at right angles, 0 where a cell has collapsed"},
    {PatchMeasure::mean_scaled, "Mean", "Mean scaled Jacobian: 1 is best"},
    {PatchMeasure::deviation, "Off", "Greatest deviation from the part"},
    {PatchMeasure::control_points, "Points", "Control points, with those that it shares with its neighbours"}};

/// Headers that say what they are; a click orders the patches by one.
/// @returns what they are ordered by, and whether the best comes first
std::pair<PatchMeasure, bool> patch_headers(Frame& frame)
{
    for (const PatchColumn& column : patch_columns) {
        const bool first = column.measure == PatchMeasure::least_scaled;
        ImGui::TableSetupColumn(
            column.measure == PatchMeasure::deviation ? in_unit(column.name, frame.lengths()).c_str() : column.name,
            ImGuiTableColumnFlags_PreferSortAscending |
                (first ? ImGuiTableColumnFlags_DefaultSort : ImGuiTableColumnFlags_None),
            0, ImGuiID(column.measure));
    }
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (int k = 0; k < int(std::size(patch_columns)); ++k) {
        ImGui::TableSetColumnIndex(k);
        ImGui::TableHeader(ImGui::TableGetColumnName(k));
        tooltip(patch_columns[k].meaning);
    }
    const ImGuiTableSortSpecs* sort = ImGui::TableGetSortSpecs();
    if (!sort || sort->SpecsCount == 0)
        return {PatchMeasure::least_scaled, false};
    return {PatchMeasure(sort->Specs[0].ColumnUserID), sort->Specs[0].SortDirection == ImGuiSortDirection_Descending};
}

/// Where a patch is worst by what the list is ordered by.
FlyTo worst_place(const Frame& frame, const PatchFigures& patch, const PatchCertificate& proved, PatchMeasure measure)
{
    const ClosestPointSearch search(frame.state.document.session.part->mesh);
    if (measure == PatchMeasure::deviation)
        return {search.nearest(patch.deviation.where).face, Field::deviation};
    const PatchPlace& place = proved.refusal ? proved.refusal->place : proved.least_scaled_at;
    return {search.nearest(place.position).face};
}

void patch_row(Frame& frame, const PatchFigures& patch, const PatchCertificate& proved, double tolerance,
               PatchMeasure measure)
{
    const auto cell = [&](const std::string& text, bool poor = false) {
        ImGui::TableNextColumn();
        if (poor)
            ImGui::TextColored(palette_of(frame.state.view.dark).warning, "%s", text.c_str());
        else
            ImGui::TextUnformatted(text.c_str());
    };
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable(fmt::format("{}##{}", patch.patch + 1, patch.patch).c_str(), false,
                          ImGuiSelectableFlags_SpanAllColumns))
        frame.actions.push(worst_place(frame, patch, proved, measure));
    tooltip(proved.refusal ? engine_words(frame, describe(*proved.refusal))
                           : fmt::format("Click to zoom to {} in all views; Escape goes back",
                                         measure == PatchMeasure::deviation ? "where it is farthest from the part"
                                                                            : "its sharpest cell"));
    cell(patch.refused ? "may fold" : fmt::format("{:.3f}", patch.least_scaled), patch.refused);
    cell(fmt::format("{:.3f}", patch.mean_scaled));
    const double off = patch.deviation.max / millimetres(frame.lengths());
    cell(fmt::format("{:.3g}", off), patch.deviation.max > tolerance);
    cell(fmt::format("{}", patch.control_points));
}

} // namespace

void patch_list(Frame& frame, const SurfaceStage& surface, const Certificate& certificate)
{
    if (!surface.patches || certificate.patch.size() < 2 || !ImGui::CollapsingHeader("Patches, worst first"))
        return;
    constexpr size_t most_rows = 8; // else it scrolls
    const size_t shown = std::min(certificate.patch.size(), most_rows);
    const float row = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
    ImGui::PushFont(frame.ui.fonts.small);
    const ImGuiTableFlags flags =
        ImGuiTableFlags_Sortable | ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg;
    if (ImGui::BeginTable("patches", int(std::size(patch_columns)), flags, {0, row * float(shown + 1)})) {
        const auto [measure, best_first] = patch_headers(frame);
        std::vector<PatchFigures> patches = worst_first(patch_figures(*surface.patches, certificate), measure);
        if (best_first)
            std::ranges::reverse(patches);
        ImGuiListClipper rows;
        rows.Begin(int(patches.size()));
        while (rows.Step())
            for (int k = rows.DisplayStart; k < rows.DisplayEnd; ++k) {
                const PatchFigures& patch = patches[size_t(k)];
                patch_row(frame, patch, certificate.patch[patch.patch],
                          surface.fit ? surface.fit->tolerance : std::numeric_limits<double>::infinity(), measure);
            }
        ImGui::EndTable();
    }
    ImGui::PopFont();
}

} // namespace spia::viewer
