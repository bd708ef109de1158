#include "tests/support/cad/plate_with_nut.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopExp_Explorer.hxx>

#include "engine/exchange/cad/occt_session.h"
#include "tests/support/cad/write_solid.h"

namespace spia::shapes {
namespace {

TopoDS_Shape cylinder(double radius, double from, double to)
{
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, from), gp_Dir(0, 0, 1)), radius, to - from).Shape();
}

} // namespace

void write_plate_with_nut(const std::filesystem::path& file, const PlateWithNut& plate)
{
    const OcctSession session;
    const double t = plate.thickness, half = plate.size / 2, above = t + plate.height;
    const TopoDS_Shape sheet = BRepAlgoAPI_Cut(
        BRepPrimAPI_MakeBox(gp_Pnt(-half, -half, 0), gp_Pnt(half, half, t)).Shape(), cylinder(plate.hole, -t, 2 * t));
    const TopoDS_Shape nut =
        BRepAlgoAPI_Cut(cylinder(plate.outer, t, above), cylinder(plate.inner, 0, above + t)).Shape();
    const TopoDS_Shape both = BRepAlgoAPI_Fuse(sheet, nut).Shape();
    write_solid(file, TopExp_Explorer(both, TopAbs_SOLID).Current(), CadForm::step);
}

} // namespace spia::shapes
