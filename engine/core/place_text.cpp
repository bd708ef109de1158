#include "engine/core/place_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace spia {

std::string place_text(const Eigen::Vector3d& place)
{
    const auto tidy = [](double x) { return std::abs(x) < 5e-5 ? 0 : x; };
    return fmt::format("{:.6g}, {:.6g}, {:.6g}", tidy(place.x()), tidy(place.y()), tidy(place.z()));
}

std::string place_text(std::span<const Eigen::Vector3d> places)
{
    constexpr size_t most = 8;
    std::string text;
    for (const Eigen::Vector3d& place : places.first(std::min(most, places.size())))
        text += (text.empty() ? "" : "; ") + place_text(place);
    return places.size() > most ? fmt::format("{} and {} more", text, places.size() - most) : text;
}

} // namespace spia
