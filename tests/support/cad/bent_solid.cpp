#include "tests/support/cad/bent_solid.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <Eigen/Core>
#include <GC_MakeArcOfCircle.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax3.hxx>
#include <gp_Circ.hxx>
#include <numbers>
#include <stdexcept>

#include "engine/exchange/cad/occt_session.h"
#include "tests/support/cad/section_face.h"
#include "tests/support/cad/write_solid.h"
#include "tests/support/profile.h"
#include "tests/support/seeded_random.h"

namespace spia::shapes {
namespace {

/// The outline of a cutout in its own plane, counter-clockwise.
TopoDS_Wire outline_of(const Cutout& cutout, const gp_Ax2& frame)
{
    BRepBuilderAPI_MakeWire wire;
    gp_Trsf to;
    to.SetTransformation(gp_Ax3(frame), gp_Ax3());
    const auto at = [&](double x, double y) { return gp_Pnt(x, y, 0).Transformed(to); };
    const double r = cutout.radius, x = cutout.length / 2 - r, y = cutout.width / 2 - r;
    if (x == 0 && y == 0) {
        const gp_Circ circle(frame, r);
        const int edges = cutout.halves ? 2 : 1;
        for (int k = 0; k < edges; ++k)
            wire.Add(BRepBuilderAPI_MakeEdge(circle, 2 * std::numbers::pi * k / edges,
                                             2 * std::numbers::pi * (k + 1) / edges)
                         .Edge());
        return wire.Wire();
    }
    const double sign[4][2] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    for (int k = 0; k < 4; ++k) {
        const double cx = sign[k][0] * x, cy = sign[k][1] * y, nx = sign[(k + 1) % 4][0] * x,
                     ny = sign[(k + 1) % 4][1] * y, from = (k - 1) * std::numbers::pi / 2;
        const auto on_arc = [&](double px, double py, double angle) {
            return at(px + r * std::cos(angle), py + r * std::sin(angle));
        };
        const gp_Pnt a = on_arc(cx, cy, from), b = on_arc(cx, cy, from + std::numbers::pi / 2),
                     c = on_arc(nx, ny, from + std::numbers::pi / 2);
        if (r > 0)
            wire.Add(
                BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(a, on_arc(cx, cy, from + std::numbers::pi / 4), b).Value())
                    .Edge());
        if (b.Distance(c) > 0)
            wire.Add(BRepBuilderAPI_MakeEdge(b, c).Edge());
    }
    return wire.Wire();
}

/// What is taken away.
TopoDS_Shape cutter(const BentSolid& solid, const Profile& profile, const Cutout& cutout)
{
    const Profile::Piece& leg = profile.pieces()[2 * size_t(cutout.leg)];
    const double s = leg.from + cutout.centre.x(), h = heading(leg, s), t = solid.thickness;
    const double bottom = cutout.depth > 0 ? t / 2 - cutout.depth : -t;
    const gp_Vec along(std::cos(h), 0, std::sin(h)), out(-std::sin(h), 0, std::cos(h)), y(0, 1, 0);
    const gp_Vec turned = along * std::cos(cutout.turn) + y * std::sin(cutout.turn);
    const gp_Vec way = out + along * cutout.lean.x() + y * cutout.lean.y();
    const gp_Pnt middle = beside(profile, leg, s, 0).Translated(y * cutout.centre.y());
    if (cutout.lean.norm() > 0 && cutout.length == 2 * cutout.radius && cutout.width == cutout.length) { // drilled
        const double reach = (t + cutout.radius * cutout.lean.norm()) * way.Magnitude();
        return BRepPrimAPI_MakeCylinder(gp_Ax2(middle.Translated(gp_Vec(gp_Dir(way)) * -reach), gp_Dir(way)),
                                        cutout.radius, 2 * reach)
            .Shape();
    }
    const gp_Ax2 frame(middle.Translated(way * bottom), gp_Dir(along.Crossed(y)), gp_Dir(turned));
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline_of(cutout, frame), true).Face(),
                                 way * (2 * t - bottom))
        .Shape();
}

