#pragma once
#include "engine/mesh/tri_mesh.h"

/// Parts with a known answer.
namespace spia::shapes {

/// A flat rectangle in the xy plane, columns x rows cells of two triangles.
TriMesh rectangle(double width, double height, int columns, int rows);

} // namespace spia::shapes
