#include "engine/core/place_text.h"

#include <cmath>
#include <fmt/core.h>

namespace spia {

std::string place_text(const Eigen::Vector3d& place)
{
    const auto tidy = [](double x) { return std::abs(x) < 5e-5 ? 0 : x; };
    return fmt::format("{:.6g}, {:.6g}, {:.6g}", tidy(place.x()), tidy(place.y()), tidy(place.z()));
}

} // namespace spia
