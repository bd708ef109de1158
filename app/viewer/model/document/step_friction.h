#pragma once
#include <optional>

#include "engine/forming/process/process.h"

/// What the target of a step rubs against the sheet that is laid on it, as users give it.
namespace spia::viewer {

struct StepFriction {
    std::optional<double> force_N = {};      ///< square to the target; either this
    std::optional<double> pressure_MPa = {}; ///< or this
    double friction = 0.12;                  ///< coefficient of each side
    int sides = 2;                           ///< 2: a pad above, too; 1: the target alone

    friend bool operator==(const StepFriction&, const StepFriction&) = default;
};

/// @param faces on which it rubs; none: on all that the step moves
/// @throws InputError unless it presses with a force or a pressure above 0
ContactRegion friction_of(const StepFriction& friction, std::vector<int> faces);

/// Likewise back, without the faces.
std::optional<StepFriction> numbers_of(const std::optional<ContactRegion>& friction);

} // namespace spia::viewer
