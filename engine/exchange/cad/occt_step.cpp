#include "engine/exchange/cad/occt_step.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <Interface_HArray1OfHAsciiString.hxx>
#include <Interface_Static.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <fmt/core.h>
#include <sstream>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/exchange/cad/occt_session.h"
#include "engine/exchange/cad/occt_values.h"
#include "engine/exchange/provenance.h"

namespace spia {
namespace {

Handle(Interface_HArray1OfHAsciiString) one_text(const std::string& value)
{
    return new Interface_HArray1OfHAsciiString(1, 1, ascii(value));
}

/// OpenCASCADE's name of the unit.
const char* occt_name(LengthUnit unit)
{
    switch (unit) {
    case LengthUnit::mm: return "MM";
    case LengthUnit::cm: return "CM";
    case LengthUnit::m: return "M";
    case LengthUnit::inch: return "INCH";
    }
    return "MM";
}

void fill_header(const Handle(StepData_StepModel) & model, const std::string& file_name, const std::string& part_name)
{
    APIHeaderSection_MakeHeader header(model);
    header.SetName(ascii(file_name));
    header.SetTimeStamp(ascii(time_stamp("%Y-%m-%dT%H:%M:%SZ")));
    header.SetAuthor(one_text(program_name()));
    header.SetOrganization(one_text(""));
    header.SetOriginatingSystem(ascii(program_name()));
    header.SetPreprocessorVersion(ascii(program_name()));
    header.SetAuthorisation(ascii(""));
    header.SetDescription(one_text(part_name));

    // OpenCASCADE appends the number of products made so far in this process.
    for (int i = 1; i <= model->NbEntities(); ++i)
        if (const auto product = Handle(StepBasic_Product)::DownCast(model->Value(i)); !product.IsNull()) {
            product->SetId(ascii(part_name));
            product->SetName(ascii(part_name));
            product->SetDescription(ascii(""));
        }
}

/// Names beyond ASCII as ISO 10303-21 wants them, e.g. \X2\00FC\X0\ for a u umlaut; OpenCASCADE
/// passes UTF-8 through.
std::string with_encoded_names(const std::string& utf8)
{
    std::string result;
    result.reserve(utf8.size());
    for (std::string_view rest = utf8; !rest.empty();) {
        const size_t length = utf8_length(rest);
        if (length == 0) {
            result += '?';
        } else if (length == 1) {
            result += rest[0];
        } else {
            unsigned code = static_cast<unsigned char>(rest[0]) & (0x7fu >> length);
            for (size_t k = 1; k < length; ++k)
                code = code << 6 | (static_cast<unsigned char>(rest[k]) & 0x3fu);
            result += code > 0xffff ? fmt::format("\\X4\\{:08X}\\X0\\", code) : fmt::format("\\X2\\{:04X}\\X0\\", code);
        }
        rest.remove_prefix(std::max<size_t>(length, 1));
    }
    return result;
}

} // namespace

std::string step_text(const std::function<TopoDS_Shape()>& shape, STEPControl_StepModelType type,
                      const std::function<void(const StepData_StepModel&)>& check, const std::string& file_name,
                      const std::string& part_name, LengthUnit unit)
{
    const OcctSession session;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    Interface_Static::SetCVal("write.step.unit", occt_name(unit));
    Interface_Static::SetCVal("write.step.schema", "AP242DIS");
    Interface_Static::SetCVal("write.step.product.name", part_name.c_str());
    Interface_Static::SetIVal("write.step.assembly", 0);
    Interface_Static::SetIVal("write.surfacecurve.mode",
                              0); // curves in parameter space would only repeat the borders
    Interface_Static::SetIVal("write.precision.mode", 0);
    Interface_Static::SetRVal("write.precision.val", step_resolution);

    STEPControl_Writer translator; // reads the settings, so it comes after them
    if (translator.Transfer(shape(), type) != IFSelect_RetDone)
        throw ExchangeError("OpenCASCADE could not translate the shape to STEP");
    const Handle(StepData_StepModel) model = translator.Model();
    fill_header(model, file_name, part_name);
    check(*model);

    StepData_StepWriter writer(model);
    writer.FloatWriter().SetFormat("%.16E", true); // the default has 12 digits
    writer.SendModel(Handle(StepData_Protocol)::DownCast(translator.WS()->Protocol()));
    std::ostringstream stream;
    if (!writer.Print(stream))
        throw ExchangeError("OpenCASCADE could not make STEP text");
    return with_encoded_names(std::move(stream).str());
}

} // namespace spia
