#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Whether a face is no higher over its longest edge than that, mm.
bool is_thin(const TriMesh& mesh, int face, double height);

/// Flips the longest edges of faces that are no higher than that and do not look to where their
/// neighbour looks: CAD faces that do not quite meet leave strips of them, whose normals are noise
/// and make sharp edges. They vanish into their neighbours; of needles the ends of the shortest
/// edge are joined. Where the longest edge is on the boundary the face is left out. Vertices keep
/// their numbers, some without a face; no place of the surface moves by more than a few such
/// heights.
/// @param label   per face; edges between different ones stay. It follows the faces.
/// @param height  mm
TriMesh without_thin_faces(const TriMesh& mesh, double height, std::vector<int>& label);

} // namespace spia
