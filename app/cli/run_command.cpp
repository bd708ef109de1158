#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <exception>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "engine/core/error.h"
#include "engine/exchange/atomic_file.h"
#include "engine/forming/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/applied_process.h"
#include "engine/pipeline/outputs.h"
#include "engine/pipeline/process_file.h"
#include "engine/pipeline/report.h"
#include "engine/pipeline/seam_file.h"

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

SessionOptions options(const RunArguments& arguments)
{
    SessionOptions result;
    if (!arguments.unit.empty())
        result.read.unit = length_unit(arguments.unit);
    if (arguments.weld)
        result.read.weld = true;
    result.read.parts = arguments.parts;
    result.read.doctor.keep_largest = arguments.keep_largest;
    result.read.seam = seam_options(arguments.seam);
    result.flatten.material = find_material(arguments.material, assets() / "materials");
    if (arguments.thickness) // else that of the deck, once it is read
        result.flatten.thickness = *arguments.thickness;
    result.flatten.skins = arguments.skins;
    if (!arguments.direction.empty())
        result.flatten.direction =
            Eigen::Vector3d(arguments.direction[0], arguments.direction[1], arguments.direction[2]);
    if (!arguments.corners.empty())
        result.corners = {arguments.corners[0], arguments.corners[1], arguments.corners[2], arguments.corners[3]};
    if (!arguments.grid.empty()) {
        int n = 0, m = 0, read = 0;
        if (std::sscanf(arguments.grid.c_str(), "%4dx%4d%n", &n, &m, &read) != 2 ||
            read != int(arguments.grid.size()) || n < 1 || m < 1 || n > 2000 || m > 2000)
            throw InputError(
                fmt::format("--grid {}: give two numbers of cells from 1 to 2000 as in --grid 60x40", arguments.grid));
        result.grid.columns = n;
        result.grid.rows = m;
    }
    result.limits = limits_options(arguments);
    result.grid.method = arguments.grid_method == "coons"      ? GridMethod::coons
                         : arguments.grid_method == "harmonic" ? GridMethod::harmonic
                                                               : GridMethod::automatic;
    if (arguments.ends == "natural")
        result.interpolate.ends = InterpolateOptions::Ends::natural;
    return result;
}

OutputOptions output_options(const RunArguments& arguments)
{
    const auto among = [](const std::vector<std::string>& list, const char* name) {
        return std::find(list.begin(), list.end(), name) != list.end();
    };
    const auto& nodes = arguments.glb_nodes;
    OutputOptions result;
    result.unit = length_unit(arguments.export_unit);
    result.name = arguments.name;
    result.glb = {among(nodes, "part"), among(nodes, "blank"), among(nodes, "quad_mesh"), among(nodes, "surface"),
                  among(nodes, "control_net")};
    result.csv = {among(arguments.csv_tables, "fields"), among(arguments.csv_tables, "outline"),
                  among(arguments.csv_tables, "faces")};
    return result;
}

void print_spots(const Zones& zones, const PartFile& part)
{
    constexpr size_t most = 3;
    for (size_t k = 0; k < std::min(most, zones.spots.size()); ++k) {
        const WorstSpot& spot = zones.spots[k];
        const bool by_curve = spot.zone >= Zone::marginal;
        fmt::print("{} {:<18} face {} at {:.4g}, {:.4g}, {:.4g} mm: {} {:+.1f} %, strains {:.3f} and {:.3f}\n",
                   k == 0 ? "worst    " : "         ", name(spot.zone), part.source_face[size_t(spot.face)],
                   spot.position[0], spot.position[1], spot.position[2],
                   by_curve                                ? "left to the curve"
                   : spot.zone == Zone::excessive_thinning ? "thinning"
                                                           : "thickening",
                   100 * spot.value, spot.strain_major, spot.strain_minor);
    }
}

void print_limits(const LimitsResult& limits, const PartFile& part)
{
    if (limits.curve)
        fmt::print("limits    FLC0 {:.1f} %, {}\n", 100 * engineering_strain(limits.curve->at_plane_strain()),
                   limits.curve->formula.substr(0, limits.curve->formula.find(':')));
    else
        fmt::print("limits    no forming limit curve\n");
    for (const Zone zone : all_zones)
        if (const ZoneShare& share = limits.zones.share[size_t(zone)]; share.faces > 0)
            fmt::print("          {:<18} {:>7} faces, {:5.1f} % of the area\n", name(zone), share.faces,
                       100 * share.share);
    print_spots(limits.zones, part);
    for (const std::string& note : limits.notes)
        fmt::print("  note: {}\n", note);
}

