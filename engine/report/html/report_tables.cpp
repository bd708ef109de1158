#include "engine/report/html/report_tables.h"

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/text.h"
#include "engine/exchange/text/text_encoding.h"
#include "engine/pipeline/applied_process.h"
#include "engine/pipeline/blank/bend_report.h"
#include "engine/pipeline/shortcomings/unsuited_surface.h"
#include "engine/report/figures/face_values.h"
#include "engine/report/html/html_text.h"
#include "engine/report/html/svg_chart.h"
#include "engine/report/text/lengths.h"
#include "engine/report/text/shown_lengths.h"

namespace spia {
namespace {

/// Numbers of lengths, areas and thicknesses in the unit that the reader wants.
struct InUnit {
    LengthUnit unit;
    std::string_view word = length_word(unit);
    std::string fine(double mm, int decimals) const
    {
        return fixed(shown_length(mm, unit), decimals + more_decimals(unit));
    }
    std::string round(double mm, int decimals = 0) const
    {
        return grouped(shown_length(mm, unit), decimals + more_decimals(unit));
    }
    std::string figure(double mm) const { return significant(shown_length(mm, unit)); }
    std::string area(double mm2) const
    {
        const ShownUnit as = as_shown("mm\u00b2", unit);
        return fmt::format("{} {}", grouped(as.factor * mm2, more_decimals(unit)), as.unit);
    }
    std::string text(double mm) const { return fmt::format("{} {}", figure(mm), word); }
};

/// As HTML.
std::string law(const Hardening& hardening)
{
    struct Words {
        std::string operator()(const Swift& s) const
        {
            return fmt::format("Swift, \u03c3 = {:.5g} MPa \u00b7 ({:.4g} + \u03b5)<sup>{:.4g}</sup>", s.K_MPa, s.e0,
                               s.n);
        }
        std::string operator()(const Hollomon& h) const
        {
            return fmt::format("Hollomon, \u03c3 = {:.5g} MPa \u00b7 \u03b5<sup>{:.4g}</sup>", h.K_MPa, h.n);
        }
        std::string operator()(const Voce& v) const
        {
            return fmt::format("Voce, \u03c3 = {0:.5g} \u2212 ({0:.5g} \u2212 {1:.5g}) exp(\u2212{2:.4g} \u03b5) MPa",
                               v.sigma_sat_MPa, v.sigma0_MPa, v.c);
        }
        std::string operator()(const HardeningTable& t) const
        {
            return fmt::format("table of {} points", t.strain.size());
        }
        std::string operator()(const Ludwik& l) const
        {
            return fmt::format("Ludwik, \u03c3 = {:.5g} MPa + {:.5g} MPa \u00b7 \u03b5<sup>{:.4g}</sup>", l.sigma0_MPa,
                               l.K_MPa, l.n);
        }
        std::string operator()(const HockettSherby& h) const
        {
            return fmt::format("Hockett-Sherby, \u03c3 = {0:.5g} \u2212 ({0:.5g} \u2212 {1:.5g}) "
                               "exp(\u2212{2:.4g} \u03b5<sup>{3:.4g}</sup>) MPa",
                               h.sigma_sat_MPa, h.sigma0_MPa, h.c, h.p);
        }
        std::string operator()(const SwiftVoce& m) const
        {
            return fmt::format("Swift-Voce, {:.4g} of {} and {:.4g} of {}", m.alpha, (*this)(m.swift), 1 - m.alpha,
                               (*this)(m.voce));
        }
    };
    return std::visit(Words{}, hardening);
}

/// What the solver could keep of its equations, and what it had to relax.
std::string equations(const SolveReport& report)
{
    switch (report.system) {
    case SolvedSystem::strict: return "virtual work at every vertex, with the material as given; nothing was relaxed";
    case SolvedSystem::continued:
        return fmt::format("virtual work at every vertex; relaxed: the hardening curve is continued from the uniform "
                           "strain {} on",
                           fixed(report.trusted_strain, 2));
    case SolvedSystem::relaxed:
        return fmt::format("virtual work; relaxed: the equilibrium of {} {}, where the mesh does not resolve the "
                           "change of strain",
                           grouped(report.relaxed_vertices), report.relaxed_vertices == 1 ? "vertex" : "vertices");
    case SolvedSystem::energy:
        return "relaxed altogether: the blank of least energy with the thickness held, not in equilibrium";
    }
    return "";
}

std::string describe_repairs(const DoctorReport& doctor, LengthUnit lengths)
{
    std::string text;
    for (const Finding& finding : doctor.findings)
        if (finding.severity == spia::Severity::repaired)
            text += (text.empty() ? "" : "; ") + in_shown_lengths(finding.text, lengths);
    return text.empty() ? "none" : text;
}

std::string hardening_chart(const Session& session)
{
    const FlattenOptions& options = session.options.flatten;
    StressCurve::Options until = options.curve;
    until.trusted_strain = session.blank->report.trusted_strain;
    const StressCurve curve(options.material.hardening, options.material.young_MPa, until);
    const double greatest = session.blank->face.strain_equivalent.maxCoeff();
    const double end = 1.15 * std::max(until.trusted_strain, greatest);
    ChartCurve law{"", "#1f5f8b", {}};
    constexpr int pieces = 200;
    for (int i = 0; i <= pieces; ++i)
        law.points.emplace_back(end * i / pieces, curve(end * i / pieces).stress);
    return svg({"equivalent strain",
                "Flow stress, MPa",
                false,
                true,
                {law},
                {{until.trusted_strain, "end of valid range"}, {greatest, "maximum strain"}}});
}

std::string residual_chart(const SolveReport& report)
{
    ChartCurve energy{"energy stage", "#8a93a0", {}, true}, newton{"virtual work", "#1f5f8b", {}, true};
    int step = 0;
    for (const NewtonStep& each : report.energy)
        energy.points.emplace_back(++step, each.residual);
    for (const NewtonStep& each : report.newton)
        newton.points.emplace_back(++step, each.residual);
    return svg({"iteration", "Residual", true, false, {energy, newton}});
}

} // namespace

std::string tiles(const Session& session, const ResultFigures& figures, LengthUnit lengths)
{
    const Eigen::Vector2d size = figures.blank.sides();
    const SheetFigures& sheet = figures.sheet;
    const InUnit in{lengths};
    const std::string unit(in.word);
    std::string text = "<section class=\"tiles\">\n";
    text += tile("Blank", fmt::format("{} \u00d7 {}", in.round(size[0], 1), in.round(size[1], 1)), unit,
                 "area " + in.area(figures.blank.area));
    text += tile("Maximum thinning", fixed(100 * sheet.thinning[1], 1), "%",
                 fmt::format("minimum {} %", fixed(100 * sheet.thinning[0], 1)));
    text +=
        tile("Thickness", fmt::format("{} \u2013 {}", in.fine(sheet.thickness[0], 2), in.fine(sheet.thickness[1], 2)),
             unit, "sheet " + in.text(session.options.flatten.thickness));
    text += figures.surface ? tile("Maximum deviation", in.figure(figures.surface->deviation_max), unit,
                                   "RMS " + in.text(figures.surface->deviation_rms))
                            : tile("Maximum deviation", "\u2013", "", "no surface was made");
    return text + "</section>\n";
}

/// Of many patches in one line, by the worst of them.
static std::string fitness(const Certificate& certificate, const CertificateFigures& figures)
{
    const auto why_not = unsuited(certificate);
    return fmt::format("{}; scaled Jacobian at least {} (patch {}); angle at joints up to {}\u00b0",
                       why_not ? "not proved: " + *why_not : "no folds and no gaps (proved)",
                       significant(figures.least_scaled), figures.patch + 1,
                       significant(figures.greatest_angle * 180 / std::numbers::pi));
}

/// Of the one patch.
static std::string fitness(const PatchCertificate& patch)
{
    return fmt::format("{}; scaled Jacobian at least {}, mean {}",
                       patch.refusal ? "not proved: " + describe(*patch.refusal) : "no folds (proved)",
                       significant(patch.least_scaled), significant(patch.mean_scaled));
}

static std::string surface_rows(const Session& session, const ResultFigures& figures, const InUnit& in)
{
    const SurfaceFigures& surface = *figures.surface;
    const Deviation& deviation = session.surface->deviation;
    const bool patches = session.surface->patches != nullptr;
    const NurbsSurface& one = session.surface->result.surface;
    std::string rows =
        row("NURBS surface",
            fmt::format("{}; the part has {} vertices",
                        patches ? fmt::format("{}, {} without a gap, {}, {} control points, shared ones counted once",
                                              counted(surface.patches, "patch", "patches"),
                                              counted(surface.joints, "joint", "joints"),
                                              counted(surface.singular_nodes, "singular node", "singular nodes"),
                                              surface.control_points)
                                : fmt::format("{} \u00d7 {} control points", one.count_u, one.count_v),
                        session.part->mesh.vertices()));
    if (!session.surface->choice.empty())
        rows += row("Made of", session.surface->choice);
    rows += row("Surface deviation", fmt::format("at most {}, 95 % below {}, RMS {}", in.text(surface.deviation_max),
                                                 in.text(surface.deviation_p95), in.text(surface.deviation_rms)));
    if (const auto& source = session.surface->source)
        rows +=
            row("Measured from", fmt::format("the smooth sheet through the vertices of the mesh, whose facets are "
                                             "up to {} off it{}",
                                             in.text(source->facets_off),
                                             source->sheet.left > source->sheet.asked
                                                 ? " and which is known within " + in.text(source->sheet.left) + " only"
                                                 : ""));
    const Certificate& certificate = surface_certificate(session);
    if (patches)
        rows += row("Fitness for analysis", fitness(certificate, *figures.certificate));
    else
        for (const PatchCertificate& patch : certificate.patch)
            rows += row("Fitness for analysis", fitness(patch));
    if (const auto& fit = session.surface->fit)
        rows +=
            row("Tolerance of the surface",
                fmt::format("{}, {} in {}; {} % of the area within it", in.text(fit->tolerance),
                            !fit->reached                            ? "not met"
                            : surface.deviation_max > fit->tolerance ? "met on the remeshed part, not on the file's,"
                                                                     : "met",
                            counted(fit->rounds, "round", "rounds"), fixed(100 * deviation.within(), 2)));
    constexpr double degrees = 180 / std::numbers::pi;
    if (!patches)
        rows += row("Normals of the surface",
                    fmt::format("mean {}\u00b0, 95 % below {}\u00b0, away from sharp edges at most {}\u00b0",
                                fixed(degrees * deviation.normal.mean, 2), fixed(degrees * deviation.normal.p95, 2),
                                fixed(degrees * deviation.normal.max_smooth, 1)));
    return rows;
}

std::string key_figures(const Session& session, const ResultFigures& figures, LengthUnit lengths)
{
    const BlankSize& blank = figures.blank;
    const SheetFigures& sheet = figures.sheet;
    const Eigen::Vector2d size = blank.sides();
    const InUnit in{lengths};
    const int loops = figures.part.boundary_loops;
    // The blank of a K factor has another area than the surface that its part is told by.
    const std::string surface = !session.part->solid ? ""
                                : session.part->solid->skin == Skin::middle
                                    ? " (middle surface)"
                                    : fmt::format(" ({} skin)", name(session.part->solid->skin));
    std::string rows = row("Part", fmt::format("{}{}, {}", in.area(figures.part.area), surface,
                                               loops == 1   ? "no holes"
                                               : loops == 2 ? "one hole"
                                                            : fmt::format("{} holes", loops - 1)));
    rows += row("Blank", fmt::format("{0} \u00d7 {1} {2}, area {3}, outline {4} {2} long", in.round(size[0], 2),
                                     in.round(size[1], 2), in.word, in.area(blank.area), in.round(blank.perimeter, 1)));
    if (session.bends)
        rows += row("Lengths of the blank", "those of the " + session.bends->surface);
    rows += row("Thickness",
                fmt::format("{} to {} {}, from a sheet of {}", in.fine(sheet.thickness[0], 3),
                            in.fine(sheet.thickness[1], 3), in.word, in.text(session.options.flatten.thickness)));
    rows += row("Thinning", fmt::format("{} % to {} % (negative: thicker)", fixed(100 * sheet.thinning[0], 1),
                                        fixed(100 * sheet.thinning[1], 1)));
    rows += row("Equivalent strain", fmt::format("up to {}", fixed(sheet.strain_equivalent, 3)));
    rows += row("Distortion", fmt::format("area {}, angles {} (RMS)", significant(figures.distortion.area_rms),
                                          significant(figures.distortion.angular_rms)));
    if (session.grid) {
        const GridResult& grid = session.grid->result;
        rows += row("Quad grid", fmt::format("{} \u00d7 {} cells, {} folded, least scaled Jacobian {}",
                                             grid.planar.columns, grid.planar.rows, grid.quality.folded_cells,
                                             fixed(grid.quality.min_scaled_jacobian, 3)));
    } else {
        rows += row("Quad grid",
                    session.surface && session.surface->patches ? "none: patches have grids of their own" : "not made");
    }
    return facts("Key figures",
                 rows + (session.surface ? surface_rows(session, figures, in) : row("NURBS surface", "not made")));
}

std::string thinnest_places(const Session& session, LengthUnit lengths)
{
    const SheetFields& face = session.blank->face;
    const InUnit in{lengths};
    std::string rows;
    int rank = 0;
    const TriMesh& mesh = session.part->mesh;
    constexpr int most = 5;
    for (const int f : worst_faces(mesh, face_values(session, Field::thinning), Field::thinning, most)) {
        const Eigen::Vector3d at = mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean();
        rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                            ++rank, fixed(100 * face.thinning[f], 1), in.fine(face.thickness[f], 3),
                            fixed(face.strain_major[f], 3), fixed(face.strain_minor[f], 3),
                            fmt::format("{}, {}, {}", in.fine(at[0], 1), in.fine(at[1], 1), in.fine(at[2], 1)),
                            session.part->source_face[size_t(f)]);
    }
    if (rows.empty())
        return "";
    return fmt::format(
        "<section class=\"whole\"><h2>Largest thinning</h2>\n<table class=\"spots\"><tr><th>Spot</th><th>Thinning, %</th>"
        "<th>Thickness, {1}</th><th>Major strain</th><th>Minor strain</th><th>At x, y, z, {1}</th>"
        "<th>Face of the file</th></tr>\n{0}</table></section>\n",
        rows, in.word);
}

