#include "app/viewer/views/palette.h"

#include <cmath>
#include <numbers>

#include "app/viewer/views/colours.h"

namespace spia::viewer::palette {

std::array<Colour, 4> sides()
{
    std::array<Colour, 4> result;
    constexpr double hue[] = {45, 150, 255, 340}; // degrees: orange, green, blue, magenta
    for (size_t k = 0; k < 4; ++k) {
        constexpr double lightness = 0.70, strength = 0.155;
        const double angle = hue[k] * std::numbers::pi / 180;
        const Eigen::Vector3f rgb = srgb({lightness, strength * std::cos(angle), strength * std::sin(angle)})
                                        .cwiseMax(0)
                                        .cwiseMin(1)
                                        .cast<float>();
        result[k] = {rgb[0], rgb[1], rgb[2], 1};
    }
    return result;
}

} // namespace spia::viewer::palette
