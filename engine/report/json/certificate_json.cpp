#include "engine/report/json/certificate_json.h"

#include <cmath>
#include <numbers>

namespace spia {
namespace {

using Json = nlohmann::ordered_json;

Json place_json(const PatchPlace& place)
{
    return {{"u", place.u}, {"v", place.v}, {"at_mm", {place.position[0], place.position[1], place.position[2]}}};
}

Json patch_json(const PatchCertificate& c)
{
    Json json = {
        {"positive_jacobian", !c.refusal},
        {"proved_jacobian_mm2", c.proved_jacobian},
        {"pieces", c.pieces},
        {"refused", nullptr},
        {"jacobian_min_mm2", c.least_jacobian},
        {"jacobian_max_mm2", c.greatest_jacobian},
        {"scaled_jacobian_min", c.least_scaled},
        {"scaled_jacobian_min_at", place_json(c.least_scaled_at)},
        {"scaled_jacobian_mean", c.mean_scaled},
        {"orthogonality", c.orthogonality},
        {"condition_max", std::isfinite(c.condition) ? Json(c.condition) : Json(nullptr)},
        {"aspect_max", c.aspect},
        {"neighbour_area_ratio_max", std::isfinite(c.neighbour_area) ? Json(c.neighbour_area) : Json(nullptr)}};
    if (!std::isfinite(c.aspect))
        json["aspect_max"] = nullptr;
    if (c.refusal) {
        json["refused"] = place_json(c.refusal->place);
        json["refused"]["why"] = describe(*c.refusal);
    }
    return json;
}

} // namespace

nlohmann::ordered_json certificate_json(const Certificate& certificate)
{
    Json json = {{"suited", certificate.suited()},
                 {"watertight", certificate.leak.empty()},
                 {"leak", certificate.leak},
                 {"patches", Json::array()},
                 {"interfaces", Json::array()}};
    for (const PatchCertificate& patch : certificate.patch)
        json["patches"].push_back(patch_json(patch));
    const double degree = std::numbers::pi / 180;
    for (const InterfaceCertificate& each : certificate.interfaces)
        json["interfaces"].push_back({{"first", name(each.joint.first)},
                                      {"second", name(each.joint.second)},
                                      {"reversed", each.joint.reversed},
                                      {"angle_max_deg", each.greatest_angle / degree},
                                      {"angle_mean_deg", each.mean_angle / degree}});
    return json;
}

} // namespace spia
