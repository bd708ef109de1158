#pragma once
#include <Eigen/Core>

namespace spia {

/// The colour map of every picture and file: viridis, perceptually uniform and readable with colour
/// blindness and in grey. Piecewise linear in sRGB through nine anchors. [S. van der Walt and N.
/// Smith, matplotlib 2015, dedicated to the public domain (CC0)] @param t clamped to 0..1, dark
/// blue to yellow @return sRGB, 0..1
Eigen::Vector3d viridis(double t);

/// sRGB (what a screen takes) to linear RGB (what glTF wants), 0..1 each. [IEC 61966-2-1]
Eigen::Vector3d linear_rgb(const Eigen::Vector3d& srgb);

/// The values shown from one end of the colour map to the other.
struct ColourRange {
    double least = 0, greatest = 1;
    /// 0..1 within the range; 0.5 everywhere if it is a single value
    double position(double value) const { return greatest > least ? (value - least) / (greatest - least) : 0.5; }
};

/// From the least to the greatest value; at least one value
inline ColourRange colour_range(const Eigen::VectorXd& values) { return {values.minCoeff(), values.maxCoeff()}; }

} // namespace spia