std::string bend_table(const Session& session, const ReportReader& reader)
{
    if (!session.bends || session.bends->bends.empty())
        return "";
    constexpr double degrees = 180 / std::numbers::pi;
    const InUnit in{reader.lengths};
    std::string rows, notes;
    int number = 0;
    for (const SheetBend& bend : session.bends->bends)
        rows += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{} {}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            ++number, bend.sharp ? "sharp" : in.fine(bend.inner_radius, 3), fixed(degrees * bend.angle, 2),
            bend.up ? "up" : "down", bend.sharp ? "" : fmt::format("{:.4g}", bend.k), in.fine(bend.allowance, 3),
            in.fine(bend.deduction, 3), in.fine(bend.length, 1),
            fmt::format("{}, {}, {}", in.fine(bend.place[0], 1), in.fine(bend.place[1], 1), in.fine(bend.place[2], 1)));
    for (const std::string& note : all_notes(*session.bends))
        notes += fmt::format("<p>{}</p>\n", escaped(reader.told(note)));
    return fmt::format(
        "<section class=\"whole\"><h2>Bends</h2>\n<table class=\"spots\"><tr><th>Bend</th><th>Inner radius, {1}</th>"
        "<th>Angle, \u00b0</th><th>K</th><th>Allowance, {1}</th><th>Deduction, {1}</th><th>Length, {1}</th>"
        "<th>At x, y, z, {1}</th></tr>\n{0}</table>\n{2}</section>\n",
        rows, in.word, notes);
}

