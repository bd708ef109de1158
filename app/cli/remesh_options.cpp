#include "app/cli/commands.h"

#include <numbers>

namespace spia::cli {

std::optional<RemeshOptions> remesh_options(const RemeshArguments& arguments)
{
    if (!arguments.wanted)
        return std::nullopt;
    RemeshOptions options;
    options.size = arguments.size;
    options.tolerance = arguments.tolerance;
    return options;
}

MeshTargets mesh_targets(const RemeshArguments& arguments)
{
    MeshTargets targets;
    if (arguments.least_angle_deg)
        targets.least_angle = *arguments.least_angle_deg * std::numbers::pi / 180;
    targets.edge_ratio = arguments.edge_ratio;
    return targets;
}

} // namespace spia::cli
