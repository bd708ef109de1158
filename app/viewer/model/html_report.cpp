#include "app/viewer/model/html_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "app/viewer/model/json_file.h"
#include "app/viewer/model/svg_chart.h"
#include "engine/core/error.h"
#include "engine/exchange/atomic_file.h"
#include "engine/exchange/provenance.h"
#include "engine/exchange/text_encoding.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/report.h"

namespace spia::viewer {
namespace {

constexpr const char* style = R"(
:root { --ink: #1f2933; --soft: #59636f; --line: #dfe3e8; --accent: #1f5f8b; }
* { box-sizing: border-box; }
body { margin: 0; background: #eef0f3; color: var(--ink); font: 10pt/1.45 Inter, "Helvetica Neue", Arial, sans-serif;
       font-variant-numeric: tabular-nums; }
main { width: 210mm; max-width: 100%; margin: 8mm auto; padding: 16mm 17mm; background: #fff; }
header { display: flex; justify-content: space-between; align-items: flex-end; gap: 8mm;
         padding-bottom: 4mm; border-bottom: 0.7mm solid var(--accent); }
header p { margin: 0; color: var(--soft); font-size: 9pt; }
header .right { text-align: right; white-space: nowrap; }
h1 { margin: 0 0 0.5mm; font-size: 20pt; line-height: 1.15; font-weight: 650; overflow-wrap: anywhere; }
h2 { margin: 8mm 0 2.5mm; font-size: 12pt; font-weight: 650; break-after: avoid; }
h3 { margin: 0 0 1mm; font-size: 9pt; font-weight: 600; color: var(--soft); }
section.whole { break-inside: avoid; }
.tiles { display: grid; grid-template-columns: repeat(4, 1fr); gap: 3mm; margin: 6mm 0 0; }
.tile { padding: 3mm 3.5mm; border: 0.25mm solid var(--line); border-radius: 1.5mm; break-inside: avoid; }
.tile b { display: block; margin: 0.5mm 0; font-size: 14pt; line-height: 1.2; font-weight: 650; white-space: nowrap; }
.tile small { font-size: 9pt; font-weight: 500; color: var(--soft); }
.tile span { font-size: 8.5pt; color: var(--soft); }
.note { margin: 3mm 0 0; padding: 2.5mm 4mm; border-left: 1mm solid #d97706; background: #fdf3e1; border-radius: 0 1mm 1mm 0;
        break-inside: avoid; overflow-wrap: anywhere; }
.note.plain { border-color: #8a93a0; background: #f3f5f7; }
.note b { color: #92400e; }
.notes { margin-top: 5mm; }
table { width: 100%; border-collapse: collapse; }
td, th { padding: 1.15mm 2mm 1.15mm 0; border-bottom: 0.2mm solid var(--line); text-align: left; vertical-align: top; }
tr { break-inside: avoid; }
th { font-size: 8.5pt; font-weight: 600; color: var(--soft); }
.facts td:first-child { width: 52mm; color: var(--soft); }
.facts td { overflow-wrap: anywhere; }
.spots td, .spots th { text-align: right; }
.spots td:first-child, .spots th:first-child { text-align: left; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 7mm; }
.pair > div { break-inside: avoid; }
svg { display: block; width: 100%; height: auto; font-family: inherit; }
figure { margin: 0 0 5mm; break-inside: avoid; }
figure img { display: block; width: 100%; max-height: 120mm; object-fit: contain; border: 0.25mm solid var(--line);
             border-radius: 1mm; }
sup { line-height: 0; font-size: 75%; }
figcaption { margin-top: 1mm; font-size: 8.5pt; color: var(--soft); }
footer { margin-top: 8mm; padding-top: 2mm; border-top: 0.2mm solid var(--line); font-size: 8pt; color: var(--soft); }
@page { size: A4; margin: 14mm 15mm; }
@media print {
  body { background: #fff; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  main { width: auto; margin: 0; padding: 0; }
}
@media (max-width: 700px) { .tiles, .pair { grid-template-columns: 1fr 1fr; } .pair { grid-template-columns: 1fr; } main { padding: 6mm; } }
)";

/// A minus sign as printers set it.
std::string typeset(std::string text)
{
    for (size_t at = 0; (at = text.find('-', at)) != std::string::npos; at += 3)
        text.replace(at, 1, "\u2212");
    return text;
}

std::string fixed(double value, int digits)
{
    const std::string text = fmt::format("{:.{}f}", value, digits);
    return typeset(text.find_first_of("123456789") == std::string::npos && value < 0 ? text.substr(1)
                                                                                     : text); // no -0.0
}
std::string significant(double value) { return typeset(fmt::format("{:.3g}", value)); }

/// HTML: 6.7 x 10^-10 with the exponent raised.
std::string power_of_ten(double value)
{
    if (!(value > 0))
        return fixed(value, 0);
    const int exponent = int(std::floor(std::log10(value)));
    return fmt::format("{:.1f} \u00b7 10<sup>{}</sup>", value * std::pow(10, -exponent),
                       typeset(std::to_string(exponent)));
}

/// 1 234 567, with narrow spaces.
std::string grouped(double value, int digits = 0)
{
    std::string text = fmt::format("{:.{}f}", value, digits);
    const size_t end = std::min(text.find('.'), text.size());
    for (size_t at = end; at > size_t(value < 0 ? 4 : 3); at -= 3)
        text.insert(at - 3, "\u202f");
    return typeset(text);
}

std::string row(const std::string& what, const std::string& value)
{
    return fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(what), escaped(value));
}

/// @param html is not escaped
std::string html_row(const std::string& what, const std::string& html)
{
    return fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(what), html);
}

/// A heading and its table, on one page if it fits.
std::string facts(const char* heading, const std::string& rows)
{
    return fmt::format("<section class=\"whole\"><h2>{}</h2>\n<table class=\"facts\">\n{}</table></section>\n", heading,
                       rows);
}

std::string header(const Session& session)
{
    const PartFile& part = *session.part;
    return fmt::format("<header><div><p>Unfolding report</p><h1>{}</h1><p>{}, {} triangles</p></div>"
                       "<div class=\"right\"><p>{}</p><p>{}</p></div></header>\n",
                       escaped(session.file.filename().string()), escaped(part.format), grouped(part.mesh.triangles()),
                       escaped(time_stamp("%Y-%m-%d %H:%M UTC")), escaped(program_name()));
}

std::string tile(const std::string& what, const std::string& value, const std::string& unit, const std::string& more)
{
    return fmt::format("<div class=\"tile\"><span>{}</span><b>{} <small>{}</small></b><span>{}</span></div>\n",
                       escaped(what), escaped(value), escaped(unit), escaped(more));
}

Eigen::Vector2d blank_size(const FlattenResult& flat)
{
    return flat.blank.position.rowwise().maxCoeff() - flat.blank.position.rowwise().minCoeff();
}

std::string tiles(const Session& session, const Json& figures)
{
    const FlattenResult& flat = *session.blank;
    const Eigen::Vector2d size = blank_size(flat);
    std::string text = "<section class=\"tiles\">\n";
    text += tile("Blank", fmt::format("{} \u00d7 {}", grouped(size[0]), grouped(size[1])), "mm",
                 fmt::format("area {} mm\u00b2", grouped(figures["blank"]["area_mm2"].get<double>())));
    text += tile("Greatest thinning", fixed(100 * flat.face.thinning.maxCoeff(), 1), "%",
                 fmt::format("least {} %", fixed(100 * flat.face.thinning.minCoeff(), 1)));
    text += tile(
        "Thickness",
        fmt::format("{} \u2013 {}", fixed(flat.face.thickness.minCoeff(), 2), fixed(flat.face.thickness.maxCoeff(), 2)),
        "mm", fmt::format("sheet {} mm", significant(session.options.flatten.thickness)));
    text += session.surface
                ? tile("Largest deviation", significant(session.surface->deviation.max()), "mm",
                       fmt::format("RMS {} mm", significant(figures["surface"]["deviation_rms_mm"].get<double>())))
                : tile("Largest deviation", "\u2013", "", "no surface was made");
    return text + "</section>\n";
}

std::string all_notes(const Session& session, const std::vector<std::string>& notes)
{
    std::string text;
    for (const std::string& shortcoming : shortcomings(session))
        text += fmt::format("<p class=\"note\"><b>Mind:</b> {}</p>\n", escaped(shortcoming));
    for (const std::string& note : notes)
        text += fmt::format("<p class=\"note plain\">{}</p>\n", escaped(note));
    return text.empty() ? "" : fmt::format("<section class=\"notes\">\n{}</section>\n", text);
}

std::string key_figures(const Session& session, const Json& figures)
{
    const FlattenResult& flat = *session.blank;
    const Json& blank = figures["blank"];
    const Eigen::Vector2d size = blank_size(flat);
    const int loops = figures["part"]["boundary_loops"].get<int>();
    std::string rows = row("Part", fmt::format("{} mm\u00b2, {}", grouped(figures["part"]["area_mm2"].get<double>()),
                                               loops == 1   ? "no holes"
                                               : loops == 2 ? "one hole"
                                                            : fmt::format("{} holes", loops - 1)));
    rows += row("Blank", fmt::format("{} \u00d7 {} mm, area {} mm\u00b2, outline {} mm long", grouped(size[0], 1),
                                     grouped(size[1], 1), grouped(blank["area_mm2"].get<double>()),
                                     grouped(blank["perimeter_mm"].get<double>(), 1)));
    rows += row("Thickness",
                fmt::format("{} to {} mm, from a sheet of {} mm", fixed(flat.face.thickness.minCoeff(), 3),
                            fixed(flat.face.thickness.maxCoeff(), 3), significant(session.options.flatten.thickness)));
    rows +=
        row("Thinning", fmt::format("{} % to {} % (negative: thicker)", fixed(100 * flat.face.thinning.minCoeff(), 1),
                                    fixed(100 * flat.face.thinning.maxCoeff(), 1)));
    rows += row("Equivalent strain", fmt::format("up to {}", fixed(flat.face.strain_equivalent.maxCoeff(), 3)));
    rows += row("Distortion",
                fmt::format("area {}, angles {} (RMS)", significant(figures["distortion"]["area_rms"].get<double>()),
                            significant(figures["distortion"]["angular_rms"].get<double>())));
    if (session.grid) {
        const GridResult& grid = session.grid->result;
        rows += row("Quad grid", fmt::format("{} \u00d7 {} cells, {} folded, least scaled Jacobian {}",
                                             grid.planar.columns, grid.planar.rows, grid.quality.folded_cells,
                                             fixed(grid.quality.min_scaled_jacobian, 3)));
    } else {
        rows += row("Quad grid", "not made");
    }
    if (session.surface) {
        const Json& surface = figures["surface"];
        const Deviation& deviation = session.surface->deviation;
        rows += row("NURBS surface", fmt::format("{} \u00d7 {} control points", surface["control_points_u"].get<int>(),
                                                 surface["control_points_v"].get<int>()));
        rows += row("Surface deviation",
                    fmt::format("at most {} mm, 95 % below {} mm, RMS {} mm", significant(deviation.max()),
                                significant(surface["deviation_p95_mm"].get<double>()),
                                significant(surface["deviation_rms_mm"].get<double>())));
    } else {
        rows += row("NURBS surface", "not made");
    }
    return facts("Key figures", rows);
}

/// Faces of the greatest thinning, each farther than a twentieth of the part from those before it.
std::vector<int> worst_faces(const Session& session, size_t most)
{
    const TriMesh& mesh = session.part->mesh;
    const Eigen::VectorXd& thinning = session.blank->face.thinning;
    const double apart = bounding_diagonal(mesh) / 20;
    const auto middle = [&](int f) {
        return Eigen::Vector3d(mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean());
    };
    std::vector<int> order(size_t(mesh.triangles())), spots;
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return thinning[a] > thinning[b]; });
    for (const int f : order) {
        if (spots.size() == most || !(thinning[f] > 0))
            break;
        if (std::all_of(spots.begin(), spots.end(), [&](int s) { return (middle(s) - middle(f)).norm() > apart; }))
            spots.push_back(f);
    }
    return spots;
}

std::string worst_spots(const Session& session)
{
    const SheetFields& face = session.blank->face;
    std::string rows;
    int rank = 0;
    for (const int f : worst_faces(session, 5)) {
        const TriMesh& mesh = session.part->mesh;
        const Eigen::Vector3d at = mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean();
        rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                            ++rank, fixed(100 * face.thinning[f], 1), fixed(face.thickness[f], 3),
                            fixed(face.strain_major[f], 3), fixed(face.strain_minor[f], 3),
                            fmt::format("{}, {}, {}", fixed(at[0], 1), fixed(at[1], 1), fixed(at[2], 1)),
                            session.part->source_face[size_t(f)]);
    }
    if (rows.empty())
        return "";
    return fmt::format(
        "<section class=\"whole\"><h2>Where the sheet thins most</h2>\n<table class=\"spots\"><tr><th>Spot</th><th>Thinning, %</th>"
        "<th>Thickness, mm</th><th>Major strain</th><th>Minor strain</th><th>At x, y, z, mm</th>"
        "<th>Face of the file</th></tr>\n{}</table></section>\n",
        rows);
}

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
    };
    return std::visit(Words{}, hardening);
}