/// What the tools were taken to do, one row a condition.
std::string tool_rows(const AppliedProcess& process, const ProcessConditions& given, const InUnit& in)
{
    const auto newton = [](double force) { return force < 100 ? significant(force) : grouped(force, 0); };
    const auto length = [&](double mm) { return fmt::format("{} {}", in.round(mm), in.word); };
    std::string rows;
    for (size_t k = 0; k < process.contact.size(); ++k) {
        const AppliedContact& c = process.contact[k];
        const auto& force = given.contact[k].force_N;
        rows += row("Contact: " + c.name,
                    fmt::format("{}{} MPa on {} of {}, friction {:.3g} on {}, holds back up to {} N",
                                force ? newton(*force) + " N, " : "", significant(c.pressure_MPa),
                                counted(c.faces, "face", "faces"), in.area(c.area_mm2), c.friction,
                                c.sides == 2 ? "both sides" : "one side", newton(c.friction_force_N)));
    }
    if (process.contact.empty())
        rows += row("Friction", "none");
    for (const AppliedBead& bead : process.drawbeads)
        rows += row("Drawbead: " + bead.name,
                    fmt::format("{} N/mm over {}", newton(bead.force_N_mm), length(bead.length_mm)));
    if (process.edge_restraint > 0)
        rows += row("Outer edge",
                    fmt::format("held by {:.3g} % of the lock force of {} N/mm: {} N/mm over {}",
                                100 * process.edge_restraint, newton(process.lock_force_N_mm),
                                newton(process.edge_restraint * process.lock_force_N_mm), length(process.held_mm)));
    for (const AppliedPilot& pilot : process.pilots)
        rows += row("Pilot: " + pilot.name, pilot.places == 1 ? "a point is held" : "a curve is held");
    return rows;
}