TopoDS_Shape sunk(TopoDS_Shape shape, const BentSolid& solid, const Profile& profile, const Sink& sink)
{
    const Profile::Piece& leg = profile.pieces()[2 * size_t(sink.leg)];
    const double s = leg.from + sink.centre.x(), h = heading(leg, s), t = solid.thickness, side = sink.left ? 1 : -1;
    const gp_Vec in = gp_Vec(std::sin(h), 0, -std::cos(h)) * side;
    const gp_Pnt at = beside(profile, leg, s, side * t / 2).Translated(gp_Vec(0, sink.centre.y(), 0)),
                 before = at.Translated(in * -t);
    if (sink.hole > 0)
        shape = BRepAlgoAPI_Cut(shape, BRepPrimAPI_MakeCylinder(gp_Ax2(before, gp_Dir(in)), sink.hole, 3 * t).Shape());
    if (sink.seam)
        shape = BRepAlgoAPI_Cut(shape, BRepPrimAPI_MakeCylinder(gp_Ax2(before, gp_Dir(in)), sink.wide, t).Shape());
    if (sink.counterbore)
        return BRepAlgoAPI_Cut(shape, BRepPrimAPI_MakeCylinder(gp_Ax2(sink.seam ? at : before, gp_Dir(in)), sink.wide,
                                                               (sink.seam ? 0 : t) + sink.depth)
                                          .Shape());
    const double slope = (sink.wide - sink.hole) / sink.depth, above = sink.above > 0 ? sink.above : t;
    const gp_Ax2 begin(at.Translated(in * -above), gp_Dir(in));
    return BRepAlgoAPI_Cut(
        shape, BRepPrimAPI_MakeCone(begin, sink.wide + slope * above, sink.hole, above + sink.depth).Shape());
}

const Profile::Piece& piece_at(const Profile& profile, double s)
{
    for (const Profile::Piece& piece : profile.pieces())
        if (s <= piece.to)
            return piece;
    return profile.pieces().back();
}

/// mm, how far from the middle of the prism its outline goes.
double reach_of(const Cutout& outline) { return std::hypot(outline.length, outline.width) / 2; }

/// What is taken away.
TopoDS_Shape cutter(const BentSolid& solid, const Profile& profile, const BendCut& cut)
{
    const Profile::Piece& bend = profile.pieces()[2 * size_t(cut.bend) + 1];
    const double s = bend.from + cut.share * (bend.to - bend.from), t = solid.thickness;
    const Profile::Piece& piece = piece_at(profile, s);
    const double h = heading(piece, s) + cut.pitch, turn = cut.outline.turn;
    const gp_Vec along(std::cos(h), 0, std::sin(h)), out(-std::sin(h), 0, std::cos(h)), y(0, 1, 0);
    const gp_Vec way = out * std::cos(cut.lean) + y * std::sin(cut.lean);
    const gp_Vec side = y * std::cos(cut.lean) - out * std::sin(cut.lean);
    const double reach = std::max(cut.reach, 1.5 * t + reach_of(cut.outline));
    const gp_Pnt from = beside(profile, piece, s, 0).Translated(y * cut.y - way * reach);
    const gp_Ax2 frame(from, gp_Dir(way), gp_Dir(along * std::cos(turn) + side * std::sin(turn)));
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline_of(cut.outline, frame), true).Face(),
                                 way * (2 * reach))
        .Shape();
}

/// From the middle of an emboss outwards: its flat, the two radii with the slope between them.
Profile half_section(const Emboss& emboss)
{
    const double down = emboss.left ? -1 : 1, r = emboss.radius,
                 height = 2 * r * (1 - std::cos(emboss.slope)) + emboss.ramp * std::sin(emboss.slope);
    Profile profile({0, -down * height}, 0);
    return profile.straight(emboss.flat)
        .bend(r, down * emboss.slope)
        .straight(emboss.ramp)
        .bend(r, -down * emboss.slope);
}

