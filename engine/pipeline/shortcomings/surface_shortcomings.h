#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/pipeline/session.h"

namespace spia {

// What makes a surface poor, in words with the way out; nothing where it is good. @pre
// session.surface and session.part

/// Of a surface for which no tolerance was asked for: it is farther from the part than
/// usual_tolerance somewhere. (What was asked for and not reached is told by FitReport::shortfall.)
std::optional<std::string> far_surface(const Session& session);

/// It folds: the certificate is refused elsewhere than at a corner of the grid on a
/// smooth outline, where CAD does not mind, or samples look the other way than the part. Of a
/// deformed surface the one that leaves the program.
std::optional<std::string> folded_surface(const Session& session);

/// Where a tolerance or patches made it: it has more control points than enough_control_points().
std::optional<std::string> heavy_surface(const Session& session);

/// Where the program chose what it is made of: it has a sharper corner than well_shaped_jacobian.
std::optional<std::string> ill_shaped_surface(const Session& session);

/// A joint of patches at which they meet at a greater angle than the triangles of the part do
/// anywhere, by more than SmoothJoinsOptions::sharp.
struct Kink {
    double angle = 0; ///< radians, between the normals of the patches
    double turn = 0;  ///< radians, the greatest between neighbouring triangles
    size_t patch = 0; ///< from 0, the one with the lower number
};
/// The greatest; nothing where there is none.
std::optional<Kink> greatest_kink(const Session& session);
std::optional<std::string> kinked_surface(const Session& session);

/// All of these but folds, which a deformation may have made.
std::vector<std::string> surface_shortcomings(const Session& session);

} // namespace spia
