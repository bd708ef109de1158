#include "engine/report/json/report_json.h"

#include <sys/resource.h>

#include <array>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/forming/material/material_text.h"
#include "engine/mesh/flat/distortion.h"
#include "engine/mesh/topology.h"
#include "engine/options/command_line_json.h"
#include "engine/part/curved_faces.h"
#include "engine/part/vertex_numbers.h"
#include "engine/pipeline/applied_process.h"
#include "engine/pipeline/outputs/iga_outputs.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/report/figures/figures.h"
#include "engine/report/json/attempts_json.h"
#include "engine/report/json/bend_table_json.h"
#include "engine/report/json/certificate_json.h"
#include "engine/report/json/surface_json.h"

namespace spia {
namespace {

using Json = nlohmann::ordered_json;

double peak_memory_mb()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024; // Linux counts in kB
}

Json steps_json(const std::vector<NewtonStep>& steps)
{
    Json list = Json::array();
    for (const NewtonStep& step : steps)
        list.push_back({{"energy_J", step.energy}, {"residual", step.residual}, {"step_length", step.step_length}});
    return list;
}

std::string_view name(StartMethod start)
{
    switch (start) {
    case StartMethod::projection: return "projection";
    case StartMethod::conformal: return "conformal";
    case StartMethod::harmonic: return "harmonic";
    }
    return "";
}

Json findings_json(const DoctorReport& doctor)
{
    Json list = Json::array();
    for (const Finding& finding : doctor.findings) {
        Json places = Json::array();
        for (size_t k = 0; k < finding.place.size(); ++k) {
            places.push_back({{"at_mm", {finding.place[k][0], finding.place[k][1], finding.place[k][2]}}});
            if (k < finding.what.size())
                places.back()["what"] = finding.what[k];
        }
        list.push_back({{"fault", name(finding.fault)},
                        {"severity", finding.severity == Severity::note       ? "note"
                                     : finding.severity == Severity::repaired ? "repaired"
                                                                              : "fatal"},
                        {"count", finding.count},
                        {"first", finding.first},
                        {"text", finding.text},
                        {"advice", finding.advice},
                        {"places", std::move(places)}});
    }
    return list;
}

Json seam_json(const PartFile& part)
{
    return part.seam.empty() ? Json(nullptr) : Json{{"length_mm", part.seam_length}, {"paths", part.seam}};
}

Json strain_json(const StrainFigures& strain) { return {{"most", strain.most}, {"mean", strain.mean}}; }

/// Equivalent strains with the corners cut and joined.
Json corner_cut_json(const CornerCut& cut)
{
    return {{"strain_before", cut.before ? strain_json(*cut.before) : Json(nullptr)},
            {"strain_after", strain_json(cut.after)},
            {"why_not", cut.before ? Json(nullptr) : Json(cut.why_not)}};
}

Json quality_json(const TriangleQuality& quality)
{
    constexpr double degrees = 180 / std::numbers::pi;
    return {{"triangles", quality.triangles},
            {"smallest_angle_deg", quality.least_angle * degrees},
            {"smallest_angle_of_99_percent_deg", quality.least_angle_of_99 * degrees},
            {"edge_ratio", quality.edge_ratio},
            {"median_edge_mm", quality.median_edge}};
}

/// null if the part has the triangles of its file.
Json remeshed_json(const PartFile& part)
{
    if (!part.remeshed)
        return nullptr;
    const Remeshed& remeshed = *part.remeshed;
    return {{"size_mm", remeshed.size},
            {"tolerance_mm", remeshed.tolerance},
            {"distance_mm", remeshed.distance},
            {"lines", remeshed.lines},
            {"corners", remeshed.corners},
            {"seconds", remeshed.seconds},
            {"before", quality_json(remeshed.before)},
            {"after", quality_json(remeshed.after)}};
}

Json part_json(const PartFile& part)
{
    const SurfaceOfPart sheet = surface_of_part(part);
    Json json = {{"vertices", part.mesh.vertices()},
                 {"triangles", part.mesh.triangles()},
                 {"boundary_loops", sheet.boundary_loops},
                 {"area_mm2", sheet.area},
                 {"format", part.format},
                 {"unit", name(part.unit)},
                 {"seam", seam_json(part)},
                 {"remeshed", remeshed_json(part)},
                 {"findings", findings_json(part.doctor)}};
    return json;
}

/// @param of_steps the blank is that of steps: nothing was started
Json solve_json(const SolveReport& report, const StampingDirection& stamping, bool of_steps)
{
    return {{"converged", report.converged},
            {"reason", report.reason},
            {"system", name(report.system)},
            {"energy_iterations", report.energy.size()},
            {"newton_iterations", report.newton.size()},
            {"residual", report.residual},
            {"seconds", report.seconds},
            {"trusted_strain", report.trusted_strain},
            {"relaxed_vertices", report.relaxed_vertices},
            {"process_share", report.process_share},
            {"start", of_steps ? Json() : Json(name(report.start))},
            {"resultant_N_N_Nmm", {report.resultant[0], report.resultant[1], report.resultant[2]}},
            {"stamping_direction", {stamping.direction[0], stamping.direction[1], stamping.direction[2]}},
            {"hidden_area_fraction", stamping.hidden_area_fraction},
            {"attempts", attempts_json(report.attempts)},
            {"energy_steps", steps_json(report.energy)},
            {"newton_steps", steps_json(report.newton)}};
}

Json source_json(const std::optional<BlankOfSteps>& made)
{
    Json json = {{"from", name(made)}};
    if (!made)
        return json;
    json["steps"] = Json::array();
    for (const UnfoldState& state : made->run->states)
        json["steps"].push_back({{"name", state.name},
                                 {"face", state.plain},
                                 {"converged", state.converged},
                                 {"reason", state.reason},
                                 {"seconds", state.seconds}});
    return json;
}

/// Vertices by their numbers in the file; the first hundred of each list: nobody looks at more.
Json overlap_json(const Overlap& overlap, const PartFile& file)
{
    constexpr size_t most = 100;
    const auto number = [&](int v) { return file.source_vertex[size_t(v)]; };
    Json crossings = Json::array(), wound = Json::array();
    for (const OutlineCrossing& c : overlap.crossings)
        if (crossings.size() < most)
            crossings.push_back({{number(c.edge[0]), number(c.edge[1])}, {number(c.other[0]), number(c.other[1])}});
    for (const int v : overlap.wound)
        if (wound.size() < most)
            wound.push_back(number(v));
    return {{"crossing_edges", crossings}, {"wound_vertices", wound}};
}

Json blank_json(const PartFile& file, const FlattenResult& flat)
{
    const BlankSize blank = blank_size(file.mesh, flat.blank);
    return {{"area_mm2", blank.area},
            {"perimeter_mm", blank.perimeter},
            {"bounding_box_mm", {blank.low[0], blank.low[1], blank.high[0], blank.high[1]}},
            {"flipped_triangles", flat.flipped_triangles},
            {"outline_self_intersections", flat.overlap.crossings.size()},
            {"overlap", overlap_json(flat.overlap, file)}};
}

Json skins_json(const SkinStrains& skins)
{
    const auto skin = [](const SkinFields& fields) -> Json {
        return {{"strain_major_max", fields.strain_major.maxCoeff()},
                {"strain_minor_min", fields.strain_minor.minCoeff()},
                {"strain_equivalent_max", fields.strain_equivalent.maxCoeff()}};
    };
    const double sharpest = skins.curvature.cwiseAbs().maxCoeff();
    return {{"outer", skin(skins.outer)},
            {"inner", skin(skins.inner)},
            {"smallest_radius_mm", sharpest > 0 ? Json(1 / sharpest) : Json(nullptr)},
            {"sharp_faces", skins.sharp_faces}};
}

Json result_json(const FlattenResult& flat)
{
    const SheetFigures sheet = sheet_figures(flat.face);
    return {{"thinning_max", sheet.thinning[1]},
            {"thinning_min", sheet.thinning[0]},
            {"equivalent_strain_max", sheet.strain_equivalent},
            {"thickness_min_mm", sheet.thickness[0]},
            {"thickness_max_mm", sheet.thickness[1]},
            {"necking_triangles", flat.necking_triangles},
            {"volume_error", flat.volume_error}};
}

Json zones_json(const LimitsResult& limits)
{
    Json json = Json::object();
    for (const Zone zone : all_zones) {
        const ZoneShare& share = limits.zones.share[size_t(zone)];
        json[std::string(name(zone))] = {{"number", int(zone)},
                                         {"definition", definition(zone, limits.settings)},
                                         {"faces", share.faces},
                                         {"area_mm2", share.area_mm2},
                                         {"area_share", share.share}};
    }
    return json;
}

Json spots_json(const LimitsResult& limits, const PartFile& part)
{
    Json list = Json::array();
    for (const WorstSpot& spot : limits.zones.spots)
        list.push_back({{"zone", name(spot.zone)},
                        {"value", spot.value},
                        {"face", part.source_face[size_t(spot.face)]},
                        {"position_mm", {spot.position[0], spot.position[1], spot.position[2]}},
                        {"strain_major", spot.strain_major},
                        {"strain_minor", spot.strain_minor},
                        {"thinning", spot.thinning},
                        {"region_faces", spot.region_faces},
                        {"region_area_mm2", spot.region_area_mm2}});
    return list;
}

Json curve_json(const FormingLimitCurve& curve)
{
    Json points = Json::array();
    for (size_t i = 0; i < curve.minor.size(); ++i)
        points.push_back({curve.minor[i], curve.major[i]});
    return {{"formula", curve.formula},
            {"flc0", engineering_strain(curve.at_plane_strain())},
            {"minor_major_logarithmic", points}};
}

Json piece_limits_json(const std::vector<PieceLimits>& pieces)
{
    Json list = Json::array();
    for (const PieceLimits& piece : pieces)
        list.push_back({{"name", piece.name},
                        {"material", piece.material},
                        {"thickness_mm", piece.thickness},
                        {"faces", piece.faces},
                        {"curve", piece.curve ? curve_json(*piece.curve) : Json(nullptr)},
                        {"margin", piece.margin}});
    return list;
}

Json limits_json(const LimitsResult& limits, const PartFile& part)
{
    const ZoneOptions& settings = limits.settings;
    return {{"curve", limits.curve ? curve_json(*limits.curve) : Json(nullptr)},
            {"settings",
             {{"margin", settings.margin},
              {"max_thinning", settings.max_thinning},
              {"max_thickening", settings.max_thickening},
              {"low_strain", settings.low_strain}}},
            {"pieces", piece_limits_json(limits.pieces)},
            {"zones", zones_json(limits)},
            {"worst_spots", spots_json(limits, part)},
            {"faces_beyond_curve", limits.beyond_curve},
            {"notes", limits.notes}};
}

Json process_json(const Session& session)
{
    if (session.options.flatten.process == ProcessConditions{})
        return nullptr;
    const AppliedProcess process = applied_process(session);
    Json contact = Json::array(), beads = Json::array(), pilots = Json::array(), tailored = Json::array();
    for (const AppliedContact& each : process.contact)
        contact.push_back({{"name", each.name},
                           {"faces", each.faces},
                           {"area_mm2", each.area_mm2},
                           {"pressure_MPa", each.pressure_MPa},
                           {"friction", each.friction},
                           {"sides", each.sides},
                           {"friction_force_N", each.friction_force_N}});
    for (const AppliedBead& each : process.drawbeads)
        beads.push_back({{"name", each.name}, {"length_mm", each.length_mm}, {"force_N_mm", each.force_N_mm}});
    for (const AppliedPilot& each : process.pilots)
        pilots.push_back({{"name", each.name}, {"places", each.places}});
    for (const AppliedPiece& each : process.tailored)
        tailored.push_back({{"name", each.name},
                            {"material", each.material},
                            {"thickness_mm", each.thickness_mm},
                            {"faces", each.faces},
                            {"area_mm2", each.area_mm2},
                            {"edge_force_N_mm", each.edge_force_N_mm}});
    Json edge, rolling;
    if (process.edge_restraint > 0)
        edge = {{"share", process.edge_restraint},
                {"lock_force_N_mm", process.lock_force_N_mm},
                {"force_N_mm", process.edge_restraint * process.lock_force_N_mm},
                {"held_mm", process.held_mm},
                {"upright_mm", process.upright_mm}};
    if (const auto& r = process.rolling)
        rolling = {(*r)[0], (*r)[1], (*r)[2]};
    return {{"acting_share", session.blank->report.process_share},
            {"contact", contact},
            {"drawbeads", beads},
            {"edge_restraint", edge},
            {"pilots", pilots},
            {"tailored", tailored},
            {"rolling", rolling}};
}

Json grid_json(const Session& session)
{
    const GridResult& grid = session.grid->result;
    Json corners = Json::array();
    for (int v : session.grid->boundary.corner)
        corners.push_back(number_of(*session.part, v));
    return {{"columns", grid.planar.columns},
            {"rows", grid.planar.rows},
            {"folded_cells", grid.quality.folded_cells},
            {"method", name(grid.route)},
            {"to_bends", grid.line_grading},
            {"no_bends", grid.no_bends},
            {"evened", grid.evened},
            {"min_scaled_jacobian", grid.quality.min_scaled_jacobian},
            {"worst_cell", grid.planar.column_and_row(grid.quality.worst_cell)},
            {"corners", corners},
            {"filled_holes", grid.filled->holes},
            {"attempts", attempts_json(grid.attempts)}};
}

} // namespace

