#include <fmt/core.h>

#include <numbers>

#include "app/cli/commands.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/exchange/cad/read_cad.h"

namespace spia::cli {

CadOptions cad_options(const CadArguments& arguments, const std::filesystem::path& part)
{
    const std::string extension = lower_case(part.extension().string());
    const bool any = arguments.sewing || arguments.deflection || arguments.angle_deg || arguments.skip_bad_faces;
    if (any && !is_cad(extension))
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

} // namespace spia::cli
