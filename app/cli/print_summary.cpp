#include "app/cli/print_summary.h"
#include "app/cli/terminal.h"

#include <algorithm>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/text.h"
#include "engine/nurbs/certificate.h"
#include "engine/pipeline/applied_process.h"
#include "engine/pipeline/blank/bend_report.h"
#include "engine/pipeline/outputs/iga_outputs.h"
#include "engine/pipeline/shortcomings/unsuited_surface.h"
#include "engine/report/figures/figures.h"
#include "engine/report/text/number_text.h"

namespace spia::cli {
namespace {

void print_spots(const Zones& zones, const PartFile& part)
{
    constexpr size_t most = 3;
    for (size_t k = 0; k < std::min(most, zones.spots.size()); ++k) {
        const WorstSpot& spot = zones.spots[k];
        const bool by_curve = spot.zone >= Zone::marginal;
        say("{} {:<18} face {} at {:.4g}, {:.4g}, {:.4g} mm: {} {:+.1f} %, strains {:.3f} and {:.3f}\n",
            k == 0 ? "worst    " : "         ", name(spot.zone), part.source_face[size_t(spot.face)], spot.position[0],
            spot.position[1], spot.position[2],
            by_curve                                ? "margin to the curve"
            : spot.zone == Zone::excessive_thinning ? "thinning"
                                                    : "thickening",
            100 * spot.value, spot.strain_major, spot.strain_minor);
    }
}

void print_limits(const LimitsResult& limits, const PartFile& part)
{
    if (limits.curve)
        say("limits    FLC0 {:.1f} %, {}\n", 100 * engineering_strain(limits.curve->at_plane_strain()),
            limits.curve->formula.substr(0, limits.curve->formula.find(':')));
    else
        say("limits    no forming limit curve\n");
    for (const Zone zone : all_zones)
        if (const ZoneShare& share = limits.zones.share[size_t(zone)]; share.faces > 0)
            say("          {:<18} {:>7} {}, {:5.1f} % of the area\n", name(zone), share.faces,
                share.faces == 1 ? "face" : "faces", 100 * share.share);
    print_spots(limits.zones, part);
    for (const std::string& note : limits.notes)
        say("  note: {}\n", note);
}

} // namespace

void print_bends(const BendTable& table)
{
    for (const std::string& line : describe(table))
        say("{}{}\n", line.substr(0, 6) == "note: " ? "  " : "bends     ", line);
}

void print_summary(const Session& session)
{
    const FlattenResult& flat = *session.blank;
    const ResultFigures figures = result_figures(session);
    const Eigen::Vector2d size = figures.blank.sides();
    say("part      {}, {}, {:.6g} mm2\n", counted(session.part->mesh.triangles(), "triangle", "triangles"),
        counted(figures.part.boundary_loops, "boundary loop", "boundary loops"), figures.part.area);
    for (const std::string& line : describe(applied_process(session)))
        say("process   {}\n", line);
    if (flat.report.process_share < 1)
        say("process   {:.2g} % of these forces are applied in the blank\n", 100 * flat.report.process_share);
    if (session.options.steps && !session.options.steps->polish)
        say("blank     {:.6g} x {:.6g} mm, {:.6g} mm2, {}\n", size[0], size[1], figures.blank.area, flat.report.reason);
    else
        say("blank     {:.6g} x {:.6g} mm, {:.6g} mm2{}, {} energy and {}, {}\n", size[0], size[1], figures.blank.area,
            session.options.steps ? " of the steps, polished" : "", flat.report.energy.size(),
            counted(flat.report.newton.size(), "Newton step", "Newton steps"),
            flat.report.whole()     ? "converged"
            : flat.report.converged ? fmt::format("converged ({})", name(flat.report.system))
                                    : "NOT converged");
    if (session.bends)
        print_bends(*session.bends);
    say("forming   thinning {}, equivalent strain up to {:.3f}\n", percent_range(figures.sheet.thinning),
        figures.sheet.strain_equivalent);
    if (session.corner_cut)
        say("corners   {}\n", describe(*session.corner_cut));
    if (flat.skins)
        say("skins     major strain up to {:.3f} outside, {:.3f} inside\n", flat.skins->outer.strain_major.maxCoeff(),
            flat.skins->inner.strain_major.maxCoeff());
    print_limits(*session.limits, *session.part);
    if (session.grid) {
        const GridResult& grid = session.grid->result;
        say("grid      {} x {} cells, {}{}{}, {} folded, least scaled Jacobian {:.3f}\n", grid.planar.columns,
            grid.planar.rows, name(grid.route),
            grid.line_grading > 0 ? fmt::format(", {:.3g} % of the lines by bends", 100 * grid.line_grading) : "",
            grid.evened ? ", evened out" : "", grid.quality.folded_cells, grid.quality.min_scaled_jacobian);
    }
    if (!session.surface)
        return;
    const NurbsSurface& surface = session.surface->result.surface;
    const auto& patches = session.surface->patches;
    say("surface   {}, deviation max {:.4g} mm, rms {:.4g} mm\n",
        patches ? fmt::format("{} with {} and {} control points", counted(figures.surface->patches, "patch", "patches"),
                              counted(figures.surface->singular_nodes, "singular node", "singular nodes"),
                              figures.surface->control_points)
                : fmt::format("{} x {} control points", surface.count_u, surface.count_v),
        figures.surface->deviation_max, figures.surface->deviation_rms);
    if (!session.surface->choice.empty())
        say("          {}\n", session.surface->choice);
    if (const TrimResult& trim = session.surface->trim; !trim.loop.empty())
        say("holes     {}, of IGES and STEP files, within {:.2g} mm of {} vertices\n",
            counted(trim.loop.size(), "trimming curve", "trimming curves"), trim.distance,
            trim.loop.size() == 1 ? "its" : "their");
    if (const auto& fit = session.surface->fit; fit && patches)
        say("          {} {:.4g} mm in {}, {}{}\n", fit->reached ? "within" : "NOT within", fit->tolerance,
            counted(fit->rounds, "round", "rounds"), counted(figures.surface->joints, "interface", "interfaces"),
            patches->layout.edges > 0
                ? fmt::format(", patches end on {}", counted(patches->layout.edges, "sharp edge", "sharp edges"))
                : "");
    if (const auto& source = session.surface->source;
        source && source->sheet.mesh.triangles() > source->sheet.face.back() + 1)
        say("          of the smooth sheet through the vertices of the mesh, whose facets are up to {:.3g} mm off it{}\n",
            source->facets_off,
            source->sheet.left > source->sheet.asked
                ? fmt::format(" and which is known within {:.2g} mm only", source->sheet.left)
                : "");
    if (patches && patches->joins && patches->joins->places > 0) {
        constexpr double degree = std::numbers::pi / 180;
        const JoinsReport& joins = *patches->joins;
        say("joins     angle up to {:.3g} degrees, {:.3g} before{}{}\n", joins.angle_after / degree,
            joins.angle_before / degree,
            joins.kept > 0 ? fmt::format("; {} left as before, smoothing would make them worse",
                                         counted(joins.kept, "patch", "patches"))
                           : "",
            joins.edges > 0 ? fmt::format("; {} of {} places are edges of the part", joins.edges, joins.places) : "");
    }
    if (const auto& fit = session.surface->fit; fit && !patches)
        say("          {} {:.4g} mm{}, {} + {} knots inserted in {}\n", fit->reached ? "within" : "NOT within",
            fit->tolerance,
            fit->reached ? "" : fmt::format(" ({:.2f} % of the area is)", 100 * session.surface->deviation.within()),
            fit->knots_u, fit->knots_v, counted(fit->rounds, "round", "rounds"));
    if (session.deformed)
        say("deformed  control points moved by up to {:.4g} mm; deviations are those of the surface before\n",
            session.deformed->result.largest);
    const auto why_not = unsuited(surface_certificate(session));
    say("analysis  {}, least scaled Jacobian {:.3f}\n",
        why_not ? "not proved to be fit for it: " + *why_not : "proved to have no fold",
        figures.certificate->least_scaled);
}

} // namespace spia::cli
