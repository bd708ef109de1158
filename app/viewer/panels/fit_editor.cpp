#include "app/viewer/panels/fit_editor.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/reports/export_check.h"
#include "app/viewer/model/reports/fit_cost.h"
#include "app/viewer/model/reports/lights.h"
#include "app/viewer/model/reports/viewer_words.h"

namespace spia::viewer {

/// How long it takes, below all that can be chosen: it comes and goes.
static void cost_of_fit(Frame& frame, const FitChoice& fit)
{
    const Document& document = frame.state.document;
    if (fit.tolerance && document.session.part && first_stale(document))
        muted(frame, fit_cost(document.session.part->mesh.triangles()));
}

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
            : "The surface is fitted to the part with as few control points as the tolerance allows. Otherwise it runs through the nodes of the grid");
    // The field is there whether or not it is asked for: a tick moves nothing.
    ImGui::BeginDisabled(!fit.tolerance);
    double tolerance = fit.tolerance.value_or(frame.state.preferences.tolerance_mm.value_or(usual_tolerance));
    ImGui::SetNextItemWidth(width);
    const std::string unit = fmt::format("{}##tolerance", length_word(frame.lengths()));
    if (length_inputs(frame, unit.c_str(), &tolerance, 1, frame.lengths(), {.mm = "%.4g", .inch = "%.3g"}) &&
        fit.tolerance) {
        fit.tolerance = std::clamp(tolerance, 1e-9, 1e6);
        changed = true;
    }
    ImGui::EndDisabled();
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
        cost_of_fit(frame, fit);
        if (changed)
            frame.actions.push(SetFit{fit});
        return;
    }
    static constexpr const char* names[] = {"free", "along the part", "natural"};
    int ends = int(fit.ends);
    ImGui::SetNextItemWidth(width);
    if (ImGui::Combo("Borders", &ends, names, 3)) {
        fit.ends = CurveEnds(ends);
        if (fit.ends == CurveEnds::natural)
            fit.degree_u = fit.degree_v = 3;
        changed = true;
    }
    tooltip(
        "How the surface runs out at its borders. Free: with the knots averaged from the data. Along the part: with the slope estimated from the part (clamped). Both are accurate up to the border. Natural: without curvature at the border (degree 3 only), less accurate there.");
    ImGui::BeginDisabled(!fit.tolerance);
    bool corrected = fit.tolerance && fit.parameters == FitParameters::corrected;
    if (ImGui::Checkbox("Fewer control points", &corrected)) {
        fit.parameters = corrected ? FitParameters::corrected : FitParameters::blank;
        changed = true;
    }
    tooltip(
        "Lets points slide along the surface while it is fitted (parameter correction): it then needs fewer control points, but its lines u and v no longer are those of the blank");
    ImGui::SetNextItemWidth(width);
    constexpr int least = 16, greatest = 4'000'000; // as SetFit takes
    if (typed_integer(frame, "Max control points", fit.max_control_points)) {
        fit.max_control_points = std::clamp(fit.max_control_points, least, greatest);
        changed = true;
    }
    ImGui::EndDisabled();
    tooltip("The fit ends there even if the tolerance is not reached");
    cost_of_fit(frame, fit);
    if (changed)
        frame.actions.push(SetFit{fit});
}

void fit_figures(Frame& frame, const SurfaceStage& surface)
{
    const FitVerdict verdict = fit_verdict(frame.state.document.session);
    const Palette p = palette_of(frame.state.view.dark);
    ImGui::PushStyleColor(ImGuiCol_Text,
                          verdict.fit == Fit::within ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : p.warning);
    figure(frame, ("Beyond " + length_text(verdict.tolerance, frame.lengths(), 3)).c_str(),
           verdict.fit == Fit::within ? "nowhere" : area_share(verdict.beyond) + " of the area");
    ImGui::PopStyleColor();
    tooltip(surface.fit ? "Where the surface is farther from the part than the tolerance it was fitted within"
                        : "Where the surface is farther from the part than a usual tolerance");
    if (surface.fit && !surface.patches)
        figure(frame, "Added lines u + v", fmt::format("{} + {}", surface.fit->knots_u, surface.fit->knots_v));
}

} // namespace spia::viewer
