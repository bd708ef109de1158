#include "engine/exchange/cad/read_surfaces.h"

#include <BRep_Tool.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <fmt/core.h>
#include <fstream>

#include "engine/core/error.h"
#include "engine/exchange/cad/cad_damage.h"
#include "engine/exchange/cad/iges_check.h"
#include "engine/exchange/cad/occt_session.h"
#include "engine/exchange/cad/occt_surface.h"

namespace spia {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why)
{
    throw ExchangeError(fmt::format("cannot read {}: {}; export it again", path.string(), why));
}

std::ifstream opened(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path))
        refuse(path, "it cannot be opened");
    return file;
}

NurbsSurface surface_under(const TopoDS_Face& face, int number)
{
    Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface); !trimmed.IsNull())
        surface = trimmed->BasisSurface();
    const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface);
    if (spline.IsNull())
        throw InputError(
            fmt::format("face {} of the file is a {}, not a B-spline surface; import the file as a part instead",
                        number, surface->DynamicType()->Name()));
    return from_occt(*spline);
}

std::vector<NurbsSurface> surfaces_of(XSControl_Reader& reader, const std::filesystem::path& path)
{
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
        refuse(path, "OpenCASCADE finds no model in it");
    if (const CadDamage damage = damage_in(reader); !damage.fatal.empty())
        refuse(path, "OpenCASCADE finds it damaged: " + damage.fatal);
    reader.TransferRoots();
    std::vector<NurbsSurface> surfaces;
    for (TopExp_Explorer face(reader.OneShape(), TopAbs_FACE); face.More(); face.Next())
        surfaces.push_back(surface_under(TopoDS::Face(face.Current()), int(surfaces.size())));
    if (surfaces.empty())
        refuse(path, "it holds no face");
    return surfaces;
}

template <class Reader> std::vector<NurbsSurface> read(const std::filesystem::path& path)
{
    const OcctSession session;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    try {
        Reader reader;
        return surfaces_of(reader, path);
    } catch (const Standard_Failure& failure) {
        refuse(path, fmt::format("OpenCASCADE says \"{}\"", failure.GetMessageString()));
    }
}

} // namespace

std::vector<NurbsSurface> read_iges_surfaces(const std::filesystem::path& path)
{
    std::ifstream file = opened(path);
    if (const std::string fault = fault_of_iges(file); !fault.empty())
        refuse(path, fault);
    return read<IGESControl_Reader>(path);
}

std::vector<NurbsSurface> read_step_surfaces(const std::filesystem::path& path)
{
    opened(path);
    return read<STEPControl_Reader>(path);
}

} // namespace spia
