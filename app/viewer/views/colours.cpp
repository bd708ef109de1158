#include "app/viewer/views/colours.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/core/colour_map.h"
#include "engine/report/text/zone_look.h"

namespace spia::viewer {
namespace {

/// Cube roots of the responses of the three kinds of cones are mixed into lightness and colour.
const Eigen::Matrix3d cones_of_linear_rgb{{0.4122214708, 0.5363325363, 0.0514459929},
                                          {0.2119034982, 0.6806995451, 0.1073969566},
                                          {0.0883024619, 0.2817188376, 0.6299787005}};
const Eigen::Matrix3d lab_of_roots{{0.2104542553, 0.7936177850, -0.0040720468},
                                   {1.9779984951, -2.4285922050, 0.4505937099},
                                   {0.0259040371, 0.7827717662, -0.8086757660}};

double screen_of_linear(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

// The diverging map: lightness falls evenly from the middle to both ends. The colours grow faster
// near the middle, where the light hides them, and end as strong as a screen can show them.
constexpr double middle_lightness = 0.95, end_lightness = 0.46;
constexpr Oklab blue_end{end_lightness, -0.028, -0.150}, orange_end{end_lightness, 0.080, 0.093};

Eigen::Vector3d diverging(double t)
{
    const double side = 2 * t - 1, far = std::abs(side), strength = far * (1.7 - 0.7 * far);
    const Oklab& end = side < 0 ? blue_end : orange_end;
    return srgb({middle_lightness + far * (end.L - middle_lightness), strength * end.a, strength * end.b})
        .cwiseMax(0)
        .cwiseMin(1);
}

} // namespace

Oklab oklab(const Eigen::Vector3d& screen)
{
    const Eigen::Vector3d roots =
        (cones_of_linear_rgb * linear_rgb(screen)).unaryExpr([](double c) { return std::cbrt(c); });
    const Eigen::Vector3d lab = lab_of_roots * roots;
    return {lab[0], lab[1], lab[2]};
}

Eigen::Vector3d srgb(const Oklab& colour)
{
    static const Eigen::Matrix3d roots_of_lab = lab_of_roots.inverse(), linear_of_cones = cones_of_linear_rgb.inverse();
    const Eigen::Vector3d roots = roots_of_lab * Eigen::Vector3d(colour.L, colour.a, colour.b);
    return (linear_of_cones * roots.array().cube().matrix()).unaryExpr([](double c) { return screen_of_linear(c); });
}

Eigen::Vector3d map_colour(ColourMap map, double t)
{
    t = std::clamp(t, 0.0, 1.0);
    switch (map) {
    case ColourMap::viridis: return viridis(t);
    case ColourMap::diverging: return diverging(t);
    case ColourMap::zones: {
        const Colour colour = zone_colour(Zone(int(std::lround(t * (zone_count - 1)))));
        return Eigen::Vector3d(colour[0], colour[1], colour[2]);
    }
    case ColourMap::quality: return diverging(1 - t / 2);
    case ColourMap::grey: return srgb({0.28 + 0.66 * t, 0, 0}).cwiseMax(0).cwiseMin(1);
    }
    return {};
}

double place_in_map(const ColourScale& scale, double share)
{
    if (scale.map != ColourMap::diverging)
        return share;
    const double least = scale.least, greatest = scale.greatest, value = least + share * (greatest - least);
    if (value < 0)
        return least < 0 ? 0.5 - 0.5 * std::min(1., value / least) : 0;
    return greatest > 0 ? 0.5 + 0.5 * std::min(1., value / greatest) : 0.5;
}

Colour colour_of(const ColourScale& scale, float value)
{
    if (std::isnan(value))
        return no_value;
    double t = scale.greatest > scale.least ? (value - scale.least) / (scale.greatest - scale.least) : 0.5;
    if (scale.bands > 0) {
        const double band = std::clamp(std::floor(t * scale.bands), 0.0, scale.bands - 1.0);
        // the outer bands have the colours of the scale's ends
        t = scale.bands > 1 ? band / (scale.bands - 1) : 0.5;
    }
    const Eigen::Vector3f colour = map_colour(scale.map, place_in_map(scale, std::clamp(t, 0., 1.))).cast<float>();
    return {colour[0], colour[1], colour[2], 1};
}

double lightness(const Colour& colour) { return oklab({colour[0], colour[1], colour[2]}).L; }

} // namespace spia::viewer
