#pragma once
#include <optional>

#include "engine/forming/process.h"

namespace spia {

/// The rolling direction seen in the plane of the blank; none: none is given.
/// @param plane axes of the blank in space @throws InputError if it is no direction across the normal of the plane
std::optional<Eigen::Vector2d> rolling_in(const ProcessConditions& process, const Eigen::Matrix<double, 3, 2>& plane);

} // namespace spia
