#include "engine/pipeline/files/patch_file.h"

#include "engine/core/error.h"
#include "engine/core/json_file.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/files/file_members.h"

namespace spia {

namespace {

std::vector<int> vertices(const Json& list, const Place& place, size_t least)
{
    if (!list.is_array() || list.size() < least)
        place.fail(fmt::format("must be a list of {} or more vertices", least));
    std::vector<int> result;
    for (size_t k = 0; k < list.size(); ++k) {
        if (!list[k].is_number_integer() || list[k].get<double>() < 0 || list[k].get<double>() > 2147483647)
            place.entry(k).fail("must be the number of a vertex, from 0");
        result.push_back(list[k].get<int>());
    }
    return result;
}

} // namespace

std::optional<LayoutOptions> patch_layout(const std::string& choice)
{
    if (choice == "one" || choice == "best")
        return std::nullopt;
    LayoutOptions layout;
    if (choice == "auto")
        return layout;
    const Json json = read_json(choice, true);
    const Place top(choice);
    members::require_object(json, top, {"cuts", "corners", "edge_deg", "smooth_joins"});
    if (const Json* cuts = members::find(json, top, "cuts", false)) {
        if (!cuts->is_array())
            top.member("cuts").fail("must be a list of paths [[12, 40], ...]");
        for (size_t i = 0; i < cuts->size(); ++i)
            layout.cuts.push_back(vertices((*cuts)[i], top.member("cuts").entry(i), 2));
    }
    if (const Json* corners = members::find(json, top, "corners", false))
        layout.corners = vertices(*corners, top.member("corners"), 2);
    if (const Json* smooth = members::find(json, top, "smooth_joins", false)) {
        if (!smooth->is_boolean())
            top.member("smooth_joins").fail("must be true or false");
        layout.smooth_joins = smooth->get<bool>();
    }
    if (const Json* edge = members::find(json, top, "edge_deg", false)) {
        if (!edge->is_number() || !(edge->get<double>() >= 1) || !(edge->get<double>() <= 180))
            top.member("edge_deg").fail("must be an angle in degrees, from 1 to 180");
        layout.edge_deg = edge->get<double>();
        if (!layout.cuts.empty() || !layout.corners.empty())
            top.member("edge_deg").fail("cannot be with cuts or corners, where no edges are looked for; leave it out");
    }
    if (layout.cuts.empty() && layout.corners.empty() && !layout.smooth_joins && !json.contains("edge_deg"))
        top.fail("must have cuts, corners, edge_deg or \"smooth_joins\": true; no file is needed for a layout without "
                 "them (" +
                 mention(option::patches, "auto") + ")");
    return layout;
}

} // namespace spia
