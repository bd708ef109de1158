#include "tests/support/cad/joined_tray.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBndLib.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <Bnd_Box.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <numbers>

#include "engine/exchange/cad/occt_session.h"
#include "tests/support/cad/write_solid.h"

namespace spia::shapes {
namespace {

/// A box from one corner to another, rounded at the edges of its bottom.
TopoDS_Shape rounded_box(const gp_Pnt& from, const gp_Pnt& to, double radius)
{
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(from, to).Shape();
    BRepFilletAPI_MakeFillet fillet(box);
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(box, TopAbs_EDGE, edges);
    for (int i = 1; i <= edges.Extent(); ++i) {
        Bnd_Box bounds;
        BRepBndLib::AddOptimal(edges(i), bounds, false, false);
        if (bounds.CornerMax().Z() < from.Z() + 1e-3)
            fillet.Add(radius, TopoDS::Edge(edges(i)));
    }
    return fillet.Shape();
}

} // namespace

double JoinedTray::area() const
{
    const double arc = radius + thickness / 2, inset = 2 * (radius + thickness), wall = height - radius - thickness;
    double sum = (length - inset) * (width - inset);
    for (const double side : {length - inset, width - inset})
        sum += 2 * (arc * (std::numbers::pi / 2 * side + 2 * arc) + wall * (side + 2 * arc));
    return sum;
}

void write_joined_tray(const std::filesystem::path& file, const JoinedTray& tray, CadForm form)
{
    const OcctSession session;
    const double t = tray.thickness;
    const TopoDS_Shape solid =
        BRepAlgoAPI_Cut(rounded_box({0, 0, 0}, {tray.length, tray.width, tray.height}, tray.radius + t),
                        rounded_box({t, t, t}, {tray.length - t, tray.width - t, 2 * tray.height}, tray.radius))
            .Shape();
    write_solid(file, TopExp_Explorer(solid, TopAbs_SOLID).Current(), form);
}

} // namespace spia::shapes
