#include "engine/forming/drawbead.h"

#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia {
namespace {

/// Work per length and width of bending a sheet in plane strain from flat to a curvature (N/mm): the work of the flow curve
/// over the thickness, with the strain y / rho of its fibres.
double bending_work(const Material& material, double thickness, double curvature)
{
    const double r = material.normal_anisotropy(), factor = (1 + r) / std::sqrt(1 + 2 * r);
    constexpr int layers = 200; // midpoint rule
    double sum = 0;
    for (int k = 0; k < layers; ++k) {
        const double y = 0.5 * thickness * (k + 0.5) / layers;
        sum += flow_stress(material.hardening, factor * y * curvature).work;
    }
    return 2 * sum * 0.5 * thickness / layers;
}

} // namespace

double drawbead_force(const BeadShape& bead, const Material& material, double thickness)
{
    if (!(bead.radius > 0 && bead.shoulder_radius > 0 && thickness > 0 && bead.depth >= 0 && bead.friction >= 0))
        throw InputError(fmt::format("a drawbead of radius {} mm, shoulder radius {} mm, depth {} mm, friction {} in a "
                                     "sheet of {} mm: lengths must be positive, depth and friction not negative",
                                     bead.radius, bead.shoulder_radius, bead.depth, bead.friction, thickness));
    // The sheet's middle runs on arcs of these radii; they turn it by the same angle, at most a right angle.
    const double on_bead = bead.radius + thickness / 2, on_shoulder = bead.shoulder_radius + thickness / 2;
    const double angle = std::acos(std::max(0.0, 1 - bead.depth / (on_bead + on_shoulder)));
    if (angle == 0)
        return 0;
    double force = 0;
    const auto pass = [&](double radius, double wrap) {
        const double work = bending_work(material, thickness, 1 / radius);
        force = (force + work) * std::exp(bead.friction * wrap) + work;
    };
    pass(on_shoulder, angle);
    pass(on_bead, 2 * angle);
    pass(on_shoulder, angle);
    return force;
}

} // namespace spia