/// The leg has a slot in place of the emboss, into which this is put.
TopoDS_Shape embossed(TopoDS_Shape shape, const BentSolid& solid, const Profile& profile, const Emboss& emboss)
{
    const Profile half = half_section(emboss);
    const double reach = half.at(half.length()).x(), t = solid.thickness;
    Cutout slot;
    slot.leg = emboss.leg;
    slot.centre = emboss.centre;
    slot.length = emboss.length + 2 * reach;
    slot.width = 2 * reach;
    slot.radius = reach;
    slot.turn = emboss.turn;
    shape = BRepAlgoAPI_Cut(shape, cutter(solid, profile, slot)).Shape();
    const Profile::Piece& leg = profile.pieces()[2 * size_t(emboss.leg)];
    const double s = leg.from + emboss.centre.x(), h = heading(leg, s);
    const gp_Vec along(std::cos(h), 0, std::sin(h)), out(-std::sin(h), 0, std::cos(h)), y(0, 1, 0);
    const gp_Pnt middle = beside(profile, leg, s, 0).Translated(y * emboss.centre.y());
    const gp_Ax2 frame(middle, gp_Dir(out), gp_Dir(along * std::cos(emboss.turn) + y * std::sin(emboss.turn)));
    gp_Trsf to;
    to.SetTransformation(gp_Ax3(frame), gp_Ax3());
    const gp_Ax1 axis(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
    const auto put = [&](const TopoDS_Shape& piece) {
        shape = BRepAlgoAPI_Fuse(shape, BRepBuilderAPI_Transform(piece, to, true).Shape()).Shape();
    };
    const TopoDS_Shape section = section_face(half, t / 2, -t / 2);
    if (emboss.length == 0) {
        put(BRepPrimAPI_MakeRevol(section, axis).Shape());
        return shape;
    }
    const auto at = [&](double x, double angle) { // the section from there towards that side
        gp_Trsf turn, move;
        turn.SetRotation(axis, angle);
        move.SetTranslation(gp_Vec(x, 0, 0));
        return BRepBuilderAPI_Transform(section, move * turn, true).Shape();
    };
    const double quarter = std::numbers::pi / 2;
    for (const double side : {1., -1.}) {
        put(BRepPrimAPI_MakePrism(at(-emboss.length / 2, side * quarter), gp_Vec(emboss.length, 0, 0)).Shape());
        const gp_Ax1 end(gp_Pnt(side * emboss.length / 2, 0, 0), gp_Dir(0, 0, 1));
        put(BRepPrimAPI_MakeRevol(at(side * emboss.length / 2, -side * quarter), end, 2 * quarter).Shape());
    }
    return shape;
}

gp_Trsf pose(std::uint64_t seed, double away)
{
    SeededRandom random(seed);
    const auto any = [&] { return random.between(-1, 1); };
    gp_Trsf turn, move;
    const double x = any(), y = any(), z = any();
    turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(x, y, z)), 3 * any());
    const double a = any(), b = any(), c = any();
    move.SetTranslation(gp_Vec(a, b, c) * away);
    return move * turn;
}

/// What lies between two distances to the left of the middle line.
TopoDS_Shape layer(const BentSolid& solid, const Profile& profile, double left, double right)
{
    return BRepPrimAPI_MakePrism(section_face(profile, left, right), gp_Vec(0, solid.width, 0)).Shape();
}

/// What is taken away.
TopoDS_Shape cutter(const BentSolid& solid, const Profile& profile, const Rebate& rebate)
{
    const double side = rebate.left ? 1 : -1, t = solid.thickness, floor = side * (t / 2 - rebate.depth),
                 beyond = side * 0.6 * t; // no faces on faces, and clear of bends' axes
    Profile end({-t, 0}, 0);              // the first leg begins at the origin
    end.straight(t + rebate.breadth);
    gp_Trsf before;
    before.SetTranslation(gp_Vec(0, -t, 0));
    const TopoDS_Shape section =
        section_face(rebate.across ? end : profile, std::max(floor, beyond), std::min(floor, beyond));
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_Transform(section, before, true).Shape(),
                                 gp_Vec(0, t + (rebate.across ? solid.width + t : rebate.breadth), 0))
        .Shape();
}

