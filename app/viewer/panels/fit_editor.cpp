#include "app/viewer/panels/fit_editor.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/chain.h"
#include "app/viewer/model/fit_cost.h"
#include "app/viewer/model/lights.h"
#include "app/viewer/model/viewer_words.h"

namespace spia::viewer {

void fit_editor(Frame& frame, FitChoice fit)
{
    const float width = 150 * frame.ui.scale;
    const bool patches = frame.state.document.session.options.patches.has_value();
    bool changed = false;
    bool limited = fit.tolerance.has_value();
    if (ImGui::Checkbox("Within a tolerance", &limited)) {
        fit.tolerance =
            limited ? std::optional(frame.state.preferences.tolerance_mm.value_or(usual_tolerance)) : std::nullopt;
        changed = true;
    }
    tooltip(
        patches
            ? "Otherwise within 1/1000 of the part's diagonal"
            : "Least-squares fit with knots added only where needed. Otherwise the surface interpolates the nodes of the grid");
    if (fit.tolerance) {
        ImGui::SetNextItemWidth(width);
        const std::string unit = fmt::format("{}##tolerance", length_word(frame.lengths()));
        if (length_inputs(frame, unit.c_str(), &*fit.tolerance, 1, frame.lengths(), {.mm = "%.4g", .inch = "%.3g"})) {
            fit.tolerance = std::clamp(*fit.tolerance, 1e-9, 1e6);
            changed = true;
        }
        const Document& document = frame.state.document;
        if (document.session.part && first_stale(document))
            muted(frame, fit_cost(document.session.part->mesh.triangles()));
    }
    double degrees[] = {double(fit.degree_u), double(fit.degree_v)};
    ImGui::SetNextItemWidth(width);
    if (typed_numbers(frame, patches ? "Degree" : "Degree u, v", degrees, patches ? 1 : 2, "%.0f")) {
        fit.degree_u = int(std::clamp(degrees[0], 2., 5.));
        fit.degree_v = patches ? fit.degree_u : int(std::clamp(degrees[1], 2., 5.));
        if (fit.ends == CurveEnds::natural && (fit.degree_u != 3 || fit.degree_v != 3))
            fit.ends = CurveEnds::averaged_knots;
        changed = true;
    }
    if (patches) { // whose sides are fitted first: no other ends, no other parameters
        if (changed)
            frame.actions.push(SetFit{fit});
        return;
    }
    static constexpr const char* names[] = {"averaged knots", "clamped", "natural"};
    int ends = int(fit.ends);
    ImGui::SetNextItemWidth(width);
    if (ImGui::Combo("Ends", &ends, names, 3)) {
        fit.ends = CurveEnds(ends);
        if (fit.ends == CurveEnds::natural)
            fit.degree_u = fit.degree_v = 3;
        changed = true;
    }
    tooltip(
        "Averaged knots and clamped ends (with estimated tangents) stay accurate up to the border; natural ends (cubic only) are less accurate there");
    if (fit.tolerance) {
        bool corrected = fit.parameters == FitParameters::corrected;
        if (ImGui::Checkbox("Correct parameters", &corrected)) {
            fit.parameters = corrected ? FitParameters::corrected : FitParameters::blank;
            changed = true;
        }
        tooltip(
            "Fits the part with fewer knots, but surface parameters no longer correspond to positions on the blank");
    }
    if (changed)
        frame.actions.push(SetFit{fit});
}

void fit_figures(Frame& frame, const SurfaceStage& surface)
{
    if (!surface.fit)
        return;
    const Palette p = palette_of(frame.state.view.dark);
    ImGui::PushStyleColor(ImGuiCol_Text, surface.fit->reached ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : p.warning);
    if (surface.patches)
        figure(frame, "Tolerance",
               fmt::format("{}: {}", length_text(surface.fit->tolerance, frame.lengths(), 3),
                           surface.fit->reached ? "met" : "not met"));
    else
        figure(frame, "Within tolerance", fmt::format("{:.2f} % of the area", 100 * surface.deviation.within()));
    ImGui::PopStyleColor();
    if (!surface.patches)
        figure(frame, "Knots inserted", fmt::format("{} + {}", surface.fit->knots_u, surface.fit->knots_v));
}

} // namespace spia::viewer
