#pragma once
#include <Eigen/Core>

#include "app/viewer/model/document/scene.h"

namespace spia::viewer {

/// A lightness and two colour axes (green to red, blue to yellow) in which equal steps look equally
/// large. [B. Ottosson, A perceptual color space for image processing, 2020]
struct Oklab {
    double L = 0, a = 0, b = 0; ///< L from 0, black, to 1, white
};
Oklab oklab(const Eigen::Vector3d& srgb);
Eigen::Vector3d srgb(const Oklab& colour); ///< outside 0..1 where a screen cannot show it

/// Colour of a map, sRGB. @param t clamped to 0..1 viridis: that of every picture and file.
/// diverging: dark blue, light grey, dark orange; lightness is the same at t and 1 - t, and the two
/// sides stay apart with every kind of colour blindness. grey: dark to light. quality: dark orange,
/// poor, to light grey, good.
Eigen::Vector3d map_colour(ColourMap map, double t);

/// Where in its map a scale has the colour of a value, 0 to 1. The diverging map has its middle at
/// zero wherever the range lies: each side has its own half, up to the end of the range on that
/// side.
/// @param share of the scale's range that lies below the value, 0 to 1
double place_in_map(const ColourScale& scale, double share);

/// What a value looks like on a surface that is not shaded; not a number: no_value.
Colour colour_of(const ColourScale& scale, float value);
inline constexpr Colour no_value{0.48f, 0.48f, 0.48f, 1};

/// Perceived brightness of a colour, 0..1: whether black or white is the better ink on it.
double lightness(const Colour& colour);

} // namespace spia::viewer
