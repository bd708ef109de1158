#include "engine/exchange/cad/occt_iges.h"

#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <Interface_Static.hxx>
#include <TCollection_HAsciiString.hxx>
#include <sstream>

#include "engine/core/error.h"
#include "engine/exchange/cad/occt_session.h"
#include "engine/exchange/cad/occt_values.h"
#include "engine/exchange/provenance.h"

namespace spia {
namespace {

/// What IGES calls the unit in its header.
const char* iges_name(LengthUnit unit)
{
    switch (unit) {
    case LengthUnit::mm: return "MM";
    case LengthUnit::cm: return "CM";
    case LengthUnit::m: return "M";
    case LengthUnit::inch: return "INCH";
    }
    return "MM";
}

void fill_header(const Handle(IGESData_IGESModel) & model, const std::string& file_name, const std::string& part_name,
                 double largest, LengthUnit unit)
{
    IGESData_GlobalSection header = model->GlobalSection();
    const std::string date = time_stamp("%Y%m%d.%H%M%S");
    header.SetSendName(iges_string(part_name));
    header.SetReceiveName(iges_string(part_name));
    header.SetFileName(iges_string(file_name));
    header.SetSystemId(ascii(program_name()));
    header.SetInterfaceVersion(ascii(program_name()));
    header.SetAuthorName(ascii(program_name())); // OpenCASCADE would put the login name here
    header.SetCompanyName(ascii(""));
    header.SetDate(ascii(date));
    header.SetLastChangeDate(ascii(date));
    header.SetResolution(1e-6 / millimetres(unit)); // readers take it as their tolerance
    header.SetMaxCoord(largest / millimetres(unit));
    model->SetGlobalSection(header);
}

} // namespace

Handle(TCollection_HAsciiString) iges_string(std::string value)
{
    for (char& c : value)
        if (c < ' ' || c > '~')
            c = '?';
    return ascii(value);
}

std::string iges_text(const std::function<std::vector<Handle(IGESData_IGESEntity)>()>& entities, double largest_mm,
                      const std::string& file_name, const std::string& part_name, LengthUnit unit)
{
    const OcctSession session;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    Interface_Static::SetCVal("write.iges.unit", iges_name(unit));
    IGESControl_Writer collector(iges_name(unit), 0);
    for (const auto& entity : entities())
        collector.AddEntity(entity);
    fill_header(collector.Model(), file_name, part_name, largest_mm, unit);
    collector.ComputeModel();

    IGESData_IGESWriter writer(collector.Model());
    writer.FloatWriter().SetFormat("%.16E", true); // the default has 9 digits only
    writer.SendModel(Handle(IGESData_Protocol)::DownCast(collector.Model()->Protocol()));
    std::ostringstream stream;
    if (!writer.Print(stream))
        throw ExchangeError("OpenCASCADE could not make IGES text");
    return std::move(stream).str();
}

} // namespace spia
