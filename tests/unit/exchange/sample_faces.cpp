#include "tests/unit/exchange/sample_faces.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <IGESControl_Reader.hxx>
#include <Interface_Static.hxx>
#include <TopTools_FormatVersion.hxx>
#include <TopoDS.hxx>
#include <gp.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <stdexcept>

#include "engine/exchange/cad/occt_session.h"
#include "engine/exchange/cad/occt_surface.h"
#include "tests/support/known_surfaces.h"

namespace spia {
namespace {

TopoDS_Wire polygon(std::initializer_list<gp_Pnt> corners)
{
    BRepBuilderAPI_MakePolygon maker;
    for (const gp_Pnt& corner : corners)
        maker.Add(corner);
    maker.Close();
    return maker.Wire();
}

/// A square of 20 mm in the plane z = 0.
TopoDS_Face square(double x)
{
    return BRepBuilderAPI_MakeFace(gp_Pln(), polygon({{x, 0, 0}, {x + 20, 0, 0}, {x + 20, 20, 0}, {x, 20, 0}}), true)
        .Face();
}

TopoDS_Face bounded(const Handle(Geom_Surface) & surface, const TopoDS_Wire& border)
{
    TopoDS_Face face;
    const BRep_Builder builder;
    builder.MakeFace(face, surface, 1e-7);
    builder.Add(face, border);
    return face;
}

/// A face with its border far from its surface.
TopoDS_Face torn()
{
    return bounded(to_occt(surfaces::bilinear({0, 30, 0}, {20, 30, 0}, {0, 50, 0}, {20, 50, 0})),
                   polygon({{100, 30, 90}, {120, 30, 90}, {120, 50, 90}}));
}

/// Between the two squares, nowhere wider than that.
TopoDS_Face narrow(double width)
{
    return bounded(new Geom_Plane(gp_Pln()), polygon({{20, 0, 0}, {20 + width, 10, 0}, {20, 20, 0}}));
}

/// A plane face inside of its border, with holes of 2 mm in rows of ten from x on.
TopoDS_Face perforated(const TopoDS_Wire& border, double x, int holes)
{
    BRepBuilderAPI_MakeFace face(gp_Pln(), border, true);
    for (int k = 0; k < holes; ++k) {
        const gp_Pnt middle(x + 5 + 9 * (k % 10), 10 + 20 * (k / 10), 0);
        BRepBuilderAPI_MakeWire hole(BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(middle, gp::DZ()), 1)).Edge());
        face.Add(TopoDS::Wire(hole.Wire().Reversed()));
    }
    return face.Face();
}

} // namespace

double area_by_curves(const std::filesystem::path& iges, int mode)
{
    const OcctSession session;
    const char* setting = "read.surfacecurve.mode";
    const int before = Interface_Static::IVal(setting);
    Interface_Static::SetIVal(setting, mode);
    IGESControl_Reader reader;
    reader.ReadFile(iges.c_str());
    reader.TransferRoots();
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(reader.OneShape(), properties, 1e-6);
    Interface_Static::SetIVal(setting, before);
    return properties.Mass();
}

void write_perforated_halves(const std::filesystem::path& brep, int holes, Between between, double width)
{
    const OcctSession session;
    const double right = 100 + width;
    BRepBuilderAPI_Sewing sewing(1e-6); // for them to have the edge in common that is one
    sewing.Add(perforated(polygon({{0, 0, 0}, {100, 0, 0}, {100, 50, 0}, {100, 100, 0}, {0, 100, 0}}), 0, holes));
    const TopoDS_Wire border =
        between == Between::gap
            ? polygon({{right, 0, 0}, {200, 0, 0}, {200, 100, 0}, {right, 100, 0}})
            : polygon({{100, 0, 0}, {200, 0, 0}, {200, 100, 0}, {right, 100, 0}, {right, 50, 0}, {100, 50, 0}});
    sewing.Add(perforated(border, 105, holes));
    sewing.Perform();
    if (!BRepTools::Write(sewing.SewedShape(), brep.c_str()))
        throw std::runtime_error("no plate was written");
}

