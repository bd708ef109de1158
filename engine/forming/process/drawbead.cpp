#include "engine/forming/process/drawbead.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/mesh/closest_point.h"

namespace spia {
namespace {

/// Stress of plane strain over the equivalent one, and equivalent strain over that along the sheet
/// [Hill 1948].
double plane_strain_factor(const Material& material)
{
    const double r = material.normal_anisotropy();
    return (1 + r) / std::sqrt(1 + 2 * r);
}

/// Curvature up to which a sheet bends elastically in plane strain (1/mm): its outer fibre yields
/// at t/2 times it.
double elastic_curvature(const Material& material, double thickness)
{
    const double yield = StressCurve(material.hardening, material.young_MPa, {}).yield_strain();
    return 2 * plane_strain_factor(material) * yield * (1 - material.poisson * material.poisson) / thickness;
}

/// Work per length and width of bending a sheet in plane strain from flat to a curvature (N/mm):
/// the work of the flow curve over the thickness, with the strain y / rho of its fibres.
double bending_work(const Material& material, double thickness, double curvature)
{
    if (!(curvature > 0))
        return 0;
    const double factor = plane_strain_factor(material);
    constexpr int layers = 200; // midpoint rule
    double sum = 0;
    for (int k = 0; k < layers; ++k) {
        const double y = 0.5 * thickness * (k + 0.5) / layers;
        sum += flow_stress(material.hardening, factor * y * curvature).work;
    }
    return 2 * sum * 0.5 * thickness / layers;
}

Eigen::Vector3d middle_of(const std::vector<Eigen::Vector3d>& line)
{
    double left = 0;
    for (size_t k = 1; k < line.size(); ++k)
        left += 0.5 * (line[k] - line[k - 1]).norm();
    for (size_t k = 1; k < line.size(); ++k) {
        const double length = (line[k] - line[k - 1]).norm();
        if (left <= length && length > 0)
            return line[k - 1] + (line[k] - line[k - 1]) * (left / length);
        left -= length;
    }
    return line.front();
}

} // namespace

double drawbead_force(const BeadShape& bead, const Material& material, double thickness)
{
    if (!(bead.radius > 0 && bead.shoulder_radius > 0 && thickness > 0 && bead.depth >= 0 && bead.friction >= 0))
        throw InputError(fmt::format("a drawbead of radius {} mm, shoulder radius {} mm, depth {} mm, friction {} in a "
                                     "sheet of {} mm: lengths must be positive, depth and friction not negative",
                                     bead.radius, bead.shoulder_radius, bead.depth, bead.friction, thickness));
    // The sheet's middle runs on arcs of these radii; they turn it by the same angle, at most a
    // right angle.
    const double on_bead = bead.radius + thickness / 2, on_shoulder = bead.shoulder_radius + thickness / 2;
    const double angle = std::acos(std::max(0.0, 1 - bead.depth / (on_bead + on_shoulder)));
    if (angle == 0)
        return 0;
    // Before it lies on the tools the sheet spans crest and shoulder, which are on_bead +
    // on_shoulder apart, as a beam that stays level at both ends and is pushed aside by the depth d
    // at one: w'' = 6 d / span^2 there, zero midway. What of it is within the elastic limit springs
    // back and costs nothing; it is never sharper than the tool.
    const double span = on_bead + on_shoulder,
                 wave = 6 * bead.depth / (span * span) - elastic_curvature(material, thickness);
    double force = 0;
    const auto pass = [&](double radius, double wrap) {
        const double work = bending_work(material, thickness, std::clamp(wave, 0., 1 / radius));
        force = (force + work) * std::exp(bead.friction * wrap) + work;
    };
    pass(on_shoulder, angle);
    pass(on_bead, 2 * angle);
    pass(on_shoulder, angle);
    return force;
}

double drawbead_force(const BeadShape& bead, const std::vector<Eigen::Vector3d>& line, const TriMesh& part,
                      const Material& material, double thickness, std::span<const TailoredPiece> pieces)
{
    const TailoredPiece* own = nullptr;
    if (!pieces.empty() && !line.empty()) {
        const int face = ClosestPointSearch(part).nearest(middle_of(line)).face;
        for (const TailoredPiece& piece : pieces)
            if (std::find(piece.faces.begin(), piece.faces.end(), face) != piece.faces.end())
                own = &piece;
    }
    return own ? drawbead_force(bead, own->material, own->thickness) : drawbead_force(bead, material, thickness);
}

} // namespace spia
