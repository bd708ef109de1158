#include "engine/exchange/cad/cad_doubles.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>

#include "engine/exchange/cad/cad_slivers.h"

namespace spia {
namespace {

/// First of the inside, then of the border; empty if no place inside was found.
std::vector<gp_Pnt> places_on(const TopoDS_Face& face)
{
    constexpr int across = 5, along_edge = 4;
    double u0, u1, v0, v1;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    std::vector<gp_Pnt> places;
    for (int i = 1; i <= across; ++i)
        for (int j = 1; j <= across; ++j) {
            const gp_Pnt2d uv(u0 + (u1 - u0) * i / (across + 1), v0 + (v1 - v0) * j / (across + 1));
            if (BRepClass_FaceClassifier(face, uv, 1e-9).State() == TopAbs_IN)
                places.push_back(surface->Value(uv.X(), uv.Y()));
        }
    for (TopExp_Explorer at(face, TopAbs_EDGE); at.More() && !places.empty(); at.Next()) {
        const TopoDS_Edge& edge = TopoDS::Edge(at.Current());
        if (BRep_Tool::Degenerated(edge))
            continue;
        const BRepAdaptor_Curve curve(edge);
        const double from = curve.FirstParameter(), to = curve.LastParameter();
        for (int k = 0; k < along_edge; ++k)
            places.push_back(curve.Value(from + (to - from) * k / along_edge));
    }
    return places;
}

/// Of the face and what is near it: the net of poles holds all of a surface.
Bnd_Box box_of(const TopoDS_Face& face, double tolerance)
{
    Bnd_Box box;
    BRepBndLib::Add(face, box, false);
    box.Enlarge(tolerance);
    return box;
}

bool lie_on(const std::vector<gp_Pnt>& places, const TopoDS_Face& face, double tolerance)
{
    for (const gp_Pnt& place : places) {
        const BRepExtrema_DistShapeShape distance(BRepBuilderAPI_MakeVertex(place), face);
        if (!distance.IsDone() || distance.Value() > tolerance)
            return false;
    }
    return true;
}

/// The first of the others on which the face lies.
int found_under(size_t a, std::span<const TopoDS_Face> faces, const std::vector<Bnd_Box>& box,
                const std::vector<int>& on, double tolerance)
{
    const std::vector<gp_Pnt> places = places_on(faces[a]);
    for (size_t b = 0; b < faces.size() && !places.empty(); ++b) {
        const bool outside =
            std::any_of(places.begin(), places.end(), [&](const gp_Pnt& p) { return box[b].IsOut(p); });
        if (a != b && on[b] < 0 && !outside && lie_on(places, faces[b], tolerance) &&
            !sliver(faces[a], tolerance)) // which lies on any neighbour
            return int(b);
    }
    return -1;
}

} // namespace

std::vector<int> doubled_faces(std::span<const TopoDS_Face> faces, double tolerance, const Progress& progress)
{
    std::vector<Bnd_Box> box;
    for (const TopoDS_Face& face : faces)
        box.push_back(box_of(face, tolerance));
    std::vector<int> on(faces.size(), -1);
    for (size_t a = faces.size(); a-- > 0;) {
        progress.checkpoint(1 - double(a) / double(faces.size()), "looking for doubled faces");
        try {
            on[a] = found_under(a, faces, box, on, tolerance);
        } catch (const Standard_Failure&) {
            continue; // a face that is damaged stays
        }
    }
    return on;
}

} // namespace spia
