#include "tests/unit/exchange/sample_assembly.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_Label.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Pln.hxx>
#include <stdexcept>

#include "engine/exchange/cad/occt_session.h"

namespace spia {
namespace {

TopLoc_Location at(double x, double y, double z)
{
    gp_Trsf move;
    move.SetTranslation(gp_Vec(x, y, z));
    return TopLoc_Location(move);
}

TopoDS_Shape sheet_of_two_faces()
{
    BRepBuilderAPI_Sewing sewing(1e-3);
    sewing.Add(BRepBuilderAPI_MakeFace(gp_Pln(), 0, 10, 0, 10).Face());
    sewing.Add(BRepBuilderAPI_MakeFace(gp_Pln(), 10, 20, 0, 10).Face());
    sewing.Perform();
    return sewing.SewedShape();
}

TDF_Label named(const TDF_Label& label, const char* name)
{
    TDataStd_Name::Set(label, name);
    return label;
}

} // namespace

void write_sample_assembly(const std::filesystem::path& step)
{
    const OcctSession session;
    Interface_Static::SetCVal("write.step.unit", "MM"); // whatever another test has left
    Interface_Static::SetIVal("write.step.assembly", 1);
    Interface_Static::SetCVal("write.step.product.name", "part");
    Handle(TDocStd_Document) document;
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
    const Handle(XCAFDoc_ShapeTool) tool = XCAFDoc_DocumentTool::ShapeTool(document->Main());
    const TDF_Label car = named(tool->NewShape(), "Car"), front = named(tool->NewShape(), "Front");
    const TDF_Label plate = named(tool->AddShape(BRepPrimAPI_MakeBox(40, 30, 1).Shape(), false), "Plate");
    const TDF_Label cover = named(tool->AddShape(sheet_of_two_faces(), false), "Cover");
    const TDF_Label roof = named(tool->AddShape(BRepPrimAPI_MakeBox(50, 50, 2).Shape(), false), "Roof");
    named(tool->AddComponent(front, plate, at(0, 0, 0)), "left");
    named(tool->AddComponent(front, plate, at(60, 0, 0)), "right");
    named(tool->AddComponent(front, cover, at(0, 50, 0)), "cover of it");
    named(tool->AddComponent(car, front, at(0, 0, 100)), "front of it");
    named(tool->AddComponent(car, roof, at(-100, 0, 0)), "roof of it");
    tool->UpdateAssemblies();
    STEPCAFControl_Writer writer;
    if (!writer.Transfer(document, STEPControl_AsIs) || writer.Write(step.c_str()) != IFSelect_RetDone)
        throw std::runtime_error("no assembly was written");
    document->Close();
}

void write_sample_bodies(const std::filesystem::path& iges, bool solids)
{
    const OcctSession session;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    IGESControl_Writer writer("MM", solids ? 1 : 0);
    double x = 0;
    for (const double size : {10.0, 20.0, 30.0}) {
        writer.AddShape(BRepPrimAPI_MakeBox(gp_Pnt(x, 0, 0), size, size, 1).Shape());
        x += 100;
    }
    const Handle(IGESData_IGESModel) model = writer.Model();
    int named = 0;
    for (int i = 1; i <= model->NbEntities() && solids; ++i)
        if (model->Entity(i)->TypeNumber() == 186)
            model->Entity(i)->SetLabel(
                new TCollection_HAsciiString(std::string("Box " + std::to_string(++named)).c_str()));
    writer.ComputeModel();
    if (!writer.Write(iges.c_str()))
        throw std::runtime_error("no bodies were written");
}

} // namespace spia