/// Takes the stamp away from the solid, or puts it on.
TopoDS_Shape stamped(const TopoDS_Shape& shape, const BentSolid& solid, const Profile& profile, const Stamp& stamp)
{
    const Profile::Piece& bend = profile.pieces()[2 * size_t(stamp.bend) + 1];
    const double s = (bend.from + bend.to) / 2, h = heading(bend, s), t = solid.thickness;
    const double out = bend.curvature > 0 ? -1 : 1; // to the left
    const gp_Vec along(std::cos(h), 0, std::sin(h)), across = gp_Vec(-std::sin(h), 0, std::cos(h)) * out;
    const double reach = profile.length();
    const gp_Pnt from = beside(profile, bend, s, 0).Translated(across * -reach);
    const auto wire = [&](const std::vector<Eigen::Vector2d>& loop) {
        BRepBuilderAPI_MakePolygon polygon;
        for (const Eigen::Vector2d& p : loop)
            polygon.Add(from.Translated(along * p.x() + gp_Vec(0, p.y(), 0)));
        polygon.Close();
        return polygon.Wire();
    };
    const auto prism = [&](const std::vector<Eigen::Vector2d>& loop) {
        return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire(loop), true).Face(), across * (2 * reach)).Shape();
    };
    TopoDS_Shape column = prism(stamp.outline.at(0));
    for (size_t i = 1; i < stamp.outline.size(); ++i)
        column = BRepAlgoAPI_Cut(column, prism(stamp.outline[i])).Shape();
    // no faces on faces
    const double level = t / 2 - stamp.depth, beyond = t / 2 + (stamp.depth > 0 ? 0.3 : -0.3) * t;
    const TopoDS_Shape mark = BRepAlgoAPI_Common(column, layer(solid, profile, out * level, out * beyond)).Shape();
    return stamp.depth > 0 ? BRepAlgoAPI_Cut(shape, mark).Shape() : BRepAlgoAPI_Fuse(shape, mark).Shape();
}

/// Whether a face of the solid is one of these sides: its middle is there.
bool on_side(const TopoDS_Shape& face, const BentSolid& solid, const Profile& profile, const std::vector<double>& sides)
{
    const BRepAdaptor_Surface surface(TopoDS::Face(face));
    const gp_Pnt middle = surface.Value((surface.FirstUParameter() + surface.LastUParameter()) / 2,
                                        (surface.FirstVParameter() + surface.LastVParameter()) / 2);
    return std::ranges::any_of(profile.pieces(), [&](const Profile::Piece& piece) {
        return std::ranges::any_of(sides, [&](double side) {
            const gp_Pnt there = beside(profile, piece, (piece.from + piece.to) / 2, side);
            return there.Translated(gp_Vec(0, solid.width / 2, 0)).Distance(middle) < 1e-6;
        });
    });
}

TopoDS_Shape with_round_corners(const TopoDS_Shape& shape, const BentSolid& solid, const Profile& profile)
{
    TopTools_IndexedDataMapOfShapeListOfShape faces;
    TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
    BRepFilletAPI_MakeFillet fillet(shape);
    const std::vector<double> sides = {solid.thickness / 2, -solid.thickness / 2};
    for (int i = 1; i <= faces.Extent(); ++i)
        if (!on_side(faces(i).First(), solid, profile, sides) && !on_side(faces(i).Last(), solid, profile, sides))
            fillet.Add(solid.corner, TopoDS::Edge(faces.FindKey(i)));
    return fillet.Shape();
}

TopoDS_Shape with_broken_edges(const TopoDS_Shape& shape, const BentSolid& solid, const Profile& profile,
                               const BrokenEdges& broken)
{
    std::vector<double> sides = {(broken.left ? 1 : -1) * solid.thickness / 2};
    if (broken.both)
        sides.push_back(-sides.front());
    TopTools_IndexedDataMapOfShapeListOfShape faces;
    TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
    BRepFilletAPI_MakeChamfer chamfer(shape);
    BRepFilletAPI_MakeFillet fillet(shape);
    int left = broken.edges > 0 ? broken.edges : faces.Extent();
    for (int i = 1; i <= faces.Extent() && left > 0; ++i) {
        const TopoDS_Edge& edge = TopoDS::Edge(faces.FindKey(i));
        const bool first = on_side(faces(i).First(), solid, profile, sides),
                   last = on_side(faces(i).Last(), solid, profile, sides);
        if (first == last && (first || !broken.across))
            continue;
        --left;
        if (broken.round)
            fillet.Add(broken.size, edge);
        else
            chamfer.Add(broken.size, edge);
    }
    return broken.round ? fillet.Shape() : chamfer.Shape();
}

