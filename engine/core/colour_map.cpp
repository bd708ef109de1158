#include "engine/core/colour_map.h"

#include <algorithm>
#include <cmath>

namespace spia {

Eigen::Vector3d viridis(double t)
{
    constexpr int anchors[] = {0x440154, 0x472D7B, 0x3B528B, 0x2C728E, 0x21908C,
                               0x27AD81, 0x5DC863, 0xAADC32, 0xFDE725};
    constexpr int intervals = int(std::size(anchors)) - 1;
    const double x = std::clamp(t, 0.0, 1.0) * intervals;
    const int i = std::min(int(x), intervals - 1);
    const auto rgb = [](int hex) -> Eigen::Vector3d {
        return Eigen::Vector3d(hex >> 16, hex >> 8 & 255, hex & 255) / 255.0;
    };
    return rgb(anchors[i]) + (x - i) * (rgb(anchors[i + 1]) - rgb(anchors[i]));
}

Eigen::Vector3d linear_rgb(const Eigen::Vector3d& srgb)
{
    return srgb.unaryExpr([](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); });
}

} // namespace spia
