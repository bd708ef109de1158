#include "engine/exchange/cad/cad_sewing.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Shape.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <utility>

#include "engine/exchange/cad/cad_doubles.h"
#include "engine/exchange/cad/cad_gaps.h"
#include "engine/exchange/cad/cad_swept.h"
#include "engine/exchange/cad/occt_progress.h"
#include "engine/mesh/disjoint_sets.h"

namespace spia {
namespace {

constexpr double flaw = 1e-3; // mm; an edge shorter than this is a slip of the file, not a feature

/// Which faces use each edge, a seam twice.
class EdgeFaces {
public:
    explicit EdgeFaces(std::span<const TopoDS_Face> faces)
    {
        for (size_t f = 0; f < faces.size(); ++f)
            for (TopExp_Explorer at(faces[f], TopAbs_EDGE); at.More(); at.Next()) {
                const TopoDS_Edge& edge = TopoDS::Edge(at.Current());
                if (BRep_Tool::Degenerated(edge))
                    continue;
                const auto number = size_t(index_.Add(edge));
                use_.resize(std::max(use_.size(), number));
                use_[number - 1].push_back(int(f));
            }
    }
    int edges() const { return int(use_.size()); }
    const TopoDS_Edge& edge(int e) const { return TopoDS::Edge(index_(e + 1)); }
    const std::vector<int>& faces(int e) const { return use_[size_t(e)]; }
    int free() const
    {
        return int(std::count_if(use_.begin(), use_.end(), [](const auto& faces) { return faces.size() == 1; }));
    }

private:
    TopTools_IndexedMapOfShape index_;
    std::vector<std::vector<int>> use_;
};

/// Lengths of those that are more than flaws, ascending, mm.
std::vector<double> lengths_of(const EdgeFaces& edges)
{
    std::vector<double> lengths;
    for (int e = 0; e < edges.edges(); ++e) {
        try {
            const double length = GCPnts_AbscissaPoint::Length(BRepAdaptor_Curve(edges.edge(e)), flaw / 10);
            if (length > flaw)
                lengths.push_back(length);
        } catch (const Standard_Failure&) {
            continue; // an edge without a curve has no length to go by
        }
    }
    std::sort(lengths.begin(), lengths.end());
    return lengths;
}

/// Half of what nearly all edges are longer than, mm: those that are much shorter than the others
/// are slips, and do not count.
double half_an_edge(const std::vector<double>& lengths)
{
    constexpr double slips = 0.05;
    return lengths.empty() ? flaw : lengths[size_t(slips * double(lengths.size()))] / 2;
}

/// The widest gap that is closed unasked, mm.
double widest_closed(double half_an_edge, double diagonal)
{
    constexpr double usual = 0.5, of_diagonal = 1e-3;
    return std::min(half_an_edge, std::max(usual, of_diagonal * diagonal));
}

/// What has become of each face; it may be several or none.
template <class Successor> SewnFaces followed(const SewnFaces& before, const Successor& successor)
{
    SewnFaces after;
    for (size_t f = 0; f < before.face.size(); ++f)
        for (TopExp_Explorer at(successor(before.face[f]), TopAbs_FACE); at.More(); at.Next()) {
            after.face.push_back(TopoDS::Face(at.Current()));
            after.number.push_back(before.number[f]);
        }
    return after;
}

SewnFaces healed(const SewnFaces& faces, const Progress& progress)
{
    ShapeFix_Shape fix(compound_of(faces.face));
    const Handle(OcctProgress) passed_on = new OcctProgress(progress, "healing the faces");
    fix.Perform(passed_on->Start());
    return followed(faces, [&](const TopoDS_Face& face) { return fix.Context()->Apply(face); });
}

SewnFaces sewn(const SewnFaces& faces, double tolerance, const Progress& progress)
{
    BRepBuilderAPI_Sewing sewing(tolerance);
    for (const TopoDS_Face& face : faces.face)
        sewing.Add(face);
    const Handle(OcctProgress) passed_on =
        new OcctProgress(progress, fmt::format("sewing the faces at {} mm", tolerance));
    sewing.Perform(passed_on->Start());
    SewnFaces result = followed(faces, [&](const TopoDS_Face& face) {
        const TopoDS_Shape modified = sewing.Modified(face);
        return modified.IsNull() ? TopoDS_Shape(face) : modified;
    });
    result.tolerance = tolerance;
    result.doubles = faces.doubles;
    result.free_after = EdgeFaces(result.face).free();
    return result;
}

/// The widest place between two faces along their common edge: where their borders put it, each on
/// its own surface.
std::optional<CadGap> gap_along(const TopoDS_Edge& edge, const TopoDS_Face& a, const TopoDS_Face& b)
{
    constexpr int samples = 9;
    const TopoDS_Face* face[2] = {&a, &b};
    std::array<std::array<gp_Pnt, samples>, 2> point;
    for (size_t side = 0; side < 2; ++side) {
        double from, to;
        const Handle(Geom2d_Curve) border = BRep_Tool::CurveOnSurface(edge, *face[side], from, to);
        const Handle(Geom_Surface) surface = BRep_Tool::Surface(*face[side]);
        if (border.IsNull() || surface.IsNull())
            return {};
        for (size_t k = 0; k < samples; ++k) {
            const gp_Pnt2d uv = border->Value(from + (to - from) * double(k) / (samples - 1));
            point[side][k] = surface->Value(uv.X(), uv.Y());
        }
    }
    CadGap widest{-1, {}, {}};
    for (size_t k = 0; k < samples; ++k)
        if (const double width = point[0][k].Distance(point[1][k]); width > widest.width) {
            const gp_Pnt& p = point[0][k];
            widest = {width, Eigen::Vector3d(p.X(), p.Y(), p.Z()), {}};
        }
    return widest;
}

std::vector<CadGap> gaps_between(const SewnFaces& sewn)
{
    const EdgeFaces edges(sewn.face);
    std::vector<CadGap> gaps;
    for (int e = 0; e < edges.edges(); ++e) {
        const std::vector<int>& faces = edges.faces(e);
        if (faces.size() != 2 || faces[0] == faces[1])
            continue;
        auto gap = gap_along(edges.edge(e), sewn.face[size_t(faces[0])], sewn.face[size_t(faces[1])]);
        if (!gap)
            continue;
        gap->face = {sewn.number[size_t(faces[0])], sewn.number[size_t(faces[1])]};
        gaps.push_back(*gap);
    }
    std::stable_sort(gaps.begin(), gaps.end(), [](const CadGap& a, const CadGap& b) { return a.width > b.width; });
    return gaps;
}

/// Without faces that lie exactly on others; they are listed.
SewnFaces without_doubles(const SewnFaces& whole, const Progress& progress)
{
    const std::vector<int> on = doubled_faces(whole.face, std::min(flaw, whole.widest_closed), progress);
    SewnFaces rest = whole;
    rest.face.clear();
    rest.number.clear();
    for (size_t f = 0; f < on.size(); ++f)
        if (on[f] < 0) {
            rest.face.push_back(whole.face[f]);
            rest.number.push_back(whole.number[f]);
        } else
            rest.doubles.push_back({whole.number[f], whole.number[size_t(on[f])]});
    return rest;
}

/// The sheets that faces with common edges form: per face a number of its own sheet.
std::vector<int> sheets(const EdgeFaces& edges, size_t faces)
{
    DisjointSets joined(faces);
    for (int e = 0; e < edges.edges(); ++e)
        for (const int face : edges.faces(e))
            joined.join(edges.faces(e).front(), face);
    std::vector<int> sheet;
    for (size_t f = 0; f < faces; ++f)
        sheet.push_back(joined.root(int(f)));
    return sheet;
}

/// 0: nothing is to be sewn. Where hardly a free edge is near another, the near ones may be the
/// sides of a slit: then gaps are what parts one sheet from another, and what is no wider than a
/// flaw.
double tolerance_from_gaps(const SewnFaces& whole, const EdgeFaces& edges, const Progress& progress)
{
    constexpr double hardly_any = 0.05;
    const double least = std::min(flaw, whole.widest_closed), most = whole.widest_closed;
    std::vector<FreeEdge> free;
    for (int e = 0; e < edges.edges(); ++e)
        if (edges.faces(e).size() == 1)
            free.push_back({edges.edge(e), edges.faces(e)[0]});
    const std::vector<double> gaps = gaps_to_others(free, most, progress.part(0, 0.5));
    if (double(gaps.size()) < hardly_any * double(free.size())) {
        const std::vector<int> sheet = sheets(edges, whole.face.size());
        for (FreeEdge& each : free)
            each.owner = sheet[size_t(each.owner)];
        const double flaws = gaps.empty() || gaps.front() > least ? 0 : least;
        return std::max(flaws, tolerance_for(gaps_to_others(free, most, progress.part(0.5, 1)), least, most));
    }
    return tolerance_for(gaps, least, most);
}

/// Zero, as the faces are, stands for itself: a shell whose faces share edges already needs no
/// sewing.
SewnFaces best_sewn(const SewnFaces& whole, const EdgeFaces& edges, std::optional<double> given,
                    const Progress& progress)
{
    if (given)
        return *given > 0 ? sewn(without_doubles(whole, progress.part(0, 0.3)), *given, progress.part(0.3, 1)) : whole;
    if (whole.free_after == 0)
        return whole; // closed bodies
    const double tolerance = tolerance_from_gaps(whole, edges, progress.part(0, 0.2));
    const SewnFaces rest = without_doubles(whole, progress.part(0.2, 0.4));
    if (!(tolerance > 0))
        return rest;
    SewnFaces next = sewn(rest, tolerance, progress.part(0.4, 1));
    return next.free_after < rest.free_after ? next : rest;
}

} // namespace

TopoDS_Compound compound_of(std::span<const TopoDS_Face> faces)
{
    TopoDS_Compound compound;
    const BRep_Builder builder;
    builder.MakeCompound(compound);
    for (const TopoDS_Face& face : faces)
        builder.Add(compound, face);
    return compound;
}

SewnFaces sew(std::span<const TopoDS_Face> faces, std::optional<double> tolerance, double diagonal,
              const Progress& progress)
{
    SewnFaces loose;
    for (size_t f = 0; f < faces.size(); ++f)
        loose.number.push_back(int(f));
    loose.face = without_swept_cylinders(faces);
    SewnFaces whole = healed(loose, progress.part(0, 0.2));
    const EdgeFaces edges(whole.face);
    whole.free_before = whole.free_after = edges.free();
    const std::vector<double> lengths = lengths_of(edges);
    whole.shortest_edge = lengths.empty() ? 0 : lengths.front();
    whole.half_an_edge = half_an_edge(lengths);
    whole.widest_closed = widest_closed(whole.half_an_edge, diagonal);
    SewnFaces result = best_sewn(whole, edges, tolerance, progress.part(0.2, 1));
    result.free_before = whole.free_before;
    result.shortest_edge = whole.shortest_edge;
    result.half_an_edge = whole.half_an_edge;
    result.widest_closed = whole.widest_closed;
    result.gaps = gaps_between(result);
    return result;
}

} // namespace spia
