#include "app/cli/add_option.h"
#include "app/cli/part_arguments.h"
#include "app/cli/subcommand.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/outputs/outputs.h"

namespace spia::cli {
namespace {

void add_sheet(CLI::App& command, RunArguments& run)
{
    add(command, option::material, run.material);
    add(command, option::thickness, run.thickness);
    add(command, option::both_skins, run.skins);
    add(command, option::flc, run.flc);
    add(command, option::flc_n, run.flc_n);
    add(command, option::marginal, run.marginal);
    add(command, option::max_thinning, run.max_thinning);
    add(command, option::max_thickening, run.max_thickening);
    add(command, option::process, run.process);
    add_direction(command, run.direction);
    add_rolling(command, run.rolling);
}

void add_surface(CLI::App& command, RunArguments& run)
{
    add(command, option::grid, run.cells);
    for_each_described(run.grid, [&](const Option& option, auto& value) {
        if (!option.name.empty())
            add(command, option, value);
    });
    add(command, option::corners, run.corners)->delimiter(',')->expected(4);
    add(command, option::tolerance, run.tolerance);
    add(command, option::patches, run.patches);
    add(command, option::patch_edges, run.patch_edges);
    add(command, option::smooth_joins, run.smooth_joins);
    add(command, option::deform, run.deform);
    add(command, option::degree, run.degree)->delimiter(',')->expected(1, 2);
    add(command, option::ends, run.ends);
    add(command, option::fit_parameters, run.fit_parameters);
    add(command, option::max_control_points, run.max_control_points);
    add(command, option::fill_holes, run.fill_holes);
}

void add_files(CLI::App& command, RunArguments& run)
{
    run.formats = usual_formats();
    add_list(command, "--formats", run.formats, output_formats(),
             "files to write; for isogeometric analysis the surface with thickness and plastic strain: gismo (G+Smo "
             "XML), mfem, geopdes (no fields), iga-k (LS-DYNA, mean thickness); for solver decks, with their ids: "
             "dynain (LS-DYNA), nastran, mapping (CSV): thickness and plastic strain of the elements; blank-k, -bdf, "
             "-inp, -msh: the blank as a mesh");
    command
        .add_option("--export-unit", run.export_unit,
                    "of IGES, STEP, isogeometric files, DXF, CSV and VTU (glTF: always metres)")
        ->check(CLI::IsMember(names_of(option::unit)))
        ->capture_default_str();
    add_dxf(command, run.dxf);
    add_list(command, "--glb-nodes", run.glb_nodes, run.glb_nodes, "what the GLB file shows");
    add_list(command, "--csv-tables", run.csv_tables, run.csv_tables, "which CSV files");
    command.add_option("--name", run.name, "of the files, without ending (default: the part's)");
    command.add_option("--json", run.json, "write the figures of the run")->type_name("FILE");
    command
        .add_option("--report", run.report,
                    "write a report to print or pass on: figures, warnings, assumptions, pictures, in one HTML file "
                    "(in inch with --export-unit inch, else in mm)")
        ->type_name("FILE.html");
    command.add_flag("--strict", run.strict, "exit 1 if the result has shortcomings");
}

} // namespace

void add_arguments(CLI::App& command, RunArguments& run)
{
    add_part(command, run.part);
    command.add_option("--out", run.folder, "folder for the files")->type_name("DIR")->capture_default_str();
    add_reading(command, run.read);
    add_remesh(command, run.read.remesh);
    add(command, option::k_factor, run.k_factor);
    add_sheet(command, run);
    add_surface(command, run);
    add_files(command, run);
}

} // namespace spia::cli