/// What acts on the sheet, and what it is made of where it is not the same all over. Steps know no
/// tools.
std::string process_rows(const Session& session, const InUnit& in)
{
    const AppliedProcess process = applied_process(session);
    const std::string left_out = left_out_by_steps(session.options.flatten.process);
    std::string rows =
        session.options.steps
            ? row("Tools, friction", left_out.empty() ? "none" : "none: the steps leave them out: " + left_out)
            : tool_rows(process, session.options.flatten.process, in);
    for (const AppliedPiece& piece : process.tailored)
        rows +=
            row("Tailored piece: " + piece.name, fmt::format("{}, {}, {}", piece.material, in.text(piece.thickness_mm),
                                                             counted(piece.faces, "face", "faces")));
    return rows;
}

/// "DIN 6935"
std::string k_words(const KFactor& k)
{
    if (k.name == "din6935")
        return "DIN 6935, by the inner radius over the thickness";
    return k.one_value() ? k.name : "table " + std::filesystem::path(k.name).filename().string();
}

std::string assumptions(const Session& session, LengthUnit lengths)
{
    const FlattenOptions& options = session.options.flatten;
    const Material& material = options.material;
    std::string rows = row("Material", material.name);
    rows += row("Source", material.source.empty() ? "not given" : material.source);
    rows += html_row("Hardening", law(material.hardening));
    rows +=
        row("Elasticity", fmt::format("E = {} MPa, \u03bd = {:.3g}", grouped(material.young_MPa), material.poisson));
    rows +=
        row("Anisotropy", fmt::format("Hill 1948, r = {:.3g} / {:.3g} / {:.3g} at 0\u00b0 / 45\u00b0 / 90\u00b0; "
                                      "{}",
                                      material.r0, material.r45, material.r90,
                                      options.process.rolling
                                          ? "rolling direction " + vector_text(*options.process.rolling)
                                          : fmt::format("their mean {:.3g} is used", material.normal_anisotropy())));
    const InUnit in{lengths};
    rows += row("Sheet thickness", in.text(options.thickness));
    rows += row("Stamping direction", vector_text(session.blank->stamping.direction) +
                                          (session.options.steps && !session.options.steps->polish
                                               ? ", perpendicular to the plane of the blank"
                                           : options.direction ? ", as given"
                                                               : ", found automatically"));
    if (session.options.k_factor)
        rows += row("K factor of bends", k_words(*session.options.k_factor));
    rows += process_rows(session, in);
    rows += row("Valid up to", fmt::format("equivalent strain {}; the hardening curve is an extrapolation beyond it",
                                           fixed(session.blank->report.trusted_strain, 2)));
    if (const auto& steps = session.options.steps)
        rows +=
            row("Blank", fmt::format("made step by step, in {}{}", counted(steps->run->states.size(), "step", "steps"),
                                     steps->polish ? ", then polished: the one-step solve was started from it" : ""));
    if (session.options.steps && !session.options.steps->polish)
        rows += row("Method",
                    "region by region onto faces in space, the outermost first; strains from the flat sheet to the "
                    "part by total deformation theory: forming path, bending and springback are not included");
    else
        rows += row("Method",
                    "one step from the part back to the flat sheet, total deformation theory: forming path, bending "
                    "and springback are not included");
    rows +=
        row("Equations", session.options.steps && !session.options.steps->polish ? session.blank->report.reason
                                                                                 : equations(session.blank->report));
    rows += row("Repairs of the mesh", describe_repairs(session.part->doctor, lengths));
    return facts("Assumptions", rows);
}

