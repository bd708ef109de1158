#include "engine/exchange/cad/trimmed_face.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/exchange/cad/occt_step.h"
#include "engine/exchange/cad/occt_surface.h"
#include "engine/nurbs/basis.h"

namespace spia {
namespace {

Handle(Geom2d_BSplineCurve) to_occt(const PlaneCurve& curve)
{
    TColgp_Array1OfPnt2d poles(1, int(curve.control.cols()));
    for (int i = 0; i < int(curve.control.cols()); ++i)
        poles(i + 1) = gp_Pnt2d(curve.control(0, i), curve.control(1, i));
    const std::vector<double> distinct = span_borders(curve.knots, curve.degree);
    TColStd_Array1OfReal knots(1, int(distinct.size()));
    TColStd_Array1OfInteger multiplicities(1, int(distinct.size()));
    for (int i = 0; i < int(distinct.size()); ++i) {
        knots(i + 1) = distinct[size_t(i)];
        multiplicities(i + 1) = int(std::count(curve.knots.begin(), curve.knots.end(), distinct[size_t(i)]));
    }
    return new Geom2d_BSplineCurve(poles, knots, multiplicities, curve.degree);
}

TopoDS_Wire wire_of(const TrimLoop& loop, const Handle(Geom_BSplineSurface) & geometry)
{
    BRepBuilderAPI_MakeWire wire;
    for (const PlaneCurve& curve : loop) {
        const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(to_occt(curve), geometry).Edge();
        if (!BRepLib::BuildCurve3d(edge, step_resolution))
            throw ExchangeError(
                "OpenCASCADE makes no curve in space of the border of a hole; write the surface with its "
                "holes filled");
        wire.Add(edge);
    }
    if (!wire.IsDone())
        throw ExchangeError("OpenCASCADE does not close the border of a hole; write the surface with its holes filled");
    return wire.Wire();
}

} // namespace

TopoDS_Face trimmed_face(const NurbsSurface& surface, std::span<const TrimLoop> holes)
{
    const Handle(Geom_BSplineSurface) geometry = to_occt(surface);
    BRepBuilderAPI_MakeFace face(geometry, step_resolution);
    if (!face.IsDone())
        throw ExchangeError("OpenCASCADE makes no face of the surface; check it for collapsed borders");
    for (const TrimLoop& loop : holes)
        face.Add(wire_of(loop, geometry));
    if (!holes.empty() && !BRepCheck_Analyzer(face.Face()).IsValid())
        throw ExchangeError(
            "OpenCASCADE finds the face with its holes invalid; write the surface with its holes filled");
    return face.Face();
}

} // namespace spia
