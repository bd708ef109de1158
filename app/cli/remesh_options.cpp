#include "app/cli/commands.h"

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

} // namespace spia::cli