std::string report_json(const Session& session, const std::vector<std::filesystem::path>& files, double write_seconds,
                        const std::optional<Failure>& failure)
{
    Json json = {{"schema", "spia.result/1"}, {"input", session.file.string()}};
    if (session.part)
        json["part"] = part_json(*session.part);
    if (session.blank) {
        const Distortion d = distortion(session.part->mesh, session.blank->blank.position);
        json["material"] = session.options.flatten.material.name;
        json["hardening"] = Json::parse(hardening_text(session.options.flatten.material.hardening));
        json["sheet_thickness_mm"] = session.options.flatten.thickness;
        json["process"] = process_json(session);
        json["source"] = source_json(session.options.steps);
        json["solve"] = solve_json(session.blank->report, session.blank->stamping,
                                   session.options.steps && !session.options.steps->polish);
        json["blank"] = blank_json(*session.part, *session.blank);
        if (session.bends) {
            json["blank"]["lengths_of"] = session.bends->surface;
            json["bend_table"] = bend_table_json(*session.bends);
        }
        if (session.corner_cut)
            json["corner_cut"] = corner_cut_json(*session.corner_cut);
        json["result"] = result_json(*session.blank);
        if (session.blank->skins)
            json["skins"] = skins_json(*session.blank->skins);
        if (session.limits)
            json["limits"] = limits_json(*session.limits, *session.part);
        json["distortion"] = {
            {"angular_rms", d.angular_rms}, {"area_rms", d.area_rms}, {"definition", distortion_definition}};
    }
    if (session.grid)
        json["grid"] = grid_json(session);
    if (session.surface)
        json["surface"] = surface_json(*session.surface, *session.part);
    if (session.deformed)
        json["deformation"] = deformation_json(*session.options.deformation, session.deformed->result);
    if (failure)
        json["failure"] = {{"stage", name(failure->stage)}, {"message", failure->message}};
    if (session.surface)
        json["certificate"] = certificate_json(surface_certificate(session));
    json["shortcomings"] = shortcomings(session);
    json["files"] = Json::array();
    for (const auto& file : files)
        json["files"].push_back(file.string());
    double total = write_seconds;
    for (const Stage stage : chain)
        if (const auto found = session.seconds.find(stage); found != session.seconds.end()) {
            json["seconds"][std::string(name(stage))] = found->second;
            total += found->second;
        }
    json["seconds"]["write"] = write_seconds;
    json["seconds"]["total"] = total;
    json["peak_memory_mb"] = peak_memory_mb();
    return with_command_line_texts(std::move(json)).dump(2) + "\n";
}