std::string vector(const Eigen::Vector3d& v)
{
    return fmt::format("({}, {}, {})", fixed(v[0], 3), fixed(v[1], 3), fixed(v[2], 3));
}

std::string assumptions(const Session& session)
{
    const FlattenOptions& options = session.options.flatten;
    const Material& material = options.material;
    std::string rows = row("Material", material.name);
    rows += row("Its source", material.source.empty() ? "not given" : material.source);
    rows += html_row("Hardening", law(material.hardening));
    rows +=
        row("Elasticity", fmt::format("E = {} MPa, \u03bd = {:.3g}", grouped(material.young_MPa), material.poisson));
    rows += row("Anisotropy", fmt::format("Hill 1948, r = {:.3g} / {:.3g} / {:.3g} at 0\u00b0 / 45\u00b0 / 90\u00b0; "
                                          "their mean {:.3g} is used",
                                          material.r0, material.r45, material.r90, material.normal_anisotropy()));
    rows += row("Sheet thickness", significant(options.thickness) + " mm");
    rows += row("Stamping direction", vector(session.blank->stamping.direction) +
                                          (options.direction ? ", as given" : ", found automatically"));
    rows += row("Friction", options.friction.size() == 0
                                ? "none"
                                : fmt::format("up to {} MPa on the sheet", significant(options.friction.maxCoeff())));
    rows += row("Trusted up to", fmt::format("equivalent strain {}; the hardening curve is an extrapolation beyond it",
                                             fixed(session.blank->report.trusted_strain, 2)));
    rows +=
        row("Method", "one step from the part back to the flat sheet, total deformation theory: the path of forming, "
                      "bending and springback are not in it");
    return facts("Assumptions", rows);
}

