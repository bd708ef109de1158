#include "engine/exchange/cad/cad_swept.h"

#include <BRepTools_Modification.hxx>
#include <BRepTools_Modifier.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>

#include "engine/exchange/cad/cad_sewing.h"

namespace spia {
namespace {

constexpr double same_direction = 1e-9, same_point = 1e-7; // radians, mm: what OpenCASCADE takes
                                                           // for equal

Handle(Geom_Curve) untrimmed(const Handle(Geom_Curve) & curve)
{
    const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve);
    return trimmed.IsNull() ? curve : trimmed->BasisCurve();
}

/// A line about an axis in its plane: the angle is that of the cylinder or cone, the other
/// parameter the way along the line.
Handle(Geom_Surface) elementary(const Geom_SurfaceOfRevolution& surface)
{
    const auto basis = Handle(Geom_Line)::DownCast(untrimmed(surface.BasisCurve()));
    if (basis.IsNull())
        return {};
    const gp_Lin line = basis->Lin(), axis(surface.Axis());
    const gp_Vec up(axis.Direction()), along(line.Direction()), from(axis.Location(), line.Location());
    const gp_Vec radial = from - up * from.Dot(up);
    const double radius = radial.Magnitude(), rise = along.Dot(up);
    if (radius < same_point)
        return {}; // from the axis itself: where its sides are is not said
    const gp_Vec out = radial / radius;
    if (std::abs(along.Dot(up.Crossed(out))) > same_direction || std::abs(rise) < 1e-3)
        return {}; // a hyperboloid, or a plane
    const gp_Pnt middle = axis.Location().Translated(up * from.Dot(up));
    gp_Ax3 place(middle, gp_Dir(up), gp_Dir(out));
    if (rise < 0)
        place.ZReverse(); // the angle goes round as before
    const double slope = std::asin(along.Dot(out));
    if (std::abs(slope) < same_direction)
        return new Geom_CylindricalSurface(place, radius);
    return new Geom_ConicalSurface(place, slope, radius);
}

Handle(Geom_Surface) elementary(const Geom_SurfaceOfLinearExtrusion& surface)
{
    const auto basis = Handle(Geom_Circle)::DownCast(untrimmed(surface.BasisCurve()));
    if (basis.IsNull() || !basis->Circ().Axis().Direction().IsParallel(surface.Direction(), same_direction))
        return {};
    gp_Ax3 place(basis->Circ().Position());
    if (place.Direction().Dot(surface.Direction()) < 0)
        place.ZReverse();
    return new Geom_CylindricalSurface(place, basis->Circ().Radius());
}

/// Null if it is another.
Handle(Geom_Surface) elementary(const TopoDS_Face& face, TopLoc_Location& place)
{
    Handle(Geom_Surface) surface = BRep_Tool::Surface(face, place);
    if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface); !trimmed.IsNull())
        surface = trimmed->BasisSurface();
    if (const auto turned = Handle(Geom_SurfaceOfRevolution)::DownCast(surface); !turned.IsNull())
        return elementary(*turned);
    if (const auto drawn = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface); !drawn.IsNull())
        return elementary(*drawn);
    return {};
}

class SweptToElementary : public BRepTools_Modification {
public:
    Standard_Boolean NewSurface(const TopoDS_Face& face, Handle(Geom_Surface) & surface, TopLoc_Location& place,
                                Standard_Real& tolerance, Standard_Boolean& turn_wires,
                                Standard_Boolean& turn_face) override
    {
        surface = elementary(face, place);
        tolerance = BRep_Tool::Tolerance(face);
        turn_wires = turn_face = false;
        return !surface.IsNull();
    }
    Standard_Boolean NewCurve2d(const TopoDS_Edge& edge, const TopoDS_Face& face, const TopoDS_Edge&,
                                const TopoDS_Face&, Handle(Geom2d_Curve) & curve, Standard_Real& tolerance) override
    {
        TopLoc_Location place;
        if (elementary(face, place).IsNull())
            return false;
        double from, to;
        curve = BRep_Tool::CurveOnSurface(edge, face, from, to);
        tolerance = BRep_Tool::Tolerance(edge);
        return !curve.IsNull();
    }
    Standard_Boolean NewCurve(const TopoDS_Edge&, Handle(Geom_Curve) &, TopLoc_Location&, Standard_Real&) override
    {
        return false;
    }
    Standard_Boolean NewPoint(const TopoDS_Vertex&, gp_Pnt&, Standard_Real&) override { return false; }
    Standard_Boolean NewParameter(const TopoDS_Vertex&, const TopoDS_Edge&, Standard_Real&, Standard_Real&) override
    {
        return false;
    }
    GeomAbs_Shape Continuity(const TopoDS_Edge& edge, const TopoDS_Face& a, const TopoDS_Face& b, const TopoDS_Edge&,
                             const TopoDS_Face&, const TopoDS_Face&) override
    {
        return BRep_Tool::Continuity(edge, a, b);
    }
};

} // namespace

std::vector<TopoDS_Face> without_swept_cylinders(std::span<const TopoDS_Face> faces)
{
    std::vector<TopoDS_Face> result(faces.begin(), faces.end());
    TopLoc_Location place;
    if (std::none_of(faces.begin(), faces.end(),
                     [&](const TopoDS_Face& face) { return !elementary(face, place).IsNull(); }))
        return result;
    // all at once: common edges stay common
    BRepTools_Modifier modifier(compound_of(faces), new SweptToElementary);
    for (TopoDS_Face& face : result)
        face = TopoDS::Face(modifier.ModifiedShape(face));
    return result;
}

} // namespace spia
