#include "tests/support/cad/prism.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepFilletAPI_MakeFillet2d.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <STEPControl_Writer.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <stdexcept>

#include "engine/exchange/cad/occt_session.h"

namespace spia::shapes {

void write_prism(const std::filesystem::path& file, const PlaneLoop& section, double length,
                 const std::vector<double>& round)
{
    const OcctSession session;
    BRepBuilderAPI_MakePolygon wire;
    std::vector<TopoDS_Vertex> corner;
    for (const Eigen::Vector2d& p : section) {
        wire.Add(gp_Pnt(p.x(), 0, p.y()));
        corner.push_back(corner.empty() ? wire.FirstVertex() : wire.LastVertex());
    }
    wire.Close();
    const TopoDS_Face sharp = BRepBuilderAPI_MakeFace(wire.Wire(), true).Face();
    BRepFilletAPI_MakeFillet2d rounded(sharp);
    for (size_t i = 0; i < round.size(); ++i)
        if (round[i] > 0)
            rounded.AddFillet(corner[i], round[i]);
    const TopoDS_Shape section_face = round.empty() ? sharp : rounded.Shape();
    const TopoDS_Shape solid = BRepPrimAPI_MakePrism(section_face, gp_Vec(0, length, 0)).Shape();
    STEPControl_Writer writer;
    if (writer.Transfer(solid, STEPControl_AsIs) != IFSelect_RetDone || writer.Write(file.c_str()) != IFSelect_RetDone)
        throw std::runtime_error("not written: " + file.string());
}

} // namespace spia::shapes
