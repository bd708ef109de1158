#include "app/viewer/panels/steps/fit_editor.h"

#include <fmt/core.h>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/reports/export_check.h"
#include "app/viewer/model/reports/fit_cost.h"
#include "app/viewer/model/reports/lights.h"
#include "app/viewer/panels/option_fields.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/make_surface.h"

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
    const float label = ImGui::CalcTextSize(option::max_control_points.label.data()).x, // the longest
        width = std::min(150 * frame.ui.scale,
                         ImGui::GetContentRegionAvail().x - label - ImGui::GetStyle().ItemInnerSpacing.x);
    const SessionOptions& options = frame.state.document.session.options;
    const bool patches = options.patches || options.best_surface;
    bool changed = false;
    bool limited = fit.tolerance.has_value();
    // The one in use, if the program has chosen it: a tick changes no surface.
    const double offered = frame.state.preferences.tolerance_mm.value_or(
        patches ? surface_tolerance(frame.state.document.session) : usual_tolerance);
    if (ImGui::Checkbox("Within a tolerance", &limited)) {
        fit.tolerance = limited ? std::optional(option::tolerance.range->nearest(offered)) : std::nullopt;
        changed = true;
    }
    tooltip(
        patches
            ? "Otherwise within 1/1000 of the part's diagonal"
            : "The surface is fitted to the part with as few control points as the tolerance allows. Otherwise it runs through the nodes of the grid");
    // The field is there whether or not it is asked for: a tick moves nothing.
    ImGui::BeginDisabled(!fit.tolerance);
    double tolerance = fit.tolerance.value_or(offered);
    ImGui::SetNextItemWidth(width);
    const std::string unit = fmt::format("{}##tolerance", length_word(frame.lengths()));
    if (length_inputs(frame, unit.c_str(), &tolerance, 1, frame.lengths(), {.mm = "%.4g", .inch = "%.3g"}) &&
        fit.tolerance) {
        fit.tolerance = option::tolerance.range->nearest(tolerance);
        changed = true;
    }
    ImGui::EndDisabled();
    double degrees[] = {double(fit.degree_u), double(fit.degree_v)};
    ImGui::SetNextItemWidth(width);
    if (typed_numbers(frame, patches ? "Degree" : "Degree u, v", degrees, patches ? 1 : 2, "%.0f")) {
        fit.degree_u = int(option::degree.range->nearest(degrees[0]));
        fit.degree_v = patches ? fit.degree_u : int(option::degree.range->nearest(degrees[1]));
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
    ImGui::SetNextItemWidth(width);
    if (choice_field(option::ends, fit.ends)) {
        if (fit.ends == CurveEnds::natural)
            fit.degree_u = fit.degree_v = 3;
        changed = true;
    }
    ImGui::BeginDisabled(!fit.tolerance);
    bool corrected = fit.tolerance && fit.parameters == FitParameters::corrected;
    if (tick(option::fit_parameters, corrected)) {
        fit.parameters = corrected ? FitParameters::corrected : FitParameters::blank;
        changed = true;
    }
    ImGui::SetNextItemWidth(width);
    changed |= integer_field(frame, option::max_control_points, fit.max_control_points);
    ImGui::EndDisabled();
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