void write_two_squares(const std::filesystem::path& brep, ThirdFace third)
{
    const OcctSession session;
    TopoDS_Compound compound;
    const BRep_Builder builder;
    builder.MakeCompound(compound);
    builder.Add(compound, square(0));
    if (third != ThirdFace::none)
        builder.Add(compound, third == ThirdFace::torn ? torn() : narrow(sliver_width));
    builder.Add(compound, square(20));
    if (!BRepTools::Write(compound, brep.c_str()))
        throw std::runtime_error("no faces were written");
}

void write_swept_cylinder(const std::filesystem::path& brep, Swept swept)
{
    const OcctSession session;
    const bool line = swept == Swept::line_up || swept == Swept::line_down;
    const bool up = swept == Swept::line_up || swept == Swept::circle_up;
    const double z = up ? 0 : 30, way = up ? 1 : -1;
    Handle(Geom_Surface) surface;
    if (line)
        surface = new Geom_SurfaceOfRevolution(new Geom_Line(gp_Pnt(10, 0, z), gp_Dir(0, 0, way)), gp::OZ());
    else
        surface = new Geom_SurfaceOfLinearExtrusion(new Geom_Circle(gp_Ax2(gp_Pnt(0, 0, z), gp::DZ()), 10),
                                                    gp_Dir(0, 0, way));
    // Borders in the plane of its parameters: angle, and height from z on.
    const gp_Pnt2d corners[] = {{-1, 0}, {1, 0}, {1, 30}, {-1, 30}};
    BRepBuilderAPI_MakeWire wire;
    for (int k = 0; k < 4; ++k) {
        const gp_Vec2d side(corners[k], corners[(k + 1) % 4]);
        TopoDS_Edge edge =
            BRepBuilderAPI_MakeEdge(new Geom2d_Line(corners[k], gp_Dir2d(side)), surface, 0, side.Magnitude());
        BRepLib::BuildCurves3d(edge);
        wire.Add(edge);
    }
    if (!BRepTools::Write(bounded(surface, wire.Wire()), brep.c_str()))
        throw std::runtime_error("no cylinder was written");
}

void write_tube(const std::filesystem::path& brep, int version, bool triangles)
{
    const OcctSession session;
    const TopoDS_Edge line = BRepBuilderAPI_MakeEdge(gp_Pnt(10, 0, 0), gp_Pnt(10, 0, 30));
    const TopoDS_Shape tube = BRepPrimAPI_MakeRevol(line, gp::OZ()).Shape();
    if (triangles)
        BRepMesh_IncrementalMesh(tube, 0.1);
    if (!BRepTools::Write(tube, brep.c_str(), triangles, false, TopTools_FormatVersion(version)))
        throw std::runtime_error("not written: " + brep.string());
}

void write_square_with_inner_edge(const std::filesystem::path& brep)
{
    const OcctSession session;
    const BRep_Builder builder;
    TopoDS_Face face = square(0);
    TopoDS_Wire inside;
    builder.MakeWire(inside);
    builder.Add(inside, BRepBuilderAPI_MakeEdge(gp_Pnt(5, 5, 0), gp_Pnt(15, 15, 0)).Edge().Oriented(TopAbs_INTERNAL));
    builder.Add(face, inside);
    if (!BRepTools::Write(face, brep.c_str()))
        throw std::runtime_error("not written: " + brep.string());
}

void write_cup_quarter(const std::filesystem::path& brep)
{
    const OcctSession session;
    const double middle = 4 * std::sqrt(0.5);
    BRepBuilderAPI_MakeWire profile;
    profile.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(20, 0, 0), gp_Pnt(96, 0, 0)).Edge());
    profile.Add(BRepBuilderAPI_MakeEdge(
                    GC_MakeArcOfCircle(gp_Pnt(96, 0, 0), gp_Pnt(96 + middle, 0, 4 - middle), gp_Pnt(100, 0, 4)).Value())
                    .Edge());
    profile.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(100, 0, 4), gp_Pnt(100, 0, 64)).Edge());
    const TopoDS_Shape cup = BRepPrimAPI_MakeRevol(profile.Wire(), gp::OZ(), std::numbers::pi / 2).Shape();
    if (!BRepTools::Write(cup, brep.c_str()))
        throw std::runtime_error("not written: " + brep.string());
}

} // namespace spia
