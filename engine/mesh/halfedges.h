#pragma once
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Who is whose neighbour. Vertex and face handles have the indices of the TriMesh it was built
/// from.
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// @throws InputError if three faces share an edge or orientations clash; names the first offending
/// face
HalfedgeMesh halfedges(const TriMesh& mesh);

} // namespace spia
