#pragma once
#include <optional>
#include <vector>

#include "engine/unfold/binder_face.h"

namespace spia {

/// What one step of local unfolding moves, and onto what.
struct UnfoldPick {
    std::vector<int> fixed; ///< faces that stay where they are and carry the target
    std::vector<int> freed; ///< faces to move onto it
    std::optional<BinderFace> target =
        {};                         ///< not given: the plane, cylinder or cone of the carrying faces in the state
    std::vector<int> carrying = {}; ///< of the fixed ones; empty: all of them
};

} // namespace spia
