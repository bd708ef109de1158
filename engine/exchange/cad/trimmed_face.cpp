#include "engine/exchange/cad/trimmed_face.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepCheck_Result.hxx>
#include <BRepLib.hxx>
#include <Eigen/Geometry>
#include <Geom2d_BSplineCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <fmt/core.h>
#include <utility>
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

/// How far apart ends of sides may be that CAD systems join, mm.
constexpr double joined = 1e-3;

/// Whether two opposite sides have the same ends. @param k  0: those at both ends of u, 1: of v
bool comes_back(const NurbsSurface& surface, int k)
{
    const int last_u = surface.count_u - 1, last_v = surface.count_v - 1;
    const auto corner = [&](int i, int j) { return Eigen::Vector3d(surface.control.col(surface.index(i, j))); };
    const auto near = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm() <= joined; };
    return k == 0 ? near(corner(0, 0), corner(last_u, 0)) && near(corner(0, last_v), corner(last_u, last_v))
                  : near(corner(0, 0), corner(0, last_v)) && near(corner(last_u, 0), corner(last_u, last_v));
}

Eigen::AlignedBox2d box_of(const TrimLoop& loop)
{
    Eigen::AlignedBox2d box;
    for (const PlaneCurve& curve : loop)
        for (const auto& uv : curve.control.colwise())
            box.extend(Eigen::Vector2d(uv));
    return box;
}

/// The border of the parts in one direction: both ends, and between them the place nearest to the
/// middle that no hole is over, if the surface comes back to itself.
/// @param closed  to the last digits: OpenCASCADE gives it a seam then
std::vector<double> part_borders(const NurbsSurface& surface, const std::vector<Eigen::AlignedBox2d>& holes, int k,
                                 bool closed)
{
    const std::vector<double>& knots = k == 0 ? surface.knots_u : surface.knots_v;
    const double from = knots.front(), to = knots.back();
    constexpr int places = 40;
    if (!closed && comes_back(surface, k))
        for (int n = 0; n < places - 1; ++n) { // to both sides of the middle by turns
            const double at = from + (to - from) * (places / 2 + (n % 2 ? -1 : 1) * (n + 1) / 2) / places;
            if (std::ranges::none_of(
                    holes, [&](const Eigen::AlignedBox2d& box) { return box.min()[k] <= at && at <= box.max()[k]; }))
                return {from, at, to};
        }
    return {from, to};
}

TopoDS_Face trimmed_face(const NurbsSurface& surface, const Handle(Geom_BSplineSurface) & geometry,
                         std::span<const TrimLoop> holes)
{
    BRepBuilderAPI_MakeFace face(geometry, step_resolution);
    if (!face.IsDone())
        throw ExchangeError("OpenCASCADE makes no face of the surface; check it for collapsed borders");
    std::vector<std::pair<TopoDS_Wire, const TrimLoop*>> wires;
    Eigen::AlignedBox2d within;
    geometry->Bounds(within.min().x(), within.max().x(), within.min().y(), within.max().y());
    for (const TrimLoop& loop : holes)
        if (within.contains(box_of(loop).center()))
            face.Add(wires.emplace_back(wire_of(loop, surface, geometry), &loop).first);
    if (wires.empty())
        return face.Face();
    const BRepCheck_Analyzer check(face.Face());
    if (check.IsValid())
        return face.Face();
    for (const auto& [wire, loop] : wires)
        if (!has_sound_edges(wire, check))
            throw refused("finds the border invalid", surface, *loop);
    throw ExchangeError("OpenCASCADE finds the face with its holes invalid; write the surface with its holes filled");
}

} // namespace

std::vector<TopoDS_Face> trimmed_faces(const NurbsSurface& surface, std::span<const TrimLoop> holes)
{
    const Handle(Geom_BSplineSurface) geometry = to_occt(surface);
    std::vector<Eigen::AlignedBox2d> boxes;
    for (const TrimLoop& loop : holes)
        boxes.push_back(box_of(loop));
    const std::vector<double> u = part_borders(surface, boxes, 0, geometry->IsUClosed()),
                              v = part_borders(surface, boxes, 1, geometry->IsVClosed());
    std::vector<TopoDS_Face> faces;
    for (size_t j = 1; j < v.size(); ++j)
        for (size_t i = 1; i < u.size(); ++i) {
            // Readers project borders onto the surface: it must not have two places for one.
            const auto part = Handle(Geom_BSplineSurface)::DownCast(geometry->Copy());
            if (u.size() > 2 || v.size() > 2)
                part->Segment(u[i - 1], u[i], v[j - 1], v[j]);
            faces.push_back(trimmed_face(surface, part, holes));
        }
    return faces;
}

} // namespace spia
