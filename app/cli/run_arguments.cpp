#include "app/cli/add_option.h"
#include "app/cli/part_arguments.h"
#include "app/cli/subcommand.h"
#include "engine/pipeline/outputs/outputs.h"

namespace spia::cli {
namespace {

/// Of sheet and surface; the help lists them in the order in which they are described.
void add_described(CLI::App& command, RunArguments& run)
{
    const auto add_of_grid = [&command](const Option& option, auto& value) {
        if (!option.name.empty())
            add(command, option, value);
    };
    for_each_described(run, [&](const Option& option, auto& value) {
        CLI::Option* added = add(command, option, value);
        if (&option == &option::corners)
            added->delimiter(',')->expected(4);
        else if (&option == &option::degree)
            added->delimiter(',')->expected(1, 2);
        else if (&option == &option::grid)
            for_each_described(run.grid, add_of_grid);
    });
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
    add_direction(command, run.direction);
    add_rolling(command, run.rolling);
    add_described(command, run);
    add_files(command, run);
}

} // namespace spia::cli
