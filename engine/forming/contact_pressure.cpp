#include "engine/forming/contact_pressure.h"

#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia {

ContactPressure contact_pressure(const ContactRegion& region, const Eigen::Matrix3Xd& area_vector,
                                 const Eigen::Vector3d& direction)
{
    double seen = 0, area = 0;
    for (const int f : region.faces) {
        seen += std::abs(area_vector.col(f).dot(direction));
        area += area_vector.col(f).norm();
    }
    if (region.pressure_MPa)
        return {area, *region.pressure_MPa};
    constexpr double least_share = 1e-3; // a wall within 0.06 degrees of the stamping direction
    if (!(seen > least_share * area))
        throw InputError(
            fmt::format("the contact region \"{}\" is not seen along the stamping direction: a force cannot "
                        "press there; give a pressure",
                        region.name));
    return {area, *region.force_N / seen};
}

} // namespace spia
