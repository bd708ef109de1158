#include "engine/exchange/cad/cad_surfaces.h"

#include <BRep_Tool.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <ShapeCustom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <cmath>

namespace spia {
namespace {

Eigen::Vector3d vector(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }

StatedSurface stated(Handle(Geom_Surface) surface)
{
    StatedSurface result;
    if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface); !trimmed.IsNull())
        surface = trimmed->BasisSurface();
    if (surface.IsNull())
        return result;
    if (!surface->IsKind(STANDARD_TYPE(Geom_ElementarySurface))) {
        constexpr double off = 1e-4; // mm, that a spline is off the plane or cylinder it was made
                                     // from
        surface = ShapeCustom_Surface(surface).ConvertToAnalytical(off, false);
        if (surface.IsNull())
            return result;
    }
    if (const auto plane = Handle(Geom_Plane)::DownCast(surface); !plane.IsNull()) {
        result.kind = StatedSurface::Kind::plane;
        result.point = vector(plane->Location().XYZ());
        result.direction = vector(plane->Axis().Direction().XYZ());
    } else if (const auto cylinder = Handle(Geom_CylindricalSurface)::DownCast(surface); !cylinder.IsNull()) {
        result.kind = StatedSurface::Kind::cylinder;
        result.point = vector(cylinder->Location().XYZ());
        result.direction = vector(cylinder->Axis().Direction().XYZ());
        result.radius = cylinder->Radius();
    }
    const bool sound = result.point.allFinite() && result.direction.allFinite() && std::isfinite(result.radius) &&
                       (result.kind != StatedSurface::Kind::cylinder || result.radius > 0);
    return sound ? result : StatedSurface{};
}

} // namespace

std::vector<StatedSurface> stated_surfaces(std::span<const TopoDS_Face> faces)
{
    std::vector<StatedSurface> result;
    for (const TopoDS_Face& face : faces) {
        try {
            result.push_back(stated(BRep_Tool::Surface(face)));
        } catch (const Standard_Failure&) { // of a damaged spline: the reader says so elsewhere
            result.emplace_back();
        }
    }
    return result;
}

} // namespace spia
