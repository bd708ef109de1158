#include "engine/exchange/cad/cad_shape.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_BasicEditor.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <fmt/core.h>
#include <sstream>
#include <stdexcept>

#include "engine/core/error.h"
#include "engine/core/file_content.h"
#include "engine/exchange/cad/brep_check.h"
#include "engine/exchange/cad/cad_damage.h"
#include "engine/exchange/cad/cad_names.h"
#include "engine/exchange/cad/iges_check.h"
#include "engine/exchange/cad/occt_progress.h"

namespace spia {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw InputError(why + "; export it again"); }

/// What lengths are converted from; OpenCASCADE takes them for mm where there is no name.
std::string unit_of(STEPControl_Reader& reader)
{
    TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
    reader.FileUnits(lengths, angles, solid_angles);
    return lengths.IsEmpty() || lengths.First().IsEmpty() ? "mm (none is stated)" : lengths.First().ToCString();
}

/// The flag counts, the name only where the flag says so: OpenCASCADE has looked at that already.
std::string unit_of(IGESControl_Reader& reader)
{
    const auto model = Handle(IGESData_IGESModel)::DownCast(reader.Model());
    if (model.IsNull())
        refuse("OpenCASCADE finds no model in it");
    const IGESData_GlobalSection& head = model->GlobalSection();
    const std::string unit = IGESData_BasicEditor::UnitFlagName(head.UnitFlag());
    if (unit.empty())
        refuse(fmt::format("its lengths are in a unit that is none of IGES (flag {}, name '{}')", head.UnitFlag(),
                           head.UnitName().IsNull() ? "" : head.UnitName()->ToCString()));
    return unit;
}

void list_faces(CadShape& whole)
{
    if (!whole.shape.IsNull())
        for (TopExp_Explorer at(whole.shape, TopAbs_FACE); at.More(); at.Next())
            whole.face.push_back(TopoDS::Face(at.Current()));
}

CadNames read_model(XSControl_Reader& reader, const std::filesystem::path& path, CadShape& result,
                    const Progress& progress)
{
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
        refuse("OpenCASCADE finds no model in it");
    progress.checkpoint(0.4, "reading the CAD model");
    CadDamage damage = damage_in(reader);
    if (!damage.fatal.empty())
        refuse("OpenCASCADE finds it damaged: " + damage.fatal);
    result.aside = std::move(damage.aside);
    const Handle(OcctProgress) passed_on = new OcctProgress(progress.part(0.4, 1), "making its faces");
    reader.TransferRoots(passed_on->Start());
    result.shape = reader.OneShape();
    list_faces(result);
    result.lost = not_translated(reader, result.face);
    return CadNames(reader);
}

CadNames read_brep(const std::filesystem::path& path, CadShape& result, const Progress& progress)
{
    result.format = "BREP";
    const std::string content = file_content(path);
    if (content.substr(0, 200).find("DBRep_DrawableShape") == std::string::npos &&
        content.substr(0, 200).find("CASCADE Topology") == std::string::npos)
        refuse("it is no BREP file in text form");
    if (const std::string fault = fault_of_brep(content); !fault.empty())
        refuse(fault);
    std::istringstream stream(content);
    // Left to itself the kernel reads on where there is nothing any more, and some of its loops
    // never end then.
    stream.exceptions(std::ios::failbit | std::ios::badbit);
    const Handle(OcctProgress) passed_on = new OcctProgress(progress, "reading the CAD model");
    try {
        BRepTools::Read(result.shape, stream, BRep_Builder(), passed_on->Start());
    } catch (const std::ios::failure&) {
        stream.exceptions(std::ios::goodbit);
        stream.clear();
        const auto at = size_t(std::max(std::streamoff(0), std::streamoff(stream.tellg())));
        if (at >= content.size())
            refuse(fmt::format("it was cut short: its text ends at byte {}, where more is announced", content.size()));
        refuse(fmt::format("it is damaged: at byte {} stands '{}', which is not what has to be there", at,
                           brep_word_at(content, at)));
    }
    if (!result.shape.IsNull())
        list_faces(result);
    if (!result.face.empty())
        return {};
    // The kernel reads as far as it can and says nothing: a shape that is announced and not there
    // was lost on the way.
    const size_t shapes = content.find("\nTShapes");
    if (shapes == std::string::npos)
        refuse(fmt::format(
            "it was cut short or is damaged: its list of shapes (TShapes) is missing, the text ends at byte {}",
            content.size()));
    if (content.find("\nFa", shapes) != std::string::npos || result.shape.IsNull())
        refuse(fmt::format(
            "it was cut short or is damaged: the shapes from byte {} on cannot be read up to the end at byte {}",
            shapes + 1, content.size()));
    return {};
}

CadNames read_step(const std::filesystem::path& path, CadShape& result, const Progress& progress)
{
    result.format = "STEP";
    const std::string content = file_content(path);
    if (content.substr(0, 1000).find("ISO-10303-21") == std::string::npos)
        refuse("it is no STEP file (ISO-10303-21)");
    if (content.rfind("ENDSEC") == std::string::npos ||
        content.find("END-ISO-10303-21", content.rfind("ENDSEC")) == std::string::npos)
        refuse("it was cut short (its last line END-ISO-10303-21 is missing)");
    STEPControl_Reader reader;
    CadNames names = read_model(reader, path, result, progress);
    result.unit = unit_of(reader);
    return names;
}

CadNames read_iges(const std::filesystem::path& path, CadShape& result, const Progress& progress)
{
    result.format = "IGES";
    std::istringstream content(file_content(path));
    if (const std::string fault = fault_of_iges(content); !fault.empty())
        refuse(fault);
    IGESControl_Reader reader;
    CadNames names = read_model(reader, path, result, progress);
    result.unit = unit_of(reader);
    return names;
}

using ReadShape = CadNames (*)(const std::filesystem::path& path, CadShape& result, const Progress& progress);

const std::vector<FormatReader<ReadShape>>& shape_readers()
{
    static const std::vector<FormatReader<ReadShape>> all = {{{"STEP", {".step", ".stp"}}, read_step},
                                                             {{"IGES", {".iges", ".igs"}}, read_iges},
                                                             {{"BREP", {".brep"}}, read_brep}};
    return all;
}

} // namespace

std::vector<FileFormat> cad_shape_formats() { return formats_of(shape_readers()); }

CadShape read_cad_shape(const std::filesystem::path& path, const Progress& progress)
{
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    CadShape result;
    CadNames names;
    try {
        names = reader_of(shape_readers(), path)(path, result, progress);
    } catch (const std::length_error& error) { // OpenCASCADE makes lists as long as a damaged file
                                               // says
        refuse(fmt::format("OpenCASCADE gives up on it (\"{}\")", error.what()));
    }
    if (result.face.empty())
        throw InputError("it holds no face; export the part with its surfaces (curves and points alone make no sheet)");
    result.tree = tree_of(result.shape, names);
    return result;
}

} // namespace spia