std::string hardening_chart(const Session& session)
{
    const FlattenOptions& options = session.options.flatten;
    StressCurve::Options until = options.curve;
    until.trusted_strain = session.blank->report.trusted_strain;
    const StressCurve curve(options.material.hardening, options.material.young_MPa, until);
    const double greatest = session.blank->face.strain_equivalent.maxCoeff();
    const double end = 1.15 * std::max(until.trusted_strain, greatest);
    Curve law{"", "#1f5f8b", {}};
    constexpr int pieces = 200;
    for (int i = 0; i <= pieces; ++i)
        law.points.emplace_back(end * i / pieces, curve(end * i / pieces).stress);
    return svg({"equivalent strain",
                "Flow stress, MPa",
                false,
                true,
                {law},
                {{until.trusted_strain, "trusted up to here"}, {greatest, "greatest strain found"}}});
}

std::string residual_chart(const SolveReport& report)
{
    Curve energy{"energy stage", "#8a93a0", {}, true}, newton{"virtual work", "#1f5f8b", {}, true};
    int step = 0;
    for (const NewtonStep& each : report.energy)
        energy.points.emplace_back(++step, each.residual);
    for (const NewtonStep& each : report.newton)
        newton.points.emplace_back(++step, each.residual);
    return svg({"iteration", "Residual", true, false, {energy, newton}});
}

