#include "app/cli/add_option.h"
#include "app/cli/part_arguments.h"
#include "app/cli/subcommand.h"
#include "engine/compare/compare.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"

namespace spia::cli {

void add_arguments(CLI::App& command, InfoArguments& info)
{
    add_part(command, info.part);
    add_reading(command, info.read);
    add_remesh(command, info.read.remesh);
    command.add_option("--json", info.json, "write the findings")->type_name("FILE");
}

void add_arguments(CLI::App& command, CompareArguments& comparison)
{
    for (const FlatMethod method : flat_methods)
        comparison.methods.emplace_back(name(method));
    add_part(command, comparison.part);
    add_list(command, "--methods", comparison.methods, comparison.methods, "which, in this order");
    command.add_flag("--markdown", comparison.markdown, "print the table as Markdown");
    command.add_option("--json", comparison.json, "write the figures, with their definitions")->type_name("FILE");
    add(command, option::material, comparison.material);
    add(command, option::thickness, comparison.thickness);
    add_direction(command, comparison.direction);
    add_reading(command, comparison.read);
}

void add_arguments(CLI::App& command, FitArguments& fit)
{
    command.add_option("table", fit.table, "the test; columns separated by ';', ',', tabs or blanks")
        ->required()
        ->type_name("FILE.csv");
    command.add_option("--out", fit.out, "the material file")->required()->type_name("GRADE.json");
    command.add_option("--law", fit.law, "hardening law; best weighs the error against the number of parameters")
        ->check(CLI::IsMember({"best", "swift", "hollomon", "voce", "ludwik", "hockett_sherby", "swift_voce"}))
        ->capture_default_str();
    command.add_option("--name", fit.name, "of the grade (default: the file's)");
    command.add_option("--r", fit.r, "Lankford coefficients r0,r45,r90 (a tensile curve does not contain them)")
        ->delimiter(',')
        ->expected(3)
        ->check(CLI::Range(1e-3, 99.0))
        ->type_name("r0,r45,r90")
        ->capture_default_str();
    add(command, option::stress_measure, fit.data);
    add(command, option::strain_unit, fit.strain);
    add(command, option::young, fit.young);
    add(command, option::poisson, fit.poisson);
    add(command, option::density, fit.density);
}

} // namespace spia::cli
