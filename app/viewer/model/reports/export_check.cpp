#include "app/viewer/model/reports/export_check.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/state.h"
#include "app/viewer/model/reports/lights.h"
#include "engine/report/figures/figures.h"
#include "engine/report/text/lengths.h"

namespace spia::viewer {

FitVerdict fit_verdict(const Session& session)
{
    FitVerdict verdict;
    if (!session.surface || !session.part)
        return verdict;
    constexpr double far = 10; // tolerances
    const SurfaceFigures figures = surface_figures(*session.surface);
    verdict.tolerance = session.surface->fit ? session.surface->fit->tolerance : usual_tolerance;
    verdict.greatest = figures.deviation_max;
    verdict.p95 = figures.deviation_p95;
    verdict.fit = verdict.greatest > far * verdict.tolerance ? Fit::far_off
                  : verdict.greatest > verdict.tolerance     ? Fit::beyond
                                                             : Fit::within;
    verdict.beyond = verdict.fit == Fit::within ? 0 : 1 - session.surface->deviation.within();
    return verdict;
}

std::string area_share(double share)
{
    constexpr double least = 1e-4; // as two decimals show it
    if (share > 0 && share < least)
        return "less than 0.01 %";
    if (share < 1 && share > 1 - least)
        return "more than 99.99 %";
    return fmt::format("{:.{}f} %", 100 * share, share == 0 || share == 1 ? 0 : 2);
}

std::string text(const FitVerdict& verdict, LengthUnit lengths)
{
    if (verdict.fit == Fit::none)
        return "There is no surface yet: IGES, STEP and files for analysis on the surface are left out.";
    const auto length = [&](double mm) { return length_text(mm, lengths, 3); };
    if (verdict.fit == Fit::within)
        return fmt::format("Its distance from the part is {} at most, and {} at most on 95 % of the area.",
                           length(verdict.greatest), length(verdict.p95));
    return fmt::format(
        "It deviates from the part by up to {}{}; {} of the area is beyond {}.", length(verdict.greatest),
        verdict.fit == Fit::far_off ? fmt::format(", {:.0f} times the tolerance", verdict.greatest / verdict.tolerance)
                                    : "",
        area_share(verdict.beyond), length(verdict.tolerance));
}

ExportVerdict export_verdict(const ViewerState& state, const FitVerdict& fit, bool writes_surface)
{
    ExportVerdict verdict;
    verdict.doubts = state.doubts ? state.doubts->size() : 0;
    verdict.text = text(fit, state.preferences.lengths);
    const char* surface = fit.fit == Fit::none      ? "No surface"
                          : fit.fit == Fit::within  ? "The surface is within tolerance"
                          : fit.fit == Fit::far_off ? "The surface is far from the part"
                                                    : "The surface is out of tolerance";
    verdict.kind = fit.fit == Fit::far_off && writes_surface       ? ExportVerdict::Kind::bad
                   : fit.fit == Fit::within && verdict.doubts == 0 ? ExportVerdict::Kind::good
                                                                   : ExportVerdict::Kind::warning;
    const Readiness ready = readiness(state);
    verdict.headline = verdict.doubts == 0   ? surface
                       : verdict.doubts == 1 ? fmt::format("{}; 1 thing to look at", surface)
                                             : fmt::format("{}; {} things to look at", surface, verdict.doubts);
    if (fit.fit != Fit::none && !writes_surface)
        verdict.text += " None of the files chosen holds it.";
    // the steps of the unfolding
    if (verdict.doubts == 0 && !ready.fine && out_of_date(state.document).empty()) {
        verdict.kind = std::max(verdict.kind, ExportVerdict::Kind::warning);
        verdict.text += " " + ready.text + ".";
    }
    return verdict;
}

} // namespace spia::viewer
