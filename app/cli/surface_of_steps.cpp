#include "app/cli/surface_of_steps.h"

#include <chrono>
#include <fmt/core.h>

#include "app/cli/shown_chain.h"
#include "app/cli/terminal.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/pipeline/blank/part_bends.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/report/json/report_json.h"

namespace spia::cli {
namespace {

std::filesystem::path report_file(const UnfoldArguments& arguments)
{
    return arguments.folder / ((arguments.name.empty() ? arguments.part.stem().string() : arguments.name) + ".json");
}

} // namespace

void require_surface_place(const UnfoldArguments& arguments, const PartFile& part)
{
    if (arguments.surface.empty() || arguments.folder.empty())
        return;
    Session session;
    session.file = arguments.part;
    session.part = std::make_shared<PartFile>(part);
    OutputOptions wanted;
    wanted.name = arguments.name;
    wanted.dxf = dxf_options(arguments.dxf);
    require_place(session, arguments.folder, arguments.surface_formats, {arguments.json}, wanted);
    const auto report = report_file(arguments);
    if (!arguments.json.empty() && same_place(arguments.json, report))
        throw InputError(fmt::format("{} is where the report of the surface goes; give --json another name",
                                     arguments.json.string()));
}

ChainRun surface_of_steps(const UnfoldArguments& arguments, const PartFile& part, const UnfoldRun& run,
                          const FlattenOptions& options)
{
    Session session;
    session.file = arguments.part;
    session.part = std::make_shared<PartFile>(part);
    session.options.flatten = options;
    session.options.tolerance = arguments.tolerance;
    if (!arguments.k_factor.empty())
        session.options.k_factor = k_factor(arguments.k_factor);
    session.options.steps = {std::make_shared<UnfoldRun>(run), arguments.surface == "polished"};
    return run_shown(std::move(session), Stage::solve, Stage::fit);
}

std::vector<std::filesystem::path> write_surface(const UnfoldArguments& arguments, const ChainRun& made)
{
    if (!made.session.blank || arguments.folder.empty())
        return {};
    OutputOptions wanted;
    wanted.name = arguments.name;
    wanted.dxf = dxf_options(arguments.dxf);
    const auto clock = std::chrono::steady_clock::now();
    JobDisplay display{"write"};
    auto files = write_outputs(made.session, arguments.folder, arguments.surface_formats, wanted, display.progress());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    display.done(seconds);
    const auto report = report_file(arguments);
    write_atomically(report, report_json(made.session, files, seconds, made.failure));
    files.push_back(report);
    return files;
}

} // namespace spia::cli
