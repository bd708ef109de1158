#include "engine/exchange/cad/cad_surfaces.h"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <ShapeCustom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <cmath>

#include "engine/core/small_dense.h"
#include "engine/exchange/cad/occt_values.h"
#include "engine/mesh/solid/fit/cylinder_fit.h"

namespace spia {
namespace {

constexpr double spline_off = 1e-4; // mm, that a spline is off the plane or cylinder it was made from

/// The cylinder that a face of another kind lies on, by points and normals all over it: conversion
/// to rational splines leaves none that ShapeCustom_Surface knows.
StatedSurface sampled_cylinder(const TopoDS_Face& face, const Handle(Geom_Surface) & surface)
{
    constexpr int each_way = 9;
    constexpr double rounding = 1e-10, turns = 1e-4; // of the normals' mean squares; the latter 2 degrees
    double u[2], v[2];
    BRepTools::UVBounds(face, u[0], u[1], v[0], v[1]);
    Eigen::Matrix3Xd place(3, each_way * each_way), normal = place;
    for (int i = 0; i < each_way; ++i)
        for (int j = 0; j < each_way; ++j) {
            gp_Pnt at;
            gp_Vec along_u, along_v;
            surface->D1(u[0] + (u[1] - u[0]) * i / (each_way - 1), v[0] + (v[1] - v[0]) * j / (each_way - 1), at,
                        along_u, along_v);
            place.col(i * each_way + j) = vector(at.XYZ());
            normal.col(i * each_way + j) = vector(along_u.Crossed(along_v).XYZ()).normalized();
        }
    if (!place.allFinite() || !normal.allFinite())
        return {};
    const EigenPairs<3> spread = eigen_pairs(normal * normal.transpose() / double(normal.cols()));
    if (spread.value[0] > rounding || spread.value[1] < turns)
        return {};
    const auto round = cylinder_along(spread.vector.col(0), place);
    if (!round || !(round->off <= spline_off))
        return {};
    return {StatedSurface::Kind::cylinder, round->point, round->axis, round->radius};
}

StatedSurface stated(const TopoDS_Face& face)
{
    StatedSurface result;
    Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface); !trimmed.IsNull())
        surface = trimmed->BasisSurface();
    if (surface.IsNull())
        return result;
    if (!surface->IsKind(STANDARD_TYPE(Geom_ElementarySurface))) {
        const Handle(Geom_Surface) given = surface;
        surface = ShapeCustom_Surface(given).ConvertToAnalytical(spline_off, false);
        if (surface.IsNull())
            return sampled_cylinder(face, given);
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
            result.push_back(stated(face));
        } catch (const Standard_Failure&) { // of a damaged spline: the reader says so elsewhere
            result.emplace_back();
        }
    }
    return result;
}

} // namespace spia
