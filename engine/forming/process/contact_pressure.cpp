#include "engine/forming/process/contact_pressure.h"

#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia {
namespace {

/// @param direction of a face; @param name_of_direction along what it is seen
template <class Direction>
ContactPressure pressure(const ContactRegion& region, const Eigen::Matrix3Xd& area_vector, const Direction& direction,
                         const std::string& name_of_direction)
{
    double seen = 0, area = 0;
    for (const int f : region.faces) {
        seen += std::abs(area_vector.col(f).dot(direction(f)));
        area += area_vector.col(f).norm();
    }
    if (region.pressure_MPa)
        return {area, *region.pressure_MPa};
    constexpr double least_share =
        0.1; // a wall within 6 degrees of the stamping direction: the pressure would be ten times
             // what a tool makes of that force
    if (!(seen > least_share * area))
        throw InputError(fmt::format("the contact region \"{}\" is seen along {} with {:.2g} % of its area only: "
                                     "a force cannot press there; give a pressure, or another direction",
                                     region.name, name_of_direction, 100 * seen / area));
    return {area, *region.force_N / seen};
}

} // namespace

ContactPressure contact_pressure(const ContactRegion& region, const Eigen::Matrix3Xd& area_vector,
                                 const Eigen::Vector3d& direction)
{
    return pressure(
        region, area_vector, [&](int) -> const Eigen::Vector3d& { return direction; },
        fmt::format("the stamping direction ({:.3g}, {:.3g}, {:.3g})", direction[0], direction[1], direction[2]));
}

ContactPressure contact_pressure(const ContactRegion& region, const Eigen::Matrix3Xd& area_vector,
                                 const Eigen::Matrix3Xd& square_to_tool)
{
    return pressure(
        region, area_vector, [&](int f) { return square_to_tool.col(f); }, "the normals of the target");
}

} // namespace spia
