#include "engine/pipeline/shortcomings/surface_shortcomings.h"

#include <algorithm>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/place_text.h"
#include "engine/layout/simplify/simplify_layout.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"
#include "engine/nurbs/smooth_joins.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/make_surface.h"
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

/// Radians, between the normals of neighbouring triangles.
double greatest_turn(const TriMesh& part)
{
    const Eigen::Matrix3Xd normal = area_vectors(part);
    double greatest = 0;
    const auto uses = edge_uses(part.triangle);
    for (size_t i = 1; i < uses.size(); ++i)
        if (uses[i].same_edge(uses[i - 1]))
            greatest = std::max(greatest, angle_between(normal.col(uses[i - 1].face), normal.col(uses[i].face)));
    return greatest;
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

std::optional<std::string> heavy_surface(const Session& session)
{
    const SurfaceStage& surface = *session.surface;
    if (!surface.fit && !surface.patches) // as many as the grid has nodes, which was the user's choice
        return std::nullopt;
    const int count = shared_controls(fitted_patches(surface)).count;
    if (count <= enough_control_points(session.part->mesh))
        return std::nullopt;
    return fmt::format("the surface has {} control points, more than the part has vertices ({}), which is much for "
                       "analysis: allow a larger tolerance ({})",
                       count, session.part->mesh.vertices(), mention(option::tolerance));
}

std::optional<std::string> ill_shaped_surface(const Session& session)
{
    const Certificate& certificate = session.surface->certificate;
    if (!session.options.best_surface || certificate.patch.empty())
        return std::nullopt;
    const PatchCertificate& poorest = certificate.poorest();
    if (poorest.least_scaled >= well_shaped_jacobian)
        return std::nullopt;
    return fmt::format("the sharpest corner of the surface has a scaled Jacobian of {:.2g} near ({}); 1 is best, less "
                       "than {} is poor for analysis: choose corners at sharp corners of the blank ({}), or cut "
                       "elsewhere ({})",
                       poorest.least_scaled, place_text(poorest.least_scaled_at.position), well_shaped_jacobian,
                       mention(option::corners), mention(option::patches, "FILE"));
}

std::optional<Kink> greatest_kink(const Session& session)
{
    Kink kink;
    for (const InterfaceCertificate& joint : session.surface->certificate.interfaces)
        if (joint.greatest_angle > kink.angle)
            kink = {joint.greatest_angle, 0, size_t(std::min(joint.joint.first.patch, joint.joint.second.patch))};
    const double sharp = SmoothJoinsOptions{}.sharp; // less is no edge: along those of the part, too
    if (kink.angle <= sharp)
        return std::nullopt;
    kink.turn = greatest_turn(session.part->mesh);
    return kink.angle > kink.turn + sharp ? std::optional(kink) : std::nullopt;
}

std::optional<std::string> kinked_surface(const Session& session)
{
    const auto kink = greatest_kink(session);
    if (!kink)
        return std::nullopt;
    const auto degrees = [](double radians) { return radians * 180 / std::numbers::pi; };
    return fmt::format("patches join with a kink of up to {:.3g} degrees (patch {}), while the part turns by at most "
                       "{:.2g} degrees from triangle to triangle: cut elsewhere ({}), or take one patch ({})",
                       degrees(kink->angle), kink->patch + 1, degrees(kink->turn), mention(option::patches, "FILE"),
                       mention(option::patches, "one"));
}

std::vector<std::string> surface_shortcomings(const Session& session)
{
    std::vector<std::string> list;
    for (const auto& poor :
         {far_surface(session), heavy_surface(session), ill_shaped_surface(session), kinked_surface(session)})
        if (poor)
            list.push_back(*poor);
    return list;
}

} // namespace spia
