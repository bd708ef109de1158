#include "tests/unit/exchange/sample_solids.h"

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <STEPControl_Writer.hxx>

#include "engine/exchange/cad/occt_session.h"

namespace spia {
namespace {

void write(const std::filesystem::path& step, const TopoDS_Shape& shape)
{
    const OcctSession session;
    STEPControl_Writer writer;
    writer.Transfer(shape, STEPControl_AsIs);
    writer.Write(step.c_str());
}

} // namespace

void write_box(const std::filesystem::path& step, double x, double y, double z)
{
    write(step, BRepPrimAPI_MakeBox(x, y, z).Shape());
}

void write_cone(const std::filesystem::path& step, double bottom, double top, double height)
{
    write(step, BRepPrimAPI_MakeCone(bottom, top, height).Shape());
}

} // namespace spia
