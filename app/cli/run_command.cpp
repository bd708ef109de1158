#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "app/cli/commands.h"
#include "app/cli/print_summary.h"
#include "app/cli/shown_chain.h"
#include "app/cli/terminal.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/blank/part_bends.h"
#include "engine/pipeline/files/deform_file.h"
#include "engine/pipeline/files/patch_file.h"
#include "engine/pipeline/files/process_file.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/report/html/html_report.h"
#include "engine/report/html/report_pictures.h"
#include "engine/report/json/report_json.h"

namespace spia::cli {
namespace {

LimitsOptions limits_options(const RunArguments& arguments)
{
    using Source = LimitsOptions::Source;
    LimitsOptions result;
    if (arguments.flc == "keeler-brazier")
        result.source = Source::keeler_brazier;
    else if (arguments.flc == "none")
        result.source = Source::none;
    else if (arguments.flc != "automatic") {
        result.source = Source::points;
        result.curve = read_forming_limit_curve(arguments.flc);
    }
    result.n = arguments.flc_n;
    if (arguments.marginal)
        result.margin = *arguments.marginal / 100;
    result.zones.max_thinning = arguments.max_thinning / 100;
    result.zones.max_thickening = arguments.max_thickening / 100;
    return result;
}

/// Options of the sheet and of the surface that are not as by default.
std::vector<const Option*> changed_options(const RunArguments& arguments)
{
    std::vector<const Option*> changed;
    const auto add = [&changed](const Option& option) { changed.push_back(&option); };
    for_each_changed(arguments, add);
    for_each_changed(arguments.grid, add);
    return changed;
}

/// Whether what was given is for one patch, the plain surface over the whole blank.
bool asks_for_one_patch(const RunArguments& arguments)
{
    const auto for_one = [](const Option* option) { return option->patches == Patches::one; };
    return std::ranges::any_of(changed_options(arguments), for_one) || !arguments.deform.empty() ||
           arguments.degree.front() != arguments.degree.back();
}

/// @param wanted  what comes of the arguments
/// @throws InputError  if something was given that the surface has no use for
void require_use(const RunArguments& arguments, const SessionOptions& wanted)
{
    const bool several = wanted.patches.has_value();
    for (const Option* option : changed_options(arguments)) {
        if (several && option->patches == Patches::one)
            throw InputError(fmt::format("--{} is for one patch; take --patches one{}, or leave it out", option->name,
                                         option == &option::corners ? ", give corners in the file of --patches" : ""));
        if (!several && option->patches == Patches::several)
            throw InputError(fmt::format(
                "--{} is for several patches; ask for them with --patches auto, or leave it out", option->name));
        if (option->within_tolerance && !several && !wanted.best_surface && !wanted.tolerance)
            throw InputError(fmt::format("--{} is for a surface within a tolerance; give --tolerance, or leave it out",
                                         option->name));
    }
    if (several && arguments.degree.front() != arguments.degree.back())
        throw InputError("several patches have one degree along u and v; give --degree one number");
}

SessionOptions options(const RunArguments& arguments)
{
    SessionOptions result;
    result.read = read_options(arguments.read, arguments.part);
    if (!arguments.k_factor.empty())
        result.k_factor = k_factor(arguments.k_factor);
    require_one_surface(arguments.k_factor, arguments.read.skin);
    result.flatten.material = find_material(arguments.material, assets() / "materials");
    if (arguments.thickness) // else that of the deck, once it is read
        result.flatten.thickness = *arguments.thickness;
    result.flatten.skins = arguments.skins;
    if (!arguments.direction.empty())
        result.flatten.direction =
            Eigen::Vector3d(arguments.direction[0], arguments.direction[1], arguments.direction[2]);
    rolling_direction(arguments.rolling); // before the work
    if (!arguments.corners.empty())
        result.corners = {arguments.corners[0], arguments.corners[1], arguments.corners[2], arguments.corners[3]};
    result.grid = arguments.grid;
    if (!arguments.cells.empty()) {
        int n = 0, m = 0, read = 0;
        if (std::sscanf(arguments.cells.c_str(), "%4dx%4d%n", &n, &m, &read) != 2 ||
            read != int(arguments.cells.size()) || n < 1 || m < 1 || n > 2000 || m > 2000)
            throw InputError(
                fmt::format("--grid {}: give two numbers of cells from 1 to 2000 as in --grid 60x40", arguments.cells));
        result.grid.columns = n;
        result.grid.rows = m;
    }
    result.limits = limits_options(arguments);
    result.interpolate.ends = arguments.ends;
    result.interpolate.degree_u = arguments.degree.front();
    result.interpolate.degree_v = arguments.degree.back();
    result.tolerance = arguments.tolerance;
    result.patches = patch_layout(arguments.patches);
    result.best_surface = arguments.patches == "best" && !asks_for_one_patch(arguments);
    require_use(arguments, result);
    if (arguments.smooth_joins)
        result.patches->smooth_joins = true;
    if (arguments.patch_edges && (!result.patches->cuts.empty() || !result.patches->corners.empty()))
        throw InputError(
            "--patch-edges is not for layouts with cuts or corners, where no edges are looked for; leave it out");
    if (arguments.patch_edges)
        result.patches->edge_deg = *arguments.patch_edges;
    result.fit_parameters = arguments.fit_parameters;
    result.max_control_points = arguments.max_control_points;
    result.fill_holes = arguments.fill_holes;
    return result;
}

OutputOptions output_options(const RunArguments& arguments)
{
    const auto among = [](const std::vector<std::string>& list, const char* name) {
        return std::find(list.begin(), list.end(), name) != list.end();
    };
    const auto& nodes = arguments.glb_nodes;
    OutputOptions result;
    result.dxf = dxf_options(arguments.dxf);
    result.unit = length_unit(arguments.export_unit);
    result.name = arguments.name;
    result.glb = {among(nodes, "part"), among(nodes, "blank"), among(nodes, "quad_mesh"), among(nodes, "surface"),
                  among(nodes, "control_net")};
    result.csv = {among(arguments.csv_tables, "fields"), among(arguments.csv_tables, "outline"),
                  among(arguments.csv_tables, "faces")};
    return result;
}

/// @throws InputError  as read_process(); if its file and the command line both give a rolling
///                     direction
ProcessConditions process_of(const RunArguments& arguments, const PartFile& part, const FlattenOptions& sheet)
{
    ProcessConditions process = sheet.process;
    if (!arguments.process.empty())
        process = read_process(arguments.process, part, sheet.material, sheet.thickness, assets() / "materials");
    const auto rolling = rolling_direction(arguments.rolling);
    if (rolling && process.rolling)
        throw InputError(
            fmt::format("--rolling and {} both give a rolling direction; leave one out", arguments.process.string()));
    if (rolling)
        process.rolling = rolling;
    return process;
}

/// What hangs on the part or its surface.
/// @throws InputError  if the file of the deformation is at fault
ChainWishes wishes_of(const RunArguments& arguments)
{
    ChainWishes result;
    result.thickness = arguments.thickness;
    result.process = [&arguments](const PartFile& part, const FlattenOptions& sheet) {
        return process_of(arguments, part, sheet);
    };
    if (!arguments.deform.empty())
        result.deformation = read_deformation(arguments.deform);
    return result;
}

/// The last stage that something that was asked for needs: who wants the blank alone waits for no
/// surface, and reads no warning of one.
Stage last_stage(const RunArguments& arguments)
{
    const bool files =
        std::ranges::any_of(arguments.formats, shows_surface) || !arguments.json.empty() || !arguments.report.empty();
    const bool asked = std::ranges::any_of(changed_options(arguments), [](const Option* option) {
        return std::ranges::find(option::of_surfaces, option) != std::end(option::of_surfaces);
    });
    return files || asked ? Stage::fit : Stage::solve;
}

void say_of_reading(const RunArguments& arguments, const PartFile& part)
{
    for (const std::string& line : reading_notes(part))
        say("  {}\n", line);
    if (const std::string text = describe_thickness(arguments.thickness, part); !text.empty())
        say("  note: {}\n", text);
}

/// @param poorer  shortcomings of the session
void write_report(const RunArguments& arguments, const Session& session, const std::vector<std::string>& poorer,
                  const std::optional<Failure>& failure)
{
    ReportOptions options;
    options.reader.lengths = length_unit(arguments.export_unit) == LengthUnit::inch ? LengthUnit::inch : LengthUnit::mm;
    std::vector<std::string> doubts = poorer;
    if (failure)
        doubts.insert(doubts.begin(),
                      fmt::format("the stage {} has no result: {}", name(failure->stage), failure->message));
    write_html_report(arguments.report, session, drawn_pictures(session, options.reader.lengths), options, doubts);
}

/// Writes the files and the report of a run with a blank: that is worth it, whatever came of the
/// stages after it. @returns its shortcomings
std::vector<std::string> write_and_report(const RunArguments& arguments, const ChainRun& made,
                                          const OutputOptions& wanted)
{
    const Session& session = made.session;
    const auto clock = std::chrono::steady_clock::now();
    JobDisplay display{"write"};
    const auto files = write_outputs(session, arguments.folder, arguments.formats, wanted, display.progress());
    const double write_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    display.done(write_seconds);
    if (!arguments.json.empty())
        write_atomically(arguments.json, report_json(session, files, write_seconds, made.failure));

    std::vector<std::string> poorer = shortcomings(session);
    if (!arguments.report.empty())
        write_report(arguments, session, poorer, made.failure);

    print_summary(session);
    for (const auto& file : files)
        say("wrote     {}\n", file.string());
    if (!arguments.report.empty())
        say("wrote     {}\n", arguments.report.string());
    for (const std::string& text : poorer)
        say("WARNING   {}\n", text);
    return poorer;
}

} // namespace

DxfOptions dxf_options(const DxfArguments& arguments)
{
    DxfOptions options;
    options.version = dxf_version(arguments.version);
    options.curves = dxf_curves(arguments.curves);
    options.tolerance = arguments.tolerance;
    if (options.version == DxfVersion::r12 && options.curves == DxfCurves::splines)
        throw InputError(
            "DXF files of version 12 have no splines; give --dxf-curves arcs or polylines, or --dxf-version r2000");
    if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
        throw InputError("--dxf-tolerance is a distance in mm, 0 or more");
    return options;
}

std::optional<Eigen::Vector3d> rolling_direction(const std::vector<double>& numbers)
{
    if (numbers.empty())
        return std::nullopt;
    const Eigen::Vector3d direction(numbers[0], numbers[1], numbers[2]);
    if (!direction.allFinite() || !(direction.norm() > 0))
        throw InputError("--rolling needs a direction x,y,z of three finite numbers that are not all 0");
    return direction;
}

int run(const RunArguments& arguments)
{
    Session session;
    session.file = arguments.part;
    session.options = options(arguments);
    const OutputOptions wanted = output_options(arguments);
    require_file_name(wanted.name); // before the work
    const auto begin_with_part = [&](const Session& read) {
        say_of_reading(arguments, *read.part);
        require_possible(read);
        require_place(read, arguments.folder, arguments.formats, {arguments.json, arguments.report}, wanted);
    };
    const ChainRun made =
        run_shown(std::move(session), Stage::read, last_stage(arguments), wishes_of(arguments), begin_with_part);
    if (!made.session.blank) {
        if (!arguments.report.empty())
            say("report    not written: there is no blank\n");
        std::rethrow_exception(made.error);
    }
    const std::vector<std::string> poorer = write_and_report(arguments, made, wanted);
    if (made.error)
        std::rethrow_exception(made.error);
    return arguments.strict && !poorer.empty() ? 1 : 0;
}

} // namespace spia::cli
