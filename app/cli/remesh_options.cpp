#include "app/cli/commands.h"

#include <numbers>

namespace spia::cli {

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

void set_welding(ReadOptions& options, std::optional<double> gap)
{
    if (!gap)
        return;
    options.weld = true;
    if (*gap > 0)
        options.doctor.weld_gap = *gap;
}

} // namespace spia::cli