TopoDS_Shape made(const BentSolid& solid)
{
    const Profile profile = middle_line(solid);
    const auto& pieces = profile.pieces();
    TopoDS_Shape shape = layer(solid, profile, solid.thickness / 2, -solid.thickness / 2);
    if (solid.corner > 0)
        shape = with_round_corners(shape, solid, profile);
    const auto break_edges = [&](bool cut) {
        for (const BrokenEdges& broken : {solid.broken, solid.broken_too})
            if (broken.size > 0 && broken.cut == cut)
                shape = with_broken_edges(shape, solid, profile, broken);
    };
    break_edges(false);
    if (solid.hole) {
        const Profile::Piece& bend = pieces[1];
        const double s = (bend.from + bend.to) / 2, h = heading(bend, s);
        const gp_Pnt at = beside(profile, bend, s, 0);
        // Broader than the bend, so that it is cut into both legs, where they are long enough.
        const double radius =
            solid.hole_radius > 0
                ? solid.hole_radius
                : std::min({0.3 * solid.width, (bend.to - bend.from) / 2 + 0.4 * std::min(solid.leg[0], solid.leg[1])});
        const gp_Dir across(-std::sin(h), 0, std::cos(h));
        const double reach = 1.5 * solid.thickness + radius;
        const gp_Pnt from = at.Translated(gp_Vec(across) * -reach + gp_Vec(0, solid.width / 2, 0));
        shape = BRepAlgoAPI_Cut(shape, BRepPrimAPI_MakeCylinder(gp_Ax2(from, across), radius, 2 * reach).Shape());
    }
    for (const Rebate& rebate : solid.rebate)
        shape = BRepAlgoAPI_Cut(shape, cutter(solid, profile, rebate)).Shape();
    for (const Cutout& cutout : solid.cutout)
        shape = BRepAlgoAPI_Cut(shape, cutter(solid, profile, cutout)).Shape();
    break_edges(true);
    for (const Sink& sink : solid.sink)
        shape = sunk(shape, solid, profile, sink);
    for (const Emboss& emboss : solid.emboss)
        shape = embossed(shape, solid, profile, emboss);
    for (const Stamp& stamp : solid.stamp)
        shape = stamped(shape, solid, profile, stamp);
    for (const BendCut& cut : solid.bend_cut)
        shape = BRepAlgoAPI_Cut(shape, cutter(solid, profile, cut)).Shape();
    if (solid.pose)
        shape = BRepBuilderAPI_Transform(shape, pose(solid.pose, solid.away), true).Shape();
    if (solid.splines)
        shape = BRepBuilderAPI_NurbsConvert(shape, true).Shape();
    for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More();)
        return at.Current();
    throw std::runtime_error("no solid was made");
}

} // namespace

Profile middle_line(const BentSolid& solid)
{
    Profile profile({0, 0}, 0);
    profile.straight(solid.leg[0]);
    for (size_t b = 0; b < solid.bend.size(); ++b)
        profile.bend(solid.bend[b].inner_radius + solid.thickness / 2, solid.bend[b].angle).straight(solid.leg[b + 1]);
    return profile;
}

double BentSolid::developed(double k) const
{
    double length = 0;
    for (const double each : leg)
        length += each;
    for (const SolidBend& each : bend)
        length += std::abs(each.angle) * (each.inner_radius + k * thickness);
    return length;
}

void write_bent_stl(const std::filesystem::path& file, const BentSolid& solid, double chord)
{
    const OcctSession session;
    double largest = 0;
    for (const SolidBend& bend : solid.bend)
        largest = std::max(largest, bend.inner_radius + solid.thickness);
    write_stl(file, made(solid), largest * (1 - std::cos(chord / 2)), chord);
}

void write_bent_solid(const std::filesystem::path& file, const BentSolid& solid, CadForm form)
{
    const OcctSession session;
    write_solid(file, made(solid), form);
}

} // namespace spia::shapes
