#include "tests/support/cad/prism.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <STEPControl_Writer.hxx>
#include <stdexcept>

#include "engine/exchange/cad/occt_session.h"

namespace spia::shapes {

void write_prism(const std::filesystem::path& file, const PlaneLoop& section, double length)
{
    const OcctSession session;
    BRepBuilderAPI_MakePolygon wire;
    for (const Eigen::Vector2d& p : section)
        wire.Add(gp_Pnt(p.x(), 0, p.y()));
    wire.Close();
    const TopoDS_Shape solid =
        BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire(), true).Face(), gp_Vec(0, length, 0)).Shape();
    STEPControl_Writer writer;
    if (writer.Transfer(solid, STEPControl_AsIs) != IFSelect_RetDone || writer.Write(file.c_str()) != IFSelect_RetDone)
        throw std::runtime_error("not written: " + file.string());
}

} // namespace spia::shapes
