#include <fmt/core.h>

#include <numbers>

#include "app/cli/commands.h"
#include "engine/core/error.h"
#include "engine/exchange/part_formats.h"
#include "engine/pipeline/files/seam_file.h"

namespace spia::cli {
namespace {

CadOptions cad_options(const CadArguments& arguments, const std::filesystem::path& part)
{
    const bool any = arguments.sewing || arguments.deflection || arguments.angle_deg || arguments.skip_bad_faces;
    if (any && kind_of_file(part) != FileKind::cad)
        throw InputError(
            fmt::format("{}: --sewing, --deflection, --angle and --skip-bad-faces are for CAD files; this one "
                        "has its triangles already",
                        part.string()));
    CadOptions options;
    options.sewing_tolerance = arguments.sewing;
    options.deflection = arguments.deflection;
    if (arguments.angle_deg)
        options.angle = *arguments.angle_deg * std::numbers::pi / 180;
    options.leave_out_unmeshed = arguments.skip_bad_faces;
    return options;
}

/// Whether the part is remeshed, and what its triangles should be like.
void set_remeshing(ReadOptions& options, const RemeshArguments& arguments)
{
    if (arguments.wanted) {
        options.remesh.emplace();
        options.remesh->size = arguments.size;
        options.remesh->tolerance = arguments.tolerance;
    }
    options.cad.keep_triangles = arguments.unwanted;
    if (arguments.least_angle_deg)
        options.targets.least_angle = *arguments.least_angle_deg * std::numbers::pi / 180;
    options.targets.edge_ratio = arguments.edge_ratio;
}

} // namespace

ReadOptions read_options(const ReadArguments& arguments, const std::filesystem::path& part)
{
    ReadOptions options;
    if (!arguments.unit.empty())
        options.unit = length_unit(arguments.unit);
    if (arguments.weld) {
        options.weld = true;
        if (*arguments.weld > 0)
            options.doctor.weld_gap = *arguments.weld;
    }
    options.parts = arguments.parts;
    options.cad = cad_options(arguments.cad, part);
    options.doctor.keep_largest = arguments.keep_largest;
    if (!arguments.skin.empty())
        options.skin = skin_by_name(arguments.skin);
    options.seam = seam_options(arguments.seam);
    set_remeshing(options, arguments.remesh);
    return options;
}

} // namespace spia::cli
