#include "tests/support/cad/write_solid.h"

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StlAPI_Writer.hxx>
#include <stdexcept>

namespace spia::shapes {

void write_stl(const std::filesystem::path& file, const TopoDS_Shape& shape, double deflection, double angle)
{
    const BRepMesh_IncrementalMesh meshed(shape, deflection, false, angle);
    StlAPI_Writer writer;
    writer.ASCIIMode() = false;
    if (!writer.Write(shape, file.c_str()))
        throw std::runtime_error("not written: " + file.string());
}

const char* extension(CadForm form)
{
    switch (form) {
    case CadForm::brep: return ".brep";
    case CadForm::iges: return ".igs";
    case CadForm::stl: return ".stl";
    case CadForm::step: break;
    }
    return ".step";
}

namespace {
bool iges_parameters = true;
}

void write_iges_parameters(bool as_well) { iges_parameters = as_well; }

/// OpenCASCADE keeps what the last writer of the process, which may have been the program's, has set.
static void set_all()
{
    IGESControl_Controller::Init();
    STEPControl_Controller::Init();
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    Interface_Static::SetCVal("write.step.unit", "MM");
    Interface_Static::SetCVal("write.step.schema", "AP214IS");
    Interface_Static::SetIVal("write.step.assembly", 0);
    Interface_Static::SetIVal("write.surfacecurve.mode", iges_parameters ? 1 : 0);
    Interface_Static::SetIVal("write.precision.mode", 0);
}

void write_solid(const std::filesystem::path& file, const TopoDS_Shape& shape, CadForm form)
{
    if (form == CadForm::brep) {
        if (!BRepTools::Write(shape, file.c_str()))
            throw std::runtime_error("not written: " + file.string());
        return;
    }
    if (form == CadForm::stl) {
        write_stl(file, shape, 0.05, 0.2);
        return;
    }
    set_all();
    if (form == CadForm::iges) {
        IGESControl_Writer writer("MM", 0);
        if (!writer.AddShape(shape) || !writer.Write(file.c_str()))
            throw std::runtime_error("not written: " + file.string());
        return;
    }
    STEPControl_Writer writer;
    if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone || writer.Write(file.c_str()) != IFSelect_RetDone)
        throw std::runtime_error("not written: " + file.string());
}

} // namespace spia::shapes
