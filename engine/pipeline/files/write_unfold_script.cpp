#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <set>

#include "engine/core/vector_json.h"
#include "engine/pipeline/files/target_json.h"
#include "engine/pipeline/files/unfold_file.h"

namespace spia {
namespace {
Json names_of(const BendMap& map, const std::vector<int>& labels)
{
    Json list = Json::array();
    for (const int label : labels)
        list.push_back(map.name(label));
    return list;
}

Json regions_json(const BendMap& map)
{
    Json list = Json::array();
    for (int label = 0; label <= map.label.maxCoeff(); ++label) {
        const bool region = label < int(map.regions.size());
        list.push_back({{"name", map.name(label)},
                        {"kind", region ? "region" : "bend"},
                        {"at", vector_json(region ? map.regions[size_t(label)].place
                                                  : map.bends[size_t(label) - map.regions.size()].place)},
                        {"area_mm2", map.area_of(label)}});
    }
    return list;
}

/// The labels that some faces are all of; none: they are no whole regions.
std::optional<std::vector<int>> whole_labels(const BendMap& map, const std::vector<int>& faces)
{
    std::vector<char> picked(size_t(map.label.size()), 0);
    std::set<int> labels;
    for (const int f : faces) {
        picked[size_t(f)] = 1;
        labels.insert(map.label[f]);
    }
    for (Eigen::Index f = 0; f < map.label.size(); ++f)
        if (labels.count(map.label[f]) && !picked[size_t(f)])
            return std::nullopt;
    return std::vector<int>(labels.begin(), labels.end());
}

Json friction_json(const BendMap& map, const ContactRegion& rubs, const std::vector<int>& source_face)
{
    Json json = {{"coefficient", rubs.friction}};
    if (rubs.pressure_MPa)
        json["pressure_MPa"] = *rubs.pressure_MPa;
    if (rubs.force_N)
        json["force_N"] = *rubs.force_N;
    json["sides"] = rubs.sides;
    if (rubs.faces.empty())
        return json;
    if (const auto labels = whole_labels(map, rubs.faces))
        json["regions"] = names_of(map, *labels);
    else {
        std::set<int> numbers; // several triangles may be one face of the file
        for (const int f : rubs.faces)
            numbers.insert(source_face.empty() ? f : source_face[size_t(f)]);
        json["faces"] = numbers;
    }
    return json;
}

Json step_json(const BendMap& map, const PlannedStep& step, const std::vector<int>& source_face)
{
    Json json = {{"name", step.name}, {"kind", name(step.kind)}};
    if (step.kind == UnfoldKind::lay) {
        json["freed"] = {{"regions", names_of(map, step.freed)}};
        json["fixed"] = {{"regions", names_of(map, step.fixed)}};
        if (step.fixed.size() > 1)
            json["carrying"] = {{"regions", names_of(map, {step.carrier})}};
    } else if (step.kind == UnfoldKind::unroll) {
        const int carrier = map.label[step.pick.carrying.front()];
        json["carrying"] = {{"regions", names_of(map, {carrier})}};
    }
    Json target = step.pick.target ? target_json(*step.pick.target) : Json::object();
    if (step.within_mm > 0)
        target["within_mm"] = step.within_mm;
    if (step.offset_mm != 0)
        target["offset_mm"] = step.offset_mm;
    if (step.extent_mm)
        target["extent_mm"] = *step.extent_mm;
    if (!target.empty())
        json["target"] = target;
    if (step.pick.friction)
        json["friction"] = friction_json(map, *step.pick.friction, source_face);
    Json options = Json::object();
    if (step.tolerance)
        options["tolerance"] = *step.tolerance;
    if (step.most_energy_steps)
        options["most_energy_steps"] = *step.most_energy_steps;
    if (step.most_newton_steps)
        options["most_newton_steps"] = *step.most_newton_steps;
    if (!options.empty())
        json["options"] = options;
    return json;
}

/// Faces by regions and bends as far as these are whole, the rest by numbers of the file.
Json faces_json(const PartFile& part, const BendMap& map, const std::vector<int>& faces)
{
    std::vector<int> missing(size_t(map.label.maxCoeff() + 1), 0);
    for (const int label : map.label)
        ++missing[size_t(label)];
    for (const int f : faces)
        --missing[size_t(map.label[f])];
    std::vector<int> whole, numbers;
    for (size_t label = 0; label < missing.size(); ++label)
        if (missing[label] == 0)
            whole.push_back(int(label));
    for (const int f : faces)
        if (missing[size_t(map.label[f])] != 0)
            numbers.push_back(part.source_face[size_t(f)]);
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    Json json = Json::object();
    if (!whole.empty())
        json["regions"] = names_of(map, whole);
    if (!numbers.empty())
        json["faces"] = numbers;
    return json;
}

/// A step whose faces may be any.
Json step_json(const PartFile& part, const BendMap& map, const PlannedStep& step)
{
    PlannedStep named = step;
    named.freed.clear();
    named.fixed.clear();
    Json json = step_json(map, named, part.source_face);
    if (step.kind == UnfoldKind::unroll)
        json["carrying"] = faces_json(part, map, step.pick.carrying);
    if (step.kind != UnfoldKind::lay)
        return json;
    json["freed"] = faces_json(part, map, step.pick.freed);
    json["fixed"] = faces_json(part, map, step.pick.fixed);
    if (!step.pick.carrying.empty() && step.pick.carrying != step.pick.fixed)
        json["carrying"] = faces_json(part, map, step.pick.carrying);
    return json;
}

std::string script_text(const BendMap& map, const Json& steps)
{
    return Json{{"schema", "spia.unfold/1"}, {"regions", regions_json(map)}, {"steps", steps}}.dump(
               1, ' ', false, Json::error_handler_t::replace) +
           "\n";
}

} // namespace

std::string unfold_script_json(const BendMap& map, const UnfoldScript& steps, const std::vector<int>& source_face)
{
    Json list = Json::array();
    for (const PlannedStep& step : steps)
        list.push_back(step_json(map, step, source_face));
    return script_text(map, list);
}

std::string unfold_script_json(const PartFile& part, const BendMap& map, const UnfoldScript& steps)
{
    Json list = Json::array();
    for (const PlannedStep& step : steps)
        list.push_back(step_json(part, map, step));
    return script_text(map, list);
}

} // namespace spia
