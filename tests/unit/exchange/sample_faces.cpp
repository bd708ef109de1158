#include "tests/unit/exchange/sample_faces.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Geom_Plane.hxx>
#include <TopoDS.hxx>
#include <gp_Pln.hxx>
#include <stdexcept>

#include "engine/exchange/occt_session.h"
#include "engine/exchange/occt_surface.h"

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
    NurbsSurface surface;
    surface.degree_u = surface.degree_v = 1;
    surface.count_u = surface.count_v = 2;
    surface.knots_u = surface.knots_v = {0, 0, 1, 1};
    surface.control.resize(3, 4);
    surface.control << 0, 20, 0, 20, 30, 30, 50, 50, 0, 0, 0, 0;
    surface.weight.setOnes(4);
    return bounded(to_occt(surface), polygon({{100, 30, 90}, {120, 30, 90}, {120, 50, 90}}));
}

/// Between the two squares, nowhere wider than that.
TopoDS_Face narrow(double width)
{
    return bounded(new Geom_Plane(gp_Pln()), polygon({{20, 0, 0}, {20 + width, 10, 0}, {20, 20, 0}}));
}

} // namespace

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

} // namespace spia
