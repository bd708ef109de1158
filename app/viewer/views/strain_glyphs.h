#pragma once
#include "app/viewer/views/scene_cache.h"
#include "engine/forming/flatten.h"
#include "engine/mesh/tri_mesh.h"

namespace spia::viewer {

/// How far apart crosses stand that are about 30 pixels apart on the screen: a power of two, so
/// that a camera may come nearer for a while before they change. When they do, those that were
/// there stay, and others join them.
/// @param diagonal mm, of the part; there are not more than some ten thousand crosses however near
/// the camera is
/// @returns mm
double glyph_spacing(double mm_per_pixel, double diagonal);

/// Short crosses along the principal strains on some faces, evenly spread: as long as the strain is
/// large, red where the sheet was stretched and blue where it was squeezed, with a light casing.
/// @param position 3 by #V of the part, mm: the part itself, or its vertices laid flat; the
/// directions are carried over
/// @param spacing mm, between neighbours on the part
LineList strain_glyphs(const TriMesh& part, const FlattenResult& blank, const Eigen::Matrix3Xd& position,
                       double spacing);

} // namespace spia::viewer
