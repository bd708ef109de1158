#pragma once
#include <span>

#include "app/viewer/model/document/state.h"
#include "app/viewer/views/scene_cache.h"
#include "engine/deform/lattice.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/nurbs/multi_patch.h"
#include "engine/nurbs/tessellate.h"

namespace spia::viewer {

/// What a surface stands for.
struct DrawnPart {
    const TriMesh& mesh;
    int part_faces = 0; ///< faces after these fill holes of the part: there is nothing to keep to
};

/// Distance of every vertex of the surface from the part, mm: positive where it lies on the outer
/// side; not a number where a hole of the part was filled.
Eigen::VectorXd surface_deviation(const Tessellation& surface, const DrawnPart& part);

/// Curvature at each vertex of the triangles: mean (1/mm, positive where the surface bends towards
/// its normal) or Gaussian (1/mm2). Not a number where the surface has no normal.
Eigen::VectorXd surface_curvature(const NurbsSurface& surface, const Tessellation& tessellation, bool gaussian);

/// The surface in triangles, one layer, or one for each colour of patches.
/// @param tolerance  mm, of SurfaceLook::tolerance
/// @param lengths    in which the values beside the colours are round
StageShape surface_shape(const MultiPatch& surface, const DrawnPart& part, SurfaceLook look, double tolerance,
                         LengthUnit lengths = LengthUnit::mm);
/// Of the values that a look shows: "mm", "1/mm", "1/mm²".
std::string_view unit_of(SurfaceLook look);

/// Colours by number, 0 to 5, as few as it takes, so that no two patches that share a side have the
/// same. (Where six do not suffice, which no map in the plane needs, neighbours may.)
std::vector<int> patch_colours(const MultiPatch& surface);

/// Lines and points of a lattice, where they are now.
StageShape lattice_shape(const Lattice& lattice, bool dark);

/// Lines and points of the control nets, with their box. @param strength 0 to 1, of their colour;
/// 0: only the box
StageShape control_net_shape(const MultiPatch& surface, bool dark, double strength);

/// Mean length of the lines of the control nets, mm; 0 if there are none.
double control_net_spacing(const MultiPatch& surface);

/// How strongly a net is drawn whose lines are so many pixels long: fainter where they are close,
/// not at all where they would cover the surface. In steps of an eighth.
double control_net_strength(double pixels);

} // namespace spia::viewer