std::string solving(const Session& session)
{
    const SolveReport& report = session.blank->report;
    return fmt::format(
        "<h2>How the solver got there</h2>\n<div class=\"pair\"><div><h3>Iterations</h3>{}</div>"
        "<div><h3>Hardening curve</h3>{}</div></div>\n<p>{} energy and {} Newton steps in {} s; {}; residual "
        "{} of the nodal forces at yield.</p>\n",
        residual_chart(report), hardening_chart(session), report.energy.size(), report.newton.size(),
        fixed(report.seconds, 1), escaped(report.reason), power_of_ten(report.residual));
}

std::string repairs(const PartFile& part)
{
    std::string rows;
    for (const Finding& finding : part.doctor.findings)
        rows += row(finding.severity == spia::Severity::repaired ? "Repaired" : "Noted", finding.text);
    for (const std::string& note : part.notes)
        rows += row("Noted", note);
    return rows.empty() ? "" : facts("The part as it was read", rows);
}

std::string pictures_html(const std::vector<ReportPicture>& pictures)
{
    std::string text;
    for (const ReportPicture& picture : pictures) {
        if (!picture.png.starts_with("\x89PNG\r\n\x1a\n"))
            throw InputError(
                fmt::format("the picture \"{}\" is no PNG file; leave it out of the report", picture.title));
        text += fmt::format("<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption>"
                            "</figure>\n",
                            escaped(picture.title), base64(picture.png));
    }
    return text.empty() ? "" : "<h2>Pictures</h2>\n" + text;
}

} // namespace

void write_html_report(const std::filesystem::path& file, const Session& session,
                       const std::vector<ReportPicture>& pictures, const std::vector<std::string>& notes)
{
    if (!session.part || !session.blank)
        throw InputError("a report needs a solved part; unfold the part first");
    const Json figures = parse_json(report_json(session, {}, 0), "figures");
    std::string html = fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                                   "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                                   "<title>Unfolding report: {}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n",
                                   escaped(session.file.filename().string()), style);
    html += header(session) + tiles(session, figures) + all_notes(session, notes) + key_figures(session, figures);
    html += worst_spots(session) + assumptions(session) + solving(session) + repairs(*session.part);
    html += pictures_html(pictures);
    html += fmt::format("<footer>Made by {} from {}. Lengths in mm, stresses in MPa, strains logarithmic.</footer>\n"
                        "</main>\n</body>\n</html>\n",
                        escaped(program_name()), escaped(session.file.string()));
    write_atomically(file, html);
}

} // namespace spia::viewer
