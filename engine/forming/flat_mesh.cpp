#include "engine/forming/flat_mesh.h"

namespace spia {

TriMesh flat_mesh(const TriMesh& part, const Blank& blank)
{
    TriMesh flat{Eigen::Matrix3Xd::Zero(3, part.vertices()), part.triangle};
    flat.position.topRows<2>() = blank.position;
    return flat;
}

} // namespace spia