static std::string solver_iterations(const Session& session)
{
    const SolveReport& report = session.blank->report;
    return fmt::format("<h2>Convergence of the solver</h2>\n<div class=\"pair\"><div><h3>Iterations</h3>{}</div>"
                       "<div><h3>Hardening curve</h3>{}</div></div>\n<p>{} energy and {} in {} s; {}; residual "
                       "{} of the nodal forces at yield.</p>\n",
                       residual_chart(report), hardening_chart(session), report.energy.size(),
                       counted(report.newton.size(), "Newton step", "Newton steps"), fixed(report.seconds, 1),
                       escaped(report.reason), power_of_ten(report.residual));
}

/// What each step did.
static std::string steps_of_blank(const UnfoldRun& run, LengthUnit lengths)
{
    std::string rows;
    for (size_t k = 0; k < run.states.size(); ++k) {
        const UnfoldState& state = run.states[k];
        rows +=
            row(fmt::format("{}  {}", k + 1, state.name),
                fmt::format("{}, {}, {} s", in_shown_lengths(state.plain, lengths),
                            state.converged ? "converged" : "not converged: " + state.reason, fixed(state.seconds, 1)));
    }
    return facts("The steps of the blank", rows);
}

std::string solving(const Session& session, LengthUnit lengths)
{
    const auto& steps = session.options.steps;
    if (steps && !steps->polish)
        return steps_of_blank(*steps->run, lengths);
    return (steps ? steps_of_blank(*steps->run, lengths) : "") + solver_iterations(session);
}

std::string repairs(const PartFile& part, const ReportReader& reader)
{
    std::string rows;
    for (const Finding& finding : part.doctor.findings)
        rows += row(finding.severity == spia::Severity::repaired ? "Repaired" : "Noted", reader.told(finding.text));
    for (const std::string& note : part.notes)
        rows += row("Noted", reader.told(note));
    return rows.empty() ? "" : facts("Input part", rows);
}

} // namespace spia
