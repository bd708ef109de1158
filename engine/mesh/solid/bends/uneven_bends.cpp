#include "engine/mesh/solid/bends/uneven_bends.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace spia {
namespace {

struct Arc {
    StatedSurface cylinder;
    int face;
    bool even = false; ///< there is one about the same axis on the other skin, a thickness apart
};

std::vector<Arc> arcs_on(SheetSide side, const ThinSolid& sheet, const std::vector<StatedSurface>& surface)
{
    std::vector<Arc> arcs;
    for (size_t f = 0; f < surface.size(); ++f)
        if (sheet.side[f] == side && surface[f].kind == StatedSurface::Kind::cylinder &&
            std::ranges::none_of(arcs, [&](const Arc& arc) { return same_cylinder(arc.cylinder, surface[f]); }))
            arcs.push_back({surface[f], int(f)});
    return arcs;
}

/// mm, between parallel axes; infinite between others.
double between_axes(const StatedSurface& a, const StatedSurface& b)
{
    constexpr double parallel = 1e-4; // radians
    if (a.direction.cross(b.direction).norm() > parallel)
        return std::numeric_limits<double>::infinity();
    return (b.point - a.point).cross(a.direction).norm();
}

} // namespace

std::vector<UnevenBend> uneven_bends(const ThinSolid& sheet, const std::vector<StatedSurface>& surface)
{
    const double t = sheet.thickness;
    constexpr double same = 0.02; // of the thickness: radii are rounded to hundredths of a
                                  // millimetre
    constexpr double near = 3;    // thicknesses: arcs of 90 degrees whose radii are off by two lie
                                  // so far apart
    std::vector<Arc> outer = arcs_on(SheetSide::outer, sheet, surface),
                     inner = arcs_on(SheetSide::inner, sheet, surface);
    for (Arc& a : outer)
        for (Arc& b : inner)
            if (between_axes(a.cylinder, b.cylinder) <= same * t &&
                std::abs(std::abs(a.cylinder.radius - b.cylinder.radius) - t) <= same * t)
                a.even = b.even = true;
    std::vector<UnevenBend> bends;
    for (const Arc& a : outer) {
        if (a.even)
            continue;
        const auto distance = [&](const Arc& b) {
            return b.even ? std::numeric_limits<double>::infinity() : between_axes(a.cylinder, b.cylinder);
        };
        const auto other = std::ranges::min_element(inner, {}, distance);
        if (other != inner.end() && distance(*other) < near * t)
            bends.push_back({a.cylinder.radius, other->cylinder.radius, a.face});
    }
    return bends;
}

} // namespace spia
