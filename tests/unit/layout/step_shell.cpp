#include "tests/unit/layout/step_shell.h"

#include <BRepCheck_Analyzer.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS_Shape.hxx>

namespace spia {

StepShell read_step_shell(const std::filesystem::path& file)
{
    STEPControl_Reader reader;
    StepShell result;
    if (reader.ReadFile(file.c_str()) != IFSelect_RetDone)
        return result;
    reader.TransferRoots();
    const TopoDS_Shape shape = reader.OneShape();
    for (TopExp_Explorer e(shape, TopAbs_SHELL); e.More(); e.Next())
        ++result.shells;
    for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next())
        ++result.faces;
    TopTools_IndexedDataMapOfShapeListOfShape faces_of;
    TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
    for (int i = 1; i <= faces_of.Extent(); ++i)
        result.free_edges += faces_of(i).Extent() == 1;
    result.valid = BRepCheck_Analyzer(shape).IsValid();
    return result;
}

} // namespace spia
