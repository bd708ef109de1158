#include "engine/report/json/unfold_report_json.h"

#include "engine/core/angle.h"
#include "engine/core/vector_json.h"
#include "engine/mesh/topology.h"
#include "engine/options/command_line_json.h"
#include "engine/part/curved_faces.h"
#include "engine/pipeline/files/target_json.h"
#include "engine/pipeline/shortcomings/unfold_shortcomings.h"
#include "engine/report/figures/figures.h"
#include "engine/report/json/bend_table_json.h"

namespace spia {
namespace {

Json bends_json(const BendMap& map)
{
    Json list = Json::array();
    for (size_t k = 0; k < map.bends.size(); ++k) {
        const Bend& bend = map.bends[k];
        Json between = {map.name(bend.a)};
        if (bend.b >= 0)
            between.push_back(map.name(bend.b));
        list.push_back({{"name", map.name(int(map.regions.size() + k))},
                        {"between", std::move(between)},
                        {"angle_deg", bend.angle * degrees_per_radian},
                        {"radius_mm", bend.radius},
                        {"length_mm", bend.length},
                        {"faces", bend.faces},
                        {"area_mm2", bend.area},
                        {"at_mm", vector_json(bend.place)}});
    }
    return list;
}

Json found_regions_json(const BendMap& map)
{
    Json list = Json::array();
    for (size_t k = 0; k < map.regions.size(); ++k) {
        const SheetRegion& region = map.regions[k];
        list.push_back({{"name", map.name(int(k))},
                        {"faces", region.faces},
                        {"area_mm2", region.area},
                        {"flatness", region.flatness},
                        {"normal", vector_json(region.normal)},
                        {"at_mm", vector_json(region.place)}});
    }
    return list;
}

Json state_json(const UnfoldState& state)
{
    Json json = {{"name", state.name},
                 {"face", state.plain},
                 {"converged", state.converged},
                 {"reason", state.reason},
                 {"system", name(state.system)},
                 {"trusted_strain", state.trusted_strain},
                 {"equivalent_strain_max", state.face.strain_equivalent.maxCoeff()},
                 {"thinning_max", state.face.thinning.maxCoeff()},
                 {"thinning_min", state.face.thinning.minCoeff()},
                 {"necking_triangles", state.necking},
                 {"friction_share", state.friction_share},
                 {"overlap", {{"places", state.overlap.places}, {"landed", state.overlap.landed}}},
                 {"seconds", state.seconds}};
    if (state.overlap.places > 0)
        json["overlap"]["first_mm"] = vector_json(state.overlap.first);
    if (state.on) {
        json["target"] = target_json(state.on->face);
        json["distance_to_held_mm"] = state.on->distance_mm;
        json["angle_to_fixed_deg"] = state.on->angle * degrees_per_radian;
        json["reach_mm"] = state.reach.farthest_mm;
        json["faces_without_room"] = state.reach.without_room;
    }
    return json;
}

Json blank_json(const BlankFigures& blank)
{
    return {{"converged", blank.converged},
            {"equivalent_strain_max", blank.strain},
            {"thinning_min", blank.least_thinning},
            {"thinning_max", blank.most_thinning},
            {"flipped_triangles", blank.flipped},
            {"overlaps", blank.overlaps},
            {"angular_rms", blank.distortion.angular_rms},
            {"area_rms", blank.distortion.area_rms}};
}

Json polish_json(const PolishedBlank& polished)
{
    return {{"steps", blank_json(polished.steps)},
            {"whole", blank_json(polished.polished)},
            {"system", name(polished.whole.report.system)},
            {"reason", polished.whole.report.reason},
            {"seconds", polished.whole.report.seconds},
            {"outline_distance_mm", polished.outline_distance_mm},
            {"outline_distance_mean_mm", polished.outline_distance_mean_mm},
            {"worse", polished.worse}};
}

} // namespace

std::string unfold_report_json(const std::filesystem::path& input, const PartFile& part, const BendMap& map,
                               const UnfoldScript& steps, const UnfoldRun& run,
                               const std::vector<std::string>& findings,
                               const std::vector<std::filesystem::path>& files, const PolishedBlank* polished,
                               const BendTable* table)
{
    Json states = Json::array(), names = Json::array();
    for (const UnfoldState& state : run.states)
        states.push_back(state_json(state));
    for (const auto& file : files)
        names.push_back(file.string());
    Json json = {
        {"schema", "spia.unfold-result/1"},
        {"input", input.string()},
        {"part",
         {{"vertices", part.mesh.vertices()}, {"triangles", part.mesh.triangles()}, {"area_mm2", sheet_area(part)}}},
        {"regions", found_regions_json(map)},
        {"bends", bends_json(map)},
        {"smoothed", map.smoothed},
        {"steps", steps.size()},
        {"states", states},
        {"failure", run.failure.empty() ? Json(nullptr) : Json(run.failure)},
        {"findings", findings},
        {"shortcomings", shortcomings(run, bounding_diagonal(part.mesh), findings)}};
    if (run.blank) {
        const BlankSize blank = blank_size(part.mesh, *run.blank);
        const Eigen::Vector2d size = blank.sides();
        json["blank"] = {{"size_mm", {size[0], size[1]}}, {"area_mm2", blank.area}, {"flipped_triangles", run.flipped}};
    } else
        json["blank"] = nullptr;
    if (table)
        json["bend_table"] = bend_table_json(*table);
    json["polish"] = polished ? polish_json(*polished) : Json(nullptr);
    json["files"] = names;
    return with_command_line_texts(std::move(json)).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace spia
