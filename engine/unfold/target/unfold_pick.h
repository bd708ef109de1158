#pragma once
#include <optional>
#include <vector>

#include "engine/forming/process/process.h"
#include "engine/unfold/target/target_surface.h"

namespace spia {

/// What one step of local unfolding moves, and onto what.
struct UnfoldPick {
    std::vector<int> fixed;                   ///< faces that stay where they are and carry the
                                              ///< target
    std::vector<int> freed;                   ///< faces to move onto it
    std::optional<TargetSurface> target = {}; ///< not given: the plane, cylinder or cone of the
                                              ///< carrying faces in the state
    std::vector<int> carrying = {};           ///< of the fixed ones; empty: all of them
    /// What the target, which rests, rubs against the freed faces as they slip from it to where
    /// they are in the state: on these of them, empty: on all. On one side or on both (a pad above,
    /// which rests as well). None: they slide freely.
    std::optional<ContactRegion> friction = {};

    friend bool operator==(const UnfoldPick&, const UnfoldPick&) = default;
};

} // namespace spia
