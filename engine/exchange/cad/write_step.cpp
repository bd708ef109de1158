#include "engine/exchange/cad/write_step.h"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRep_Builder.hxx>
#include <StepShape_AdvancedFace.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/exchange/cad/occt_step.h"
#include "engine/exchange/cad/occt_surface.h"
#include "engine/exchange/cad/trimmed_face.h"
#include "engine/options/part_options.h"

namespace spia {
namespace {

/// @param faces  counted
TopoDS_Shape open_shell(std::span<const NurbsSurface> surfaces, std::span<const std::vector<TrimLoop>> holes,
                        size_t& faces)
{
    TopoDS_Shell shell;
    BRep_Builder builder;
    builder.MakeShell(shell);
    BRepBuilderAPI_Sewing sewing(step_resolution);
    faces = 0;
    for (size_t i = 0; i < surfaces.size(); ++i)
        for (const TopoDS_Face& face :
             trimmed_faces(surfaces[i], i < holes.size() ? holes[i] : std::vector<TrimLoop>())) {
            builder.Add(shell, face);
            sewing.Add(face);
            ++faces;
        }
    if (faces == 1)
        return shell;
    sewing.Perform();
    return sewing.SewedShape();
}

/// What is as small as the resolution is left out without a word.
void require_faces(const StepData_StepModel& model, size_t wanted)
{
    size_t faces = 0;
    for (int i = 1; i <= model.NbEntities(); ++i)
        faces += model.Value(i)->IsKind(STANDARD_TYPE(StepShape_AdvancedFace));
    if (faces != wanted)
        throw ExchangeError(
            fmt::format("OpenCASCADE put {} of {} surfaces into the STEP file; they may be smaller than its "
                        "resolution of {} mm: check the length unit of the part ({})",
                        faces, wanted, step_resolution, mention(option::unit)));
}

} // namespace

void write_step(const std::filesystem::path& path, std::span<const NurbsSurface> surfaces, const std::string& part_name,
                LengthUnit unit, std::span<const std::vector<TrimLoop>> holes)
{
    write_cad_file(path, surfaces, [&] {
        size_t faces = 0;
        return step_text([&] { return open_shell(surfaces, holes, faces); }, STEPControl_ShellBasedSurfaceModel,
                         [&](const StepData_StepModel& model) { require_faces(model, faces); },
                         path.filename().string(), part_name, unit);
    });
}

} // namespace spia