std::vector<std::string> reading_notes(const PartFile& part)
{
    std::vector<std::string> lines;
    for (const std::string& note : part.notes)
        lines.push_back("note: " + note);
    for (const Finding& finding : part.doctor.findings)
        lines.push_back(fmt::format("{}: {}{}{}", finding.severity == Severity::repaired ? "repaired" : "note",
                                    finding.text, finding.advice.empty() ? "" : "; ", finding.advice));
    return lines;
}

std::string doctor_json(const std::filesystem::path& file, const PartFile& part)
{
    Json json = {{"schema", "spia.info/1"},
                 {"input", file.string()},
                 {"format", part.format},
                 {"unit", name(part.unit)},
                 {"vertices", part.file_vertices},
                 {"faces", part.file_faces},
                 {"components", part.doctor.components},
                 {"healthy", part.doctor.healthy()},
                 {"seam", seam_json(part)},
                 {"remeshed", remeshed_json(part)},
                 {"findings", findings_json(part.doctor)},
                 {"notes", part.notes}};
    const auto optional = [&](const char* key, const std::optional<int>& value) {
        json[key] = value ? Json(*value) : Json(nullptr);
    };
    optional("boundary_loops", part.doctor.boundary_loops);
    optional("genus", part.doctor.genus);
    optional("euler_characteristic", part.doctor.euler_characteristic);
    if (part.deck) {
        const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(nullptr); };
        json["thickness_mm"] = or_null(part.thickness_mm);
        json["material"] = part.material;
        for (const DeckPart& each : part.deck->parts)
            json["parts"].push_back({{"id", or_null(each.id)},
                                     {"name", each.name},
                                     {"shells", each.elements},
                                     {"shells_without_nodes", each.broken},
                                     {"thickness", or_null(each.thickness)},
                                     {"material", each.material}});
        json["sets"] = part.deck->sets;
    }
    if (part.cad) {
        json["items"] = Json::array();
        for (const CadItem& item : part.cad->tree.item)
            json["items"].push_back({{"choice", choice(item)},
                                     {"name", item.name},
                                     {"kind", name(item.kind)},
                                     {"parent", item.parent < 0 ? Json(nullptr) : Json(item.parent)},
                                     {"faces", item.faces}});
    }
    if (part.solid) {
        const SolidOrigin& solid = *part.solid;
        json["thickness_mm"] = solid.thickness;
        json["solid"] = {{"skin", name(solid.skin)},           {"thickness_least_mm", solid.least},
                         {"thickness_most_mm", solid.most},    {"outer_area_mm2", solid.outer_area},
                         {"inner_area_mm2", solid.inner_area}, {"rim_area_mm2", solid.rim_area},
                         {"volume_mm3", solid.volume},         {"faces", solid.faces},
                         {"outer_faces", solid.outer_faces},   {"inner_faces", solid.inner_faces}};
    }
    if (part.doctor.healthy()) {
        const Eigen::Vector3d low = part.mesh.position.rowwise().minCoeff(),
                              high = part.mesh.position.rowwise().maxCoeff();
        json["triangles"] = part.mesh.triangles();
        json["area_mm2"] = sheet_area(part);
        json["bounding_box_mm"] = {low[0], low[1], low[2], high[0], high[1], high[2]};
    }
    return with_command_line_texts(std::move(json)).dump(2) + "\n";
}

} // namespace spia
