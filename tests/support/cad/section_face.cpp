#include "tests/support/cad/section_face.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <cmath>

namespace spia::shapes {

double heading(const Profile::Piece& piece, double s) { return piece.heading + piece.curvature * (s - piece.from); }

gp_Pnt beside(const Profile& profile, const Profile::Piece& piece, double s, double left)
{
    const Eigen::Vector2d p = profile.at(s);
    const double h = heading(piece, s);
    return {p.x() - left * std::sin(h), 0, p.y() + left * std::cos(h)};
}

TopoDS_Face section_face(const Profile& profile, double left, double right)
{
    BRepBuilderAPI_MakeWire wire;
    const auto add = [&](const Profile::Piece& piece, double at, bool back) {
        const gp_Pnt from = beside(profile, piece, back ? piece.to : piece.from, at),
                     to = beside(profile, piece, back ? piece.from : piece.to, at);
        if (piece.curvature == 0)
            wire.Add(BRepBuilderAPI_MakeEdge(from, to).Edge());
        else {
            const gp_Pnt middle = beside(profile, piece, (piece.from + piece.to) / 2, at);
            wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(from, middle, to).Value()).Edge());
        }
    };
    const auto& pieces = profile.pieces();
    for (const auto& piece : pieces)
        add(piece, left, false);
    wire.Add(BRepBuilderAPI_MakeEdge(beside(profile, pieces.back(), pieces.back().to, left),
                                     beside(profile, pieces.back(), pieces.back().to, right))
                 .Edge());
    for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece)
        add(*piece, right, true);
    wire.Add(
        BRepBuilderAPI_MakeEdge(beside(profile, pieces.front(), 0, right), beside(profile, pieces.front(), 0, left))
            .Edge());
    return BRepBuilderAPI_MakeFace(wire.Wire(), true).Face();
}

} // namespace spia::shapes
