#include "app/cli/add_option.h"
#include "app/cli/part_arguments.h"
#include "app/cli/subcommand.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/outputs/unfold_outputs.h"

namespace spia::cli {
namespace {

/// Which steps are done.
void add_steps(CLI::App& command, UnfoldArguments& unfolding)
{
    CLI::Option* by_script =
        command.add_option("--script", unfolding.script, "the steps (JSON, engine/pipeline/README.md)")
            ->type_name("FILE");
    command
        .add_flag("--auto", unfolding.automatic,
                  "steps proposed by the program; with --out they are written as a script that can be edited")
        ->excludes(by_script);
    command
        .add_option("--redo", unfolding.redo,
                    "with --script: the states of steps that were done are taken from an earlier run with this --out; "
                    "auto: as many as are the same, N: those before step N")
        ->type_name("auto|N");
    command.add_option("--root", unfolding.root, "with --auto: the region that stays (default: the largest flat one)")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000))
        ->excludes(by_script);
}

void add_files(CLI::App& command, UnfoldArguments& unfolding)
{
    command
        .add_option("--out", unfolding.folder,
                    "folder for the states, trim lines, the blank with its bend lines and the script")
        ->type_name("DIR");
    unfolding.formats = unfold_formats();
    add_list(command, "--formats", unfolding.formats, all_unfold_formats(),
             "of the files: VTU for states, DXF, IGES and STEP for lines, states for --redo; blank-k, -bdf, -inp and "
             "-msh: the blank as a mesh with the ids of the deck");
    add_dxf(command, unfolding.dxf);
    command
        .add_option("--to-part", unfolding.to_part,
                    "lines drawn on the blank (DXF or JSON, mm): written as they lie on the part")
        ->type_name("FILE");
    command
        .add_option("--to-blank", unfolding.to_blank,
                    "lines that lie on the part (DXF or JSON, mm): written as they lie on the blank")
        ->type_name("FILE");
    command.add_option("--name", unfolding.name, "of the files, without ending (default: the part's)");
    command.add_option("--json", unfolding.json, "write the figures of the run")->type_name("FILE");
}

void add_surface(CLI::App& command, UnfoldArguments& unfolding)
{
    command.add_flag("--surface{steps}", unfolding.surface,
                     "also grid and NURBS surface of the blank of the steps (--surface=polished: of the polished one), "
                     "with --out written as by `spia run`, and its report as NAME.json");
    add(command, option::tolerance, unfolding.tolerance);
    unfolding.surface_formats = usual_formats();
    add_list(command, "--surface-formats", unfolding.surface_formats, output_formats(), "of these files");
}

} // namespace

void add_arguments(CLI::App& command, UnfoldArguments& unfolding)
{
    add_part(command, unfolding.part);
    add_steps(command, unfolding);
    add_files(command, unfolding);
    add(command, option::material, unfolding.material);
    add(command, option::thickness, unfolding.thickness);
    add_rolling(command, unfolding.rolling);
    add_reading(command, unfolding.read);
    add_remesh(command, unfolding.read.remesh);
    add(command, option::k_factor, unfolding.k_factor);
    command.add_flag("--polish", unfolding.polish,
                     "also solve the whole part in one step, starting from the blank of the steps, and compare both "
                     "blanks");
    add_surface(command, unfolding);
    command.add_flag("--strict", unfolding.strict, "exit 1 if the result has shortcomings or a script did not fit");
}

} // namespace spia::cli
