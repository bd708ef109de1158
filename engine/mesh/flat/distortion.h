#pragma once
#include <Eigen/Core>
#include <string_view>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// How far a flat layout is from the part in angle and in area, as the paper's Table 3 measures it.
struct Distortion {
    double angular_rms; ///< see angular_definition
    double area_rms;    ///< see area_definition
};
inline constexpr std::string_view distortion_definition =
    "angular_rms = sqrt(sum over corners of (a - f)^2 / f^2 / (3 F)), a the flat angle, f the angle on the part, at inner "
    "vertices scaled so that their sum is 2 pi; area_rms = sqrt(sum of A (q - 1)^2 / sum of A), A the area on the part, q "
    "the flat area over A, divided by its mean over the part";

/// @param flat 2 by #V @throws nothing; a layout that is the part itself has no distortion
Distortion distortion(const TriMesh& part, const Eigen::Matrix2Xd& flat);

} // namespace spia
