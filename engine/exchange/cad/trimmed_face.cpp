#include "engine/exchange/cad/trimmed_face.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepCheck_Result.hxx>
#include <BRepLib.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <fmt/core.h>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/place_text.h"
#include "engine/exchange/cad/occt_step.h"
#include "engine/exchange/cad/occt_surface.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"

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

/// Said of the border of a hole, by where it begins.
ExchangeError refused(const char* why, const NurbsSurface& surface, const TrimLoop& loop)
{
    const Eigen::Vector2d uv = loop.front().control.col(0);
    const Eigen::Vector3d at = evaluate(surface, uv.x(), uv.y()).position;
    return ExchangeError(fmt::format("OpenCASCADE {} of the hole at {} mm; write the surface with "
                                     "its holes filled",
                                     why, place_text(at)));
}

TopoDS_Wire wire_of(const TrimLoop& loop, const NurbsSurface& surface, const Handle(Geom_BSplineSurface) & geometry)
{
    // A bound only. By default a curve in space has some 230 pieces and is then left off its place:
    // a border of 203 corners over a surface of many knots was 0.28 mm off, and needed 340.
    constexpr int most_degree = 14, most_pieces = 10000;
    BRepBuilderAPI_MakeWire wire;
    for (const PlaneCurve& curve : loop) {
        const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(to_occt(curve), geometry).Edge();
        if (!BRepLib::BuildCurve3d(edge, step_resolution, GeomAbs_C1, most_degree, most_pieces))
            throw refused("makes no curve in space of the border", surface, loop);
        wire.Add(edge);
    }
    if (!wire.IsDone())
        throw refused("does not close the border", surface, loop);
    return wire.Wire();
}

bool has_sound_edges(const TopoDS_Wire& wire, const BRepCheck_Analyzer& check)
{
    for (TopExp_Explorer edge(wire, TopAbs_EDGE); edge.More(); edge.Next()) {
        const Handle(BRepCheck_Result)& found = check.Result(edge.Current());
        for (found->InitContextIterator(); found->MoreShapeInContext(); found->NextShapeInContext())
            for (const BRepCheck_Status status : found->StatusOnShape())
                if (status != BRepCheck_NoError)
                    return false;
    }
    return true;
}

} // namespace

TopoDS_Face trimmed_face(const NurbsSurface& surface, std::span<const TrimLoop> holes)
{
    const Handle(Geom_BSplineSurface) geometry = to_occt(surface);
    BRepBuilderAPI_MakeFace face(geometry, step_resolution);
    if (!face.IsDone())
        throw ExchangeError("OpenCASCADE makes no face of the surface; check it for collapsed borders");
    std::vector<TopoDS_Wire> wires;
    for (const TrimLoop& loop : holes)
        face.Add(wires.emplace_back(wire_of(loop, surface, geometry)));
    if (holes.empty())
        return face.Face();
    const BRepCheck_Analyzer check(face.Face());
    if (check.IsValid())
        return face.Face();
    for (size_t i = 0; i < wires.size(); ++i)
        if (!has_sound_edges(wires[i], check))
            throw refused("finds the border invalid", surface, holes[i]);
    throw ExchangeError("OpenCASCADE finds the face with its holes invalid; write the surface with its holes filled");
}

} // namespace spia
