#pragma once
#include <array>
#include <vector>

#include "engine/nurbs/multi_patch.h"

namespace spia {

/// How patches join, in the words of MFEM: corners, edges between them, and knot vectors that edges
/// share.
struct MfemTopology {
    struct Edge {
        int knots;    ///< number of the knot vector
        int from, to; ///< corners, in the sense of the knot vector
    };
    int corners = 0;
    std::vector<std::array<int, 4>> corner; ///< per patch those of (0, 0), (1, 0), (1, 1), (0, 1)
    std::vector<Edge> edges;
    std::vector<std::array<int, 4>> edge; ///< per patch those of v = 0, u = 1, v = 1, u = 0
};

/// Numbers rise in the order of patches; a knot vector has the sense of the first patch that has
/// it.
/// @pre require_watertight() @throws InputError if MFEM has no words for it, see write_mfem()
MfemTopology mfem_topology(const MultiPatch& patches);

} // namespace spia
