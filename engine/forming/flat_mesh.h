#pragma once
#include "engine/forming/blank.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// The blank as a mesh at z = 0, with the faces of the part.
TriMesh flat_mesh(const TriMesh& part, const Blank& blank);

} // namespace spia
