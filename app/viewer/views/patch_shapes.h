#pragma once
#include "app/viewer/views/scene_cache.h"
#include "engine/layout/fit_patches.h"

namespace spia::viewer {

/// The quads of all patches on the part, whose nodes the patches were fitted to, each patch in a
/// colour of its own, and the lines along which patches meet.
StageShape patch_mesh_shape(const PatchesFit& fit, const TriMesh& part);

/// The sides of the patches on the blank, those on its border included; z = 0.
LineList layout_lines(const Layout& layout, bool dark);

} // namespace spia::viewer
