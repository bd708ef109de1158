#include "engine/pipeline/files/target_json.h"

#include <Eigen/Geometry>

#include "engine/core/angle.h"
#include "engine/core/vector_json.h"

namespace spia {
namespace {
}

Json target_json(const TargetSurface& face)
{
    if (const auto* plane = std::get_if<PlaneFace>(&face))
        return {{"plane",
                 {{"origin", vector_json(plane->origin)},
                  {"normal", vector_json(plane->axes.col(0).cross(plane->axes.col(1)))}}}};
    if (const auto* cylinder = std::get_if<CylinderFace>(&face))
        return {{"cylinder",
                 {{"origin", vector_json(cylinder->origin)},
                  {"axis", vector_json(cylinder->axis)},
                  {"radius", cylinder->radius}}}};
    if (const auto* height = std::get_if<HeightFace>(&face))
        return {{"smooth",
                 {{"origin", vector_json(height->origin)},
                  {"normal", vector_json(height->axes.col(0).cross(height->axes.col(1)))}}}};
    const auto& cone = std::get<ConeFace>(face);
    return {{"cone",
             {{"apex", vector_json(cone.apex)},
              {"axis", vector_json(cone.axis)},
              {"half_angle_deg", cone.half_angle * degrees_per_radian}}}};
}

} // namespace spia
