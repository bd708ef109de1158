#include "engine/exchange/cad/cad_mesh.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/exchange/cad/cad_curves.h"
#include "engine/exchange/cad/cad_sewing.h"
#include "engine/exchange/cad/occt_progress.h"
#include "engine/mesh/disjoint_sets.h"

namespace spia {
namespace {

/// The line along v that the curve of an edge on a face is but for rounding, also one that is
/// stated as a spline; null if it is another.
Handle(Geom2d_Curve) along_v(const TopoDS_Edge& edge, const TopoDS_Face& face)
{
    double from = 0, to = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, from, to);
    if (curve.IsNull() || !(to > from))
        return {};
    const gp_Pnt2d first = curve->Value(from), last = curve->Value(to);
    const double way = last.Y() > first.Y() ? 1 : -1, u = curve->Value((from + to) / 2).X();
    constexpr double rounding = 1e-8; // radians, and of the length
    constexpr int places = 8;
    for (int k = 0; k <= places; ++k) {
        const double t = from + (to - from) * k / places;
        const gp_Pnt2d at = curve->Value(t);
        if (!(std::abs(at.X() - u) <= rounding) ||
            !(std::abs(at.Y() - first.Y() - way * (t - from)) <= rounding * (to - from)))
            return {};
    }
    return new Geom2d_Line(gp_Pnt2d(u, first.Y() - way * from), gp_Dir2d(0, way));
}

/// BRepMesh divides the seams of cones, but gives no triangles to one whose seam is askew in its
/// last digit, as sewing of IGES faces leaves it.
void straighten_seams(const TopoDS_Compound& shape)
{
    for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next())
        for (TopExp_Explorer at(face.Current(), TopAbs_EDGE); at.More(); at.Next()) {
            // of a reversed face both sides would change places
            const TopoDS_Face of = TopoDS::Face(face.Current().Oriented(TopAbs_FORWARD));
            const TopoDS_Edge edge = TopoDS::Edge(at.Current().Oriented(TopAbs_FORWARD));
            if (!BRep_Tool::IsClosed(edge, of))
                continue;
            const auto one = along_v(edge, of), other = along_v(TopoDS::Edge(edge.Reversed()), of);
            if (!one.IsNull() && !other.IsNull())
                BRep_Builder().UpdateEdge(edge, one, other, of, BRep_Tool::Tolerance(edge));
        }
}

void triangulate(const TopoDS_Compound& shape, double deflection, double angle, const Progress& progress)
{
    BRepTools::Clean(shape); // a file may bring triangles of its own
    straighten_seams(shape);
    IMeshTools_Parameters parameters;
    parameters.Deflection = deflection;
    parameters.Angle = angle;
    parameters.MinSize = deflection;
    parameters.InParallel = false; // the order of its points must not depend on threads
    const Handle(OcctProgress) passed_on = new OcctProgress(progress, "triangulating the faces");
    const BRepMesh_IncrementalMesh mesh(shape, parameters, passed_on->Start());
}

/// Those of a face, and where it stands; none if a point is no number or a corner no point, as on
/// damaged faces.
Handle(Poly_Triangulation) sound_triangles(const TopoDS_Face& face, TopLoc_Location& place)
{
    Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, place);
    if (triangles.IsNull())
        return triangles;
    for (int k = 1; k <= triangles->NbNodes(); ++k) {
        const gp_Pnt p = triangles->Node(k).Transformed(place.Transformation());
        if (!std::isfinite(p.X()) || !std::isfinite(p.Y()) || !std::isfinite(p.Z()))
            return {};
    }
    for (int t = 1; t <= triangles->NbTriangles(); ++t)
        for (int k = 1; k <= 3; ++k)
            if (const int node = triangles->Triangle(t).Value(k); node < 1 || node > triangles->NbNodes())
                return {};
    return triangles;
}

/// Of an edge in the triangles of a face, numbered from 0; empty if there are none, or one is no
/// point of the face.
std::vector<int> nodes_of(const Handle(Poly_PolygonOnTriangulation) & polygon, int nodes_of_face)
{
    std::vector<int> nodes;
    for (int k = 1; !polygon.IsNull() && k <= polygon->NbNodes(); ++k) {
        const int node = polygon->Node(k);
        if (node < 1 || node > nodes_of_face)
            return {};
        nodes.push_back(node - 1);
    }
    return nodes;
}

/// The points of all faces in a row, and which of them are one because an edge or a vertex of the
/// shape is.
class SharedNodes {
public:
    explicit SharedNodes(std::span<const TopoDS_Face> faces) : first_(faces.size() + 1, 0), same_(0)
    {
        for (size_t f = 0; f < faces.size(); ++f) {
            TopLoc_Location place;
            const Handle(Poly_Triangulation) triangles = sound_triangles(faces[f], place);
            first_[f + 1] = first_[f] + (triangles.IsNull() ? 0 : triangles->NbNodes());
        }
        same_ = DisjointSets(size_t(first_.back()));
        for (size_t f = 0; f < faces.size(); ++f)
            join_along_edges(faces[f], first_[f]);
    }
    /// number: from 1
    int node(size_t face, int number) { return same_.root(first_[face] + number - 1); }
    int nodes() const { return first_.back(); }

    /// Calls visit(edge, its nodes in their order) for every edge that has any.
    template <class Visit> void for_each_edge(const Visit& visit)
    {
        for (size_t e = 0; e < on_edge_.size(); ++e) {
            std::vector<int> nodes = on_edge_[e];
            for (int& node : nodes)
                node = same_.root(node);
            visit(TopoDS::Edge(edge_.FindKey(int(e) + 1)), nodes);
        }
    }

private:
    std::vector<int> first_; ///< #faces + 1
    DisjointSets same_;
    TopTools_IndexedMapOfShape edge_;
    std::vector<std::vector<int>> on_edge_; ///< nodes of the face that was first to use the edge
    TopTools_DataMapOfShapeInteger on_vertex_;

