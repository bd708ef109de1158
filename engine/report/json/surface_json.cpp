#include "engine/report/json/surface_json.h"

#include <numbers>

#include "engine/report/figures/figures.h"
#include "engine/report/json/attempts_json.h"

namespace spia {
namespace {

using Json = nlohmann::ordered_json;

double degrees(double angle) { return angle * 180 / std::numbers::pi; }

Json statistics_json(const DeviationStatistics& s, bool with_tolerance)
{
    Json json = {
        {"max_mm", s.max}, {"rms_mm", s.rms}, {"p95_mm", s.p95}, {"at_mm", {s.where[0], s.where[1], s.where[2]}}};
    if (with_tolerance)
        json["share_within_tolerance"] = s.within;
    return json;
}

std::string_view name(FitShortfall::Reason reason)
{
    switch (reason) {
    case FitShortfall::Reason::none: break;
    case FitShortfall::Reason::sharp_edge: return "sharp edge";
    case FitShortfall::Reason::outline_corner: return "corner of the outline";
    case FitShortfall::Reason::data: return "grid too coarse";
    case FitShortfall::Reason::control_points: return "too few control points";
    }
    return "none";
}

Json fit_json(const FitReport& fit, const PartFile& part)
{
    Json json = {{"tolerance_mm", fit.tolerance},
                 {"reached", fit.reached},
                 {"rounds", fit.rounds},
                 {"knots_inserted_u", fit.knots_u},
                 {"knots_inserted_v", fit.knots_v},
                 {"attempts", attempts_json(fit.attempts)}};
    if (fit.reached)
        return json;
    const FitShortfall& shortfall = fit.shortfall;
    json["shortfall"] = {{"reason", name(shortfall.reason)},
                         {"at_mm", {shortfall.where[0], shortfall.where[1], shortfall.where[2]}},
                         {"text", shortfall.text}};
    for (const int vertex : {shortfall.a, shortfall.b})
        if (vertex >= 0)
            json["shortfall"]["vertices"].push_back(part.source_vertex[size_t(vertex)]);
    if (shortfall.a >= 0)
        json["shortfall"]["angle_deg"] = degrees(shortfall.angle);
    return json;
}

Json holes_json(const TrimResult& trim, const PartFile& part)
{
    Json filled = Json::array();
    for (const HoleLeftFilled& hole : trim.left_filled)
        filled.push_back({{"vertex", part.source_vertex[size_t(hole.vertex)]}, {"why", hole.why}});
    return {{"trimmed", trim.loop.size()}, {"distance_mm", trim.distance}, {"left_filled", std::move(filled)}};
}

/// Of a layout: its patches one by one, and how smoothly they join.
Json patches_json(const PatchesFit& fit, const Certificate& certificate, const SurfaceFigures& figures)
{
    int controls = 0;
    Json list = Json::array();
    for (size_t p = 0; p < fit.patches.patch.size(); ++p) {
        const NurbsSurface& patch = fit.patches.patch[p];
        const GreatestDeviation& deviation = fit.patch_deviation[p];
        controls += int(patch.control.cols());
        list.push_back({{"control_points_u", patch.count_u},
                        {"control_points_v", patch.count_v},
                        {"degree_u", patch.degree_u},
                        {"degree_v", patch.degree_v},
                        {"deviation_max_mm", deviation.max},
                        {"deviation_max_at_mm", {deviation.where[0], deviation.where[1], deviation.where[2]}}});
    }
    double sum = 0;
    for (const InterfaceCertificate& joint : certificate.interfaces)
        sum += joint.mean_angle;
    const size_t joints = certificate.interfaces.size();
    Json smoothed = nullptr;
    if (const auto& j = fit.joins)
        smoothed = {{"angle_before_deg", degrees(j->angle_before)},
                    {"angle_after_deg", degrees(j->angle_after)},
                    {"patches_kept", j->kept},
                    {"places", j->places},
                    {"places_of_edges", j->edges}};
    return {{"patches", list},
            {"faces_divided", fit.layout.split},
            {"edges", fit.layout.edges},
            {"interfaces", joints},
            {"interface_angle_max_deg", degrees(certificate_figures(certificate).greatest_angle)},
            {"interface_angle_mean_deg", joints > 0 ? degrees(sum) / double(joints) : 0},
            {"joins_smoothed", std::move(smoothed)},
            {"control_points", controls},
            {"shared_control_points", figures.control_points},
            {"singular_nodes", figures.singular_nodes}};
}

} // namespace

nlohmann::ordered_json deformation_json(const Deformation& deformation, const DeformResult& result)
{
    Json json = {{"control_points_given", deformation.moves.size()}, {"lattice", nullptr}};
    if (const auto& lattice = deformation.lattice) {
        int moved = 0;
        for (Eigen::Index p = 0; p < lattice->move.cols(); ++p)
            moved += !lattice->move.col(p).isZero(0);
        json["lattice"] = {{"count", lattice->count}, {"degree", lattice->degree}, {"points_moved", moved}};
    }
    json["largest_mm"] = result.largest;
    json["off_lattice_mm"] = result.off_lattice;
    return json;
}

nlohmann::ordered_json surface_json(const SurfaceStage& stage, const PartFile& part)
{
    const Deviation& d = stage.deviation;
    const bool with_tolerance = stage.fit.has_value();
    const NurbsSurface& surface = stage.result.surface;
    const SurfaceFigures figures = surface_figures(stage);
    Json json;
    if (stage.patches)
        json = patches_json(*stage.patches, stage.certificate, figures);
    else
        json = {{"control_points_u", surface.count_u},
                {"control_points_v", surface.count_v},
                {"degree_u", surface.degree_u},
                {"degree_v", surface.degree_v}};
    if (!stage.choice.empty())
        json["choice"] = stage.choice;
    json["deviation_max_mm"] = figures.deviation_max;
    json["deviation_rms_mm"] = figures.deviation_rms;
    json["deviation_p95_mm"] = figures.deviation_p95;
    if (stage.source) { // the deviations are from the smooth sheet, which the facets of the mesh miss
        json["facets_off_sheet_mm"] = stage.source->facets_off;
        json["sheet_known_within_mm"] = stage.source->sheet.left;
    }
    json["surface_to_mesh"] = statistics_json(d.surface_to_mesh, with_tolerance);
    json["mesh_to_surface"] = statistics_json(d.mesh_to_surface, with_tolerance);
    if (!stage.patches) {
        json["holes"] = holes_json(stage.trim, part);
        json["normal_deviation"] = {
            {"mean_deg", degrees(d.normal.mean)}, {"p95_deg", degrees(d.normal.p95)},
            {"max_deg", degrees(d.normal.max)},   {"max_away_from_sharp_edges_deg", degrees(d.normal.max_smooth)},
            {"share_turned", d.normal.turned},    {"at_mm", {d.normal.where[0], d.normal.where[1], d.normal.where[2]}}};
    }
    if (!stage.fit)
        json["between_data"] = statistics_json(d.between_data, false);
    else {
        json["fit"] = fit_json(*stage.fit, part);
        json["share_within_tolerance"] = d.within();
    }
    return json;
}

} // namespace spia
