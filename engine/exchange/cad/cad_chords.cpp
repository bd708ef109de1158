#include "engine/exchange/cad/cad_chords.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/exchange/cad/cad_curves.h"

namespace spia {
namespace {

double area_of(const TopoDS_Face& face)
{
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties);
    return std::abs(properties.Mass());
}

constexpr double next_to_nothing = 0.02; // of the area of all faces

struct Areas {
    double all = 0, largest_cone = 0, curved_twice = 0; ///< mm2
};

Areas areas_of(std::span<const TopoDS_Face> faces)
{
    Areas areas;
    for (const TopoDS_Face& face : faces) {
        const double area = area_of(face);
        areas.all += area;
        switch (BRepAdaptor_Surface(face, false).GetType()) {
        case GeomAbs_Cone: areas.largest_cone = std::max(areas.largest_cone, area); break;
        case GeomAbs_Plane:
        case GeomAbs_Cylinder:
        case GeomAbs_SurfaceOfExtrusion: break;
        default: areas.curved_twice += area;
        }
    }
    return areas;
}

bool curves_twice(const Areas& areas) { return areas.curved_twice > next_to_nothing * areas.all; }

/// Sheet that is rolled to a cone, not drawn to one with radii beside it; what is sunk into holes
/// is conical, too, but small.
bool is_conical(const Areas& areas)
{
    constexpr double large = 0.05; // of the area of all faces
    return areas.largest_cone > large * areas.all && !curves_twice(areas);
}

/// Of a face in the middle of an edge; zero where none is told.
gp_Vec normal_at(const TopoDS_Edge& edge, const TopoDS_Face& face)
{
    double from = 0, to = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, from, to);
    if (curve.IsNull())
        return {};
    const gp_Pnt2d at = curve->Value((from + to) / 2);
    gp_Pnt place;
    gp_Vec u, v;
    BRepAdaptor_Surface(face, false).D1(at.X(), at.Y(), place, u, v);
    const gp_Vec normal = u.Crossed(v);
    return normal.Magnitude() > 0 ? normal.Normalized() : gp_Vec{};
}

/// Whether a plane face has a long one that is no line and no circle, with a wall square to it:
/// where other walls cut the sheet the border is put right later (onto_projection()).
bool has_free_border(std::span<const TopoDS_Face> faces, double diagonal)
{
    constexpr double longest = 0.25, square = 0.02; // of the diagonal; sine of 1 degree
    TopTools_IndexedDataMapOfShapeListOfShape faces_at;
    for (const TopoDS_Face& face : faces)
        TopExp::MapShapesAndUniqueAncestors(face, TopAbs_EDGE, TopAbs_FACE, faces_at);
    const auto is_elementary = [](const TopoDS_Face& face) {
        const auto kind = BRepAdaptor_Surface(face, false).GetType();
        return kind == GeomAbs_Plane || kind == GeomAbs_Cylinder || kind == GeomAbs_Cone;
    };
    for (int i = 1; i <= faces_at.Extent(); ++i) {
        const TopoDS_Edge edge = TopoDS::Edge(faces_at.FindKey(i));
        const TopTools_ListOfShape& sides = faces_at.FindFromIndex(i);
        if (sides.Extent() > 2 || BRep_Tool::Degenerated(edge) || stated_curve(edge).kind != StatedCurve::Kind::other)
            continue;
        const TopoDS_Face one = TopoDS::Face(sides.First()), other = TopoDS::Face(sides.Last());
        const bool plane = BRepAdaptor_Surface(one, false).GetType() == GeomAbs_Plane ||
                           BRepAdaptor_Surface(other, false).GetType() == GeomAbs_Plane;
        const bool walled = sides.Extent() == 2; // else the border of a sheet without thickness
        if (!plane || (walled && is_elementary(one) && is_elementary(other)) ||
            (walled && !(std::abs(normal_at(edge, one).Dot(normal_at(edge, other))) < square)))
            continue;
        Bnd_Box box;
        BRepBndLib::Add(edge, box, false);
        if (!box.IsVoid() && std::sqrt(box.SquareExtent()) > longest * diagonal)
            return true;
    }
    return false;
}

} // namespace

Chords usual_chords(std::span<const TopoDS_Face> faces, double diagonal)
{
    const Chords usual{diagonal / 2000, 0.35};
    constexpr double fine = 2 * std::numbers::pi / 180; // 2e-4 of a disc
    constexpr double drawn = 0.005;                     // mm, half of what drawings of outlines are within
    try {
        const bool free = has_free_border(faces, diagonal);
        const bool cones = std::ranges::any_of(
            faces, [](const TopoDS_Face& face) { return BRepAdaptor_Surface(face, false).GetType() == GeomAbs_Cone; });
        if (!free && !cones)
            return usual;
        const Areas areas = areas_of(faces);
        if (!free && !is_conical(areas))
            return usual;
        return {free && !curves_twice(areas) ? std::min(usual.deflection, drawn) : usual.deflection, fine};
    } catch (const Standard_Failure&) { // of a damaged face: the reader says so elsewhere
        return usual;
    }
}

} // namespace spia