    void join_along_edges(const TopoDS_Face& face, int first)
    {
        TopLoc_Location place;
        const Handle(Poly_Triangulation) triangles = sound_triangles(face, place);
        if (triangles.IsNull())
            return;
        for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
            const TopoDS_Edge& edge = TopoDS::Edge(at.Current());
            std::vector<int> nodes =
                nodes_of(BRep_Tool::PolygonOnTriangulation(edge, triangles, place), triangles->NbNodes());
            if (nodes.empty())
                continue;
            for (int& node : nodes)
                node += first;
            if (BRep_Tool::Degenerated(edge)) // a pole
                for (const int node : nodes)
                    same_.join(nodes.front(), node);
            else
                join_to_edge(edge, nodes);
            join_to_vertex(TopExp::FirstVertex(edge), nodes.front());
            join_to_vertex(TopExp::LastVertex(edge), nodes.back());
        }
    }
    void join_to_edge(const TopoDS_Edge& edge, const std::vector<int>& nodes)
    {
        const auto number = size_t(edge_.Add(edge));
        if (number > on_edge_.size()) {
            on_edge_.push_back(nodes);
            return;
        }
        const std::vector<int>& known = on_edge_[number - 1];
        if (known.size() == nodes.size()) // else the edge stays open, and the report counts its
                                          // sides
            for (size_t k = 0; k < nodes.size(); ++k)
                same_.join(known[k], nodes[k]);
    }
    void join_to_vertex(const TopoDS_Vertex& vertex, int node)
    {
        if (vertex.IsNull())
            return;
        if (const int* known = on_vertex_.Seek(vertex))
            same_.join(*known, node);
        else
            on_vertex_.Bind(vertex, node);
    }
};

/// Of a face at its nodes, to the side that its orientation makes the outer one.
std::vector<Eigen::Vector3f> node_normals(const TopoDS_Face& face, const Handle(Poly_Triangulation) & triangles)
{
    std::vector<Eigen::Vector3f> normal(size_t(triangles->NbNodes()), Eigen::Vector3f::Zero());
    if (!triangles->HasUVNodes())
        return normal;
    const BRepAdaptor_Surface surface(face, false);
    constexpr double pole = 1e-9; // of the square of a derivative
    for (int k = 1; k <= triangles->NbNodes(); ++k) {
        const gp_Pnt2d at = triangles->UVNode(k);
        gp_Pnt point;
        gp_Vec u, v;
        surface.D1(at.X(), at.Y(), point, u, v);
        gp_Vec n = u.Crossed(v);
        if (!(n.Magnitude() > pole * std::max(u.SquareMagnitude(), v.SquareMagnitude())))
            continue;
        n.Normalize();
        if (face.Orientation() == TopAbs_REVERSED)
            n.Reverse();
        normal[size_t(k - 1)] = Eigen::Vector3d(n.X(), n.Y(), n.Z()).cast<float>();
    }
    return normal;
}

/// @param vertex  per node that of the soup, -1: none
StatedCurves curves_of(SharedNodes& shared, const std::vector<int>& vertex)
{
    StatedCurves curves;
    shared.for_each_edge([&](const TopoDS_Edge& edge, const std::vector<int>& nodes) {
        const StatedCurve curve = stated_curve(edge);
        if (curve.kind == StatedCurve::Kind::other)
            return;
        for (size_t k = 0; k + 1 < nodes.size(); ++k)
            if (const int a = vertex[size_t(nodes[k])], b = vertex[size_t(nodes[k + 1])]; a >= 0 && b >= 0 && a != b)
                curves.chord.push_back({std::min(a, b), std::max(a, b), int(curves.curve.size())});
        curves.curve.push_back(curve);
    });
    std::sort(curves.chord.begin(), curves.chord.end());
    return curves;
}

} // namespace

FaceTriangles mesh_faces(std::span<const TopoDS_Face> faces, double deflection, double angle, const Progress& progress)
{
    triangulate(compound_of(faces), deflection, angle, progress);
    SharedNodes shared(faces);
    FaceTriangles result;
    std::vector<int> vertex(size_t(shared.nodes()), -1);
    for (size_t f = 0; f < faces.size(); ++f) {
        TopLoc_Location place;
        const Handle(Poly_Triangulation) triangles = sound_triangles(faces[f], place);
        if (triangles.IsNull())
            continue;
        const std::vector<Eigen::Vector3f> normal = node_normals(faces[f], triangles);
        for (int t = 1; t <= triangles->NbTriangles(); ++t) {
            std::array<int, 3> node{}, corner{};
            triangles->Triangle(t).Get(node[0], node[1], node[2]);
            if (faces[f].Orientation() == TopAbs_REVERSED)
                std::swap(node[1], node[2]);
            for (size_t k = 0; k < 3; ++k) {
                int& number = vertex[size_t(shared.node(f, node[k]))];
                if (number < 0) {
                    number = result.soup.vertices();
                    const gp_Pnt p = triangles->Node(node[k]).Transformed(place.Transformation());
                    result.soup.position.emplace_back(p.X(), p.Y(), p.Z());
                }
                corner[k] = number;
            }
            if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0])
                continue; // it lies along a pole or an edge that is a point
            result.soup.add_polygon(corner);
            result.face.push_back(int(f));
            result.normal.push_back(
                {normal[size_t(node[0] - 1)], normal[size_t(node[1] - 1)], normal[size_t(node[2] - 1)]});
        }
    }
    result.curves = curves_of(shared, vertex);
    return result;
}

} // namespace spia
