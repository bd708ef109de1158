#include "app/cli/part_arguments.h"

#include "app/cli/add_option.h"
#include "engine/exchange/part_formats.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"

namespace spia::cli {

void add_part(CLI::App& command, std::filesystem::path& part)
{
    command.add_option("part", part, part_format_endings())->required()->type_name("PART");
}

void add_reading(CLI::App& command, ReadArguments& read)
{
    add(command, option::part, read.parts)->delimiter(',')->allow_extra_args(false);
    // what is wrong with these the reader says in its own words
    add_unchecked(command, option::sewing, read.cad.sewing);
    add_unchecked(command, option::deflection, read.cad.deflection);
    add(command, option::chord_angle, read.cad.angle_deg);
    add(command, option::skip_bad_faces, read.cad.skip_bad_faces);
    add(command, option::skin, read.skin);
    add(command, option::unit, read.unit);
    add(command, option::weld, read.weld);
    add(command, option::keep_largest, read.keep_largest);
    add(command, option::seam, read.seam);
}

void add_remesh(CLI::App& command, RemeshArguments& remesh)
{
    CLI::Option* wanted = add(command, option::remesh, remesh.wanted);
    add(command, option::no_remesh, remesh.unwanted)->excludes(wanted);
    add(command, option::remesh_size, remesh.size)->needs(wanted);
    add(command, option::remesh_tolerance, remesh.tolerance)->needs(wanted);
    add(command, option::least_angle, remesh.least_angle_deg);
    add(command, option::edge_ratio, remesh.edge_ratio);
}

void add_rolling(CLI::App& command, std::vector<double>& rolling)
{
    add(command, option::rolling, rolling)->delimiter(',')->expected(3);
}

void add_direction(CLI::App& command, std::vector<double>& direction)
{
    add(command, option::direction, direction)->delimiter(',')->expected(3);
}

void add_dxf(CLI::App& command, DxfArguments& dxf)
{
    command
        .add_option("--dxf-curves", dxf.curves,
                    "curves of the outline in the DXF file of the blank: circles, arcs and lines where they are found, "
                    "else straight pieces (arcs) or splines (splines); or straight pieces throughout (polylines)")
        ->check(CLI::IsMember({"arcs", "polylines", "splines"}))
        ->capture_default_str();
    command.add_option("--dxf-version", dxf.version, "of that file: r12 (AC1009, no splines) or r2000 (AC1015)")
        ->check(CLI::IsMember({"r12", "r2000"}))
        ->capture_default_str();
    command
        .add_option("--dxf-tolerance", dxf.tolerance, "largest distance of the outline from the curves drawn for it")
        ->type_name("MM")
        ->capture_default_str();
}

CLI::Option* add_list(CLI::App& command, const char* name, std::vector<std::string>& chosen,
                      const std::vector<std::string>& all, const char* help)
{
    return command.add_option(name, chosen, help)
        ->delimiter(',')
        ->check(CLI::IsMember(all))
        ->type_name("LIST")
        ->capture_default_str();
}

} // namespace spia::cli
