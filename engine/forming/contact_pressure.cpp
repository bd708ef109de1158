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
    constexpr double least_share =
        0.1; // a wall within 6 degrees of the stamping direction: the pressure would be ten times
             // what a tool makes of that force
    if (!(seen > least_share * area))
        throw InputError(fmt::format(
            "the contact region \"{}\" is seen along the stamping direction ({:.3g}, {:.3g}, {:.3g}) with {:.2g} % of its area only: "
            "a force cannot press there; give a pressure, or another direction",
            region.name, direction[0], direction[1], direction[2], 100 * seen / area));
    return {area, *region.force_N / seen};
}

} // namespace spia
