#pragma once
#include "app/viewer/views/scene_cache.h"
#include "engine/forming/flatten.h"
#include "engine/mesh/tri_mesh.h"

namespace spia::viewer {

/// Short crosses along the principal strains on some faces, evenly spread: as long as the strain is large, red where
/// the sheet was stretched and blue where it was squeezed, with a light casing.
/// @param position 3 by #V of the part, mm: the part itself, or its vertices laid flat; the directions are carried over
/// @param crosses about that many
LineList strain_glyphs(const TriMesh& part, const FlattenResult& blank, const Eigen::Matrix3Xd& position,
                       int crosses = 700);

} // namespace spia::viewer
