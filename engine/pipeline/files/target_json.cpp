#include "engine/pipeline/files/target_json.h"

#include <Eigen/Geometry>
#include <numbers>

namespace spia {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

Json xyz(const Eigen::Vector3d& v) { return Json::array({v[0], v[1], v[2]}); }

} // namespace

Json target_json(const TargetSurface& face)
{
    if (const auto* plane = std::get_if<PlaneFace>(&face))
        return {
            {"plane", {{"origin", xyz(plane->origin)}, {"normal", xyz(plane->axes.col(0).cross(plane->axes.col(1)))}}}};
    if (const auto* cylinder = std::get_if<CylinderFace>(&face))
        return {{"cylinder",
                 {{"origin", xyz(cylinder->origin)}, {"axis", xyz(cylinder->axis)}, {"radius", cylinder->radius}}}};
    if (const auto* height = std::get_if<HeightFace>(&face))
        return {{"smooth",
                 {{"origin", xyz(height->origin)}, {"normal", xyz(height->axes.col(0).cross(height->axes.col(1)))}}}};
    const auto& cone = std::get<ConeFace>(face);
    return {
        {"cone", {{"apex", xyz(cone.apex)}, {"axis", xyz(cone.axis)}, {"half_angle_deg", cone.half_angle * degrees}}}};
}

} // namespace spia
