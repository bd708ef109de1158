#pragma once
#include <vector>

#include "engine/mesh/region.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// The faces around freed ones that are neither freed nor fixed.
struct PickBorder {
    FaceSet held; ///< touch freed faces only in vertices of fixed ones: they stay without being
                  ///< asked
    FaceSet torn; ///< touch freed faces elsewhere: the pick would tear them off
};
PickBorder pick_border(const TriMesh& part, const FaceSet& fixed, const FaceSet& freed);

} // namespace spia
