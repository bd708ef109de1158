#include "app/viewer/panels/comparison_section.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

std::string number(const std::optional<double>& value, int decimals, bool sign = false)
{
    if (!value)
        return "-";
    const double least = 0.5 * std::pow(10., -decimals), shown = std::abs(*value) < least ? 0 : *value;
    return sign && shown != 0 ? fmt::format("{:+.{}f}", shown, decimals) : fmt::format("{:.{}f}", shown, decimals);
}

void row(const ComparedFigure& figure)
{
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted((figure.name + (figure.unit.empty() ? "" : ", " + figure.unit)).c_str());
    ImGui::TableNextColumn();
    right_aligned(number(figure.reference, figure.decimals));
    ImGui::TableNextColumn();
    right_aligned(number(figure.now, figure.decimals));
    ImGui::TableNextColumn();
    std::optional<double> difference;
    if (figure.reference && figure.now)
        difference = *figure.now - *figure.reference;
    right_aligned(number(difference, figure.decimals, true));
}

void table(Frame& frame)
{
    const ViewerState& state = frame.state;
    const Session& session = state.document.session;
    const auto& rows = frame.ui.compared.of({state.reference, session.blank, session.limits},
                                            [&] { return compared_figures(*state.reference, session); });
    ImGui::PushFont(frame.ui.fonts.small);
    if (ImGui::BeginTable("comparison", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
        for (const char* title : {"reference", "now", "difference"})
            ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthFixed);
        ImGui::TableHeadersRow();
        for (const ComparedFigure& figure : rows)
            row(in_unit(figure, frame.lengths()));
        ImGui::EndTable();
    }
    ImGui::PopFont();
}

/// The switch of the field, or why there is none.
void field_switch(Frame& frame)
{
    const ViewerState& state = frame.state;
    FieldDisplay display = state.document.display;
    const bool possible = state.differences->fields && has_difference(display.field);
    ImGui::BeginDisabled(!possible);
    const bool changed = ImGui::Checkbox("Show the difference from the reference", &display.difference);
    ImGui::EndDisabled();
    tooltip(possible                    ? "Positive where the value is higher now than in the reference"
            : state.differences->fields ? "For thickness, thinning, strains and stresses"
                                        : state.differences->none_because);
    if (!changed)
        return;
    display.range.reset(); // of other numbers
    display.map = state.preferences.map;
    frame.actions.push(SetDisplay{display});
}

} // namespace

void comparison_section(Frame& frame)
{
    const ViewerState& state = frame.state;
    if (!state.document.session.blank && !state.reference)
        return;
    if (!ImGui::CollapsingHeader("Comparison", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const char* keep_help = "Keeps this result until the program ends, to compare later runs with it. It is not saved "
                            "in the project.";
    if (!state.reference) {
        if (small_button(frame, "Keep as reference"))
            frame.actions.push(KeepReference{});
        tooltip(keep_help);
        return;
    }
    muted(frame, "Reference: " + state.reference->name);
    if (state.document.session.blank == state.reference->blank)
        muted(frame, "This result is the reference. Change material, thickness or tools and run again to compare.");
    else if (state.differences) {
        table(frame);
        if (state.differences->none_because.empty())
            figure(frame, "Outlines differ by up to",
                   fixed_length(state.differences->outline_distance, frame.lengths(), 2));
        else
            muted(frame, state.differences->none_because);
        field_switch(frame);
    }
    ImGui::BeginDisabled(!state.document.session.blank);
    if (small_button(frame, "Replace by this result"))
        frame.actions.push(KeepReference{});
    ImGui::EndDisabled();
    tooltip(keep_help);
    ImGui::SameLine();
    if (small_button(frame, "Remove reference"))
        frame.actions.push(DropReference{});
    tooltip("The current result is kept as reference");
}

} // namespace spia::viewer
