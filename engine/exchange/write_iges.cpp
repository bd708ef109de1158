#include "engine/exchange/write_iges.h"

#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESGeom_BSplineSurface.hxx>
#include <Interface_Static.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColStd_HArray2OfReal.hxx>
#include <TColgp_HArray2OfXYZ.hxx>
#include <TCollection_HAsciiString.hxx>
#include <sstream>

#include "engine/core/error.h"
#include "engine/exchange/occt_session.h"
#include "engine/exchange/occt_surface.h"
#include "engine/exchange/provenance.h"

namespace spia {
namespace {

Handle(TCollection_HAsciiString) text(const std::string& value) { return new TCollection_HAsciiString(value.c_str()); }

/// IGES text is printable ASCII in lines of fixed length; anything else becomes a question mark.
Handle(TCollection_HAsciiString) ascii(std::string value)
{
    for (char& c : value)
        if (c < ' ' || c > '~')
            c = '?';
    return text(value);
}

/// IGES counts the knots of degree p from -p.
Handle(TColStd_HArray1OfReal) knots_from_minus_degree(const std::vector<double>& knots, int degree)
{
    Handle(TColStd_HArray1OfReal) result = new TColStd_HArray1OfReal(-degree, int(knots.size()) - 1 - degree);
    for (int i = 0; i < int(knots.size()); ++i)
        result->SetValue(i - degree, knots[size_t(i)]);
    return result;
}

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

/// Filled field by field, not through a kernel surface: that way nothing between us and the file can touch a
/// number. OpenCASCADE scales shapes, not entities, so the poles are in the unit of the file here.
Handle(IGESGeom_BSplineSurface) entity_128(const NurbsSurface& surface, LengthUnit unit)
{
    const int last_u = surface.count_u - 1, last_v = surface.count_v - 1;
    Handle(TColStd_HArray2OfReal) weights = new TColStd_HArray2OfReal(0, last_u, 0, last_v);
    Handle(TColgp_HArray2OfXYZ) poles = new TColgp_HArray2OfXYZ(0, last_u, 0, last_v);
    for (int j = 0; j <= last_v; ++j)
        for (int i = 0; i <= last_u; ++i) {
            const Eigen::Vector3d point = surface.control.col(surface.index(i, j)) / millimetres(unit);
            poles->SetValue(i, j, gp_XYZ(point.x(), point.y(), point.z()));
            weights->SetValue(i, j, surface.weight[surface.index(i, j)]);
        }
    bool closed_u = true, closed_v = true;
    for (int j = 0; j <= last_v; ++j)
        closed_u &= surface.control.col(surface.index(0, j)) == surface.control.col(surface.index(last_u, j));
    for (int i = 0; i <= last_u; ++i)
        closed_v &= surface.control.col(surface.index(i, 0)) == surface.control.col(surface.index(i, last_v));
    const bool polynomial = (surface.weight.array() == surface.weight[0]).all();

    Handle(IGESGeom_BSplineSurface) entity = new IGESGeom_BSplineSurface;
    entity->Init(last_u, last_v, surface.degree_u, surface.degree_v, closed_u, closed_v, polynomial, false, false,
                 knots_from_minus_degree(surface.knots_u, surface.degree_u),
                 knots_from_minus_degree(surface.knots_v, surface.degree_v), weights, poles, surface.knots_u.front(),
                 surface.knots_u.back(), surface.knots_v.front(), surface.knots_v.back());
    return entity;
}

double largest_coordinate(std::span<const NurbsSurface> surfaces)
{
    double result = 0;
    for (const NurbsSurface& surface : surfaces)
        result = std::max(result, surface.control.cwiseAbs().maxCoeff());
    return result;
}

void fill_header(const Handle(IGESData_IGESModel) & model, const std::string& file_name, const std::string& part_name,
                 double largest, LengthUnit unit)
{
    IGESData_GlobalSection header = model->GlobalSection();
    const std::string date = time_stamp("%Y%m%d.%H%M%S");
    header.SetSendName(ascii(part_name));
    header.SetReceiveName(ascii(part_name));
    header.SetFileName(ascii(file_name));
    header.SetSystemId(text(program_name()));
    header.SetInterfaceVersion(text(program_name()));
    header.SetAuthorName(text(program_name())); // OpenCASCADE would put the login name here
    header.SetCompanyName(text(""));
    header.SetDate(text(date));
    header.SetLastChangeDate(text(date));
    header.SetResolution(1e-6 / millimetres(unit)); // readers take it as their tolerance
    header.SetMaxCoord(largest / millimetres(unit));
    model->SetGlobalSection(header);
}

std::string iges_text(std::span<const NurbsSurface> surfaces, const std::string& file_name,
                      const std::string& part_name, LengthUnit unit)
{
    const OcctSession session;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    Interface_Static::SetCVal("write.iges.unit", iges_name(unit));
    IGESControl_Writer collector(iges_name(unit), 0);
    for (const NurbsSurface& surface : surfaces)
        collector.AddEntity(entity_128(surface, unit));
    fill_header(collector.Model(), file_name, part_name, largest_coordinate(surfaces), unit);
    collector.ComputeModel();

    IGESData_IGESWriter writer(collector.Model());
    writer.FloatWriter().SetFormat("%.16E", true); // the default has 9 digits only
    writer.SendModel(Handle(IGESData_Protocol)::DownCast(collector.Model()->Protocol()));
    std::ostringstream stream;
    if (!writer.Print(stream))
        throw ExchangeError("OpenCASCADE could not make IGES text of the surface");
    return std::move(stream).str();
}

} // namespace

void write_iges(const std::filesystem::path& path, std::span<const NurbsSurface> surfaces, const std::string& part_name,
                LengthUnit unit)
{
    write_cad_file(path, surfaces, [&] { return iges_text(surfaces, path.filename().string(), part_name, unit); });
}

} // namespace spia