void print_summary(const Session& session)
{
    const TriMesh& part = session.part->mesh;
    const FlattenResult& flat = *session.blank;
    const Eigen::Vector2d size = flat.blank.position.rowwise().maxCoeff() - flat.blank.position.rowwise().minCoeff();
    fmt::print("part      {} triangles, {} boundary loops, {:.6g} mm2\n", part.triangles(), boundary_loops(part).size(),
               area(part));
    for (const std::string& line : in_words(applied_process(session)))
        fmt::print("process   {}\n", line);
    if (flat.report.process_share < 1)
        fmt::print("process   of these forces {:.2g} % are in the blank\n", 100 * flat.report.process_share);
    fmt::print("blank     {:.6g} x {:.6g} mm, {} energy and {} Newton steps, {}\n", size[0], size[1],
               flat.report.energy.size(), flat.report.newton.size(),
               flat.report.whole()     ? "converged"
               : flat.report.converged ? fmt::format("converged ({})", name(flat.report.system))
                                       : "NOT converged");
    fmt::print("forming   thinning {:+.1f} to {:+.1f} %, equivalent strain up to {:.3f}\n",
               100 * flat.face.thinning.minCoeff(), 100 * flat.face.thinning.maxCoeff(),
               flat.face.strain_equivalent.maxCoeff());
    if (flat.skins)
        fmt::print("skins     major strain up to {:.3f} outside, {:.3f} inside\n",
                   flat.skins->outer.strain_major.maxCoeff(), flat.skins->inner.strain_major.maxCoeff());
    print_limits(*session.limits, *session.part);
    if (!session.grid)
        return;
    const GridResult& grid = session.grid->result;
    fmt::print("grid      {} x {} cells, {}, {} folded, least scaled Jacobian {:.3f}\n", grid.planar.columns,
               grid.planar.rows, name(grid.route), grid.quality.folded_cells, grid.quality.min_scaled_jacobian);
    if (!session.surface)
        return;
    const Deviation& deviation = session.surface->deviation;
    fmt::print("surface   {} x {} control points, deviation max {:.4g} mm, rms {:.4g} mm\n",
               session.surface->result.surface.count_u, session.surface->result.surface.count_v, deviation.max(),
               std::max(deviation.surface_to_mesh.rms, deviation.mesh_to_surface.rms));
}

} // namespace

int run(const RunArguments& arguments)
{
    Session session;
    session.file = arguments.part;
    session.options = options(arguments);
    const OutputOptions wanted = output_options(arguments);
    std::exception_ptr error; // of a stage after the solver: the blank is worth writing all the same
    std::optional<Failure> failure;
    for (const Stage stage : chain) {
        JobDisplay display{std::string(name(stage))};
        try {
            session = run_stage(stage, session, display.progress());
        } catch (const Cancelled&) {
            throw;
        } catch (const std::exception& reason) {
            if (!session.blank)
                throw;
            error = std::current_exception();
            failure = {stage, reason.what()};
            break;
        }
        display.done(session.seconds.at(stage));
        if (stage == Stage::read)
            session.options.flatten.thickness = sheet_thickness(arguments.thickness, *session.part);
        if (stage == Stage::read && !arguments.process.empty())
            session.options.flatten.process =
                read_process(arguments.process, *session.part, session.options.flatten.material,
                             session.options.flatten.thickness, assets() / "materials");
        if (stage == Stage::read) {
            for (const std::string& line : reading_notes(*session.part))
                fmt::print("  {}\n", line);
            if (const std::string text = thickness_in_words(arguments.thickness, *session.part); !text.empty())
                fmt::print("  note: {}\n", text);
            require_possible(session);
            require_place(session, arguments.folder, arguments.formats, arguments.json, wanted);
        }
    }
    const auto clock = std::chrono::steady_clock::now();
    JobDisplay display{"write"};
    const auto files = write_outputs(session, arguments.folder, arguments.formats, wanted, display.progress());
    const double write_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    display.done(write_seconds);
    if (!arguments.json.empty())
        write_atomically(arguments.json, report_json(session, files, write_seconds, failure));

    print_summary(session);
    for (const auto& file : files)
        fmt::print("wrote     {}\n", file.string());
    const auto poorer = shortcomings(session);
    for (const std::string& text : poorer)
        fmt::print("WARNING   {}\n", text);
    if (error)
        std::rethrow_exception(error);
    return arguments.strict && !poorer.empty() ? 1 : 0;
}

} // namespace spia::cli
