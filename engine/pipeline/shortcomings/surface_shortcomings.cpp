#include "engine/pipeline/shortcomings/surface_shortcomings.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/place_text.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/shortcomings/unsuited_surface.h"
#include "engine/pipeline/usual_tolerance.h"

namespace spia {
namespace {

/// Whether the normal only vanishes at a corner: on a smooth outline the grid has no angle there.
bool at_a_corner(const Refusal& refusal)
{
    const auto end = [](double parameter) { return parameter == 0 || parameter == 1; };
    return refusal.why == Refusal::Why::vanishes && end(refusal.place.u) && end(refusal.place.v);
}

/// In percent, of which little is not nothing and most is not all.
std::string percent(double share)
{
    constexpr double least = 1e-4; // as two decimals show it
    if (share < least)
        return "less than 0.01 %";
    return share > 1 - least ? "more than 99.99 %" : fmt::format("{:.2f} %", 100 * share);
}

} // namespace

std::optional<std::string> far_surface(const Session& session)
{
    const SurfaceStage& surface = *session.surface;
    const Deviation& deviation = surface.deviation;
    if (surface.fit || deviation.max() <= usual_tolerance)
        return std::nullopt;
    return fmt::format(
        "the surface is up to {:.3g} mm from the part, near ({}), on {} of its area by more than the "
        "usual tolerance of {:.3g} mm: ask for a tolerance of the surface ({}), for patches ({}), or for more cells ({})",
        deviation.max(), place_text(deviation.worse().where), percent(1 - deviation.within()), usual_tolerance,
        mention(option::tolerance), mention(option::patches, "auto"), mention(option::grid));
}

std::optional<std::string> folded_surface(const Session& session)
{
    const Certificate& certificate = surface_certificate(session);
    const bool refused =
        !certificate.leak.empty() ||
        std::any_of(certificate.patch.begin(), certificate.patch.end(),
                    [](const PatchCertificate& each) { return each.refusal && !at_a_corner(*each.refusal); });
    std::string text;
    if (const std::string why = unsuited(certificate).value_or(""); refused)
        text = why.starts_with("it ") ? "the surface" + why.substr(2) : why;
    else if (const double turned = session.surface->deviation.normal.turned; turned > 0)
        text = fmt::format("the surface turns over against the part: on {} of its area the normals are opposite",
                           percent(turned));
    else
        return std::nullopt;
    return text +
           (made_of_patches(session)
                ? fmt::format("; add a cut there ({}), or take one patch ({})", mention(option::patches, "FILE"),
                              mention(option::patches, "one"))
                : fmt::format("; choose corners at sharp corners of the blank ({}), more cells ({}), or patches ({})",
                              mention(option::corners), mention(option::grid), mention(option::patches, "auto")));
}

} // namespace spia
