#include "engine/report/json/attempts_json.h"

namespace spia {

nlohmann::ordered_json attempts_json(const std::vector<AttemptReport>& attempts)
{
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const AttemptReport& each : attempts) {
        nlohmann::ordered_json json = {
            {"name", each.name}, {"won", each.won}, {"reason", each.reason}, {"seconds", each.seconds}};
        if (!each.within.empty())
            json["attempts"] = attempts_json(each.within);
        list.push_back(std::move(json));
    }
    return list;
}

} // namespace spia
