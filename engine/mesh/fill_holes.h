#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A part without holes, in space and in the plane of its blank. The vertices and faces of the part
/// come first and are unchanged; those of the fill follow.
struct FilledMesh {
    TriMesh mesh;           ///< the part and, in space, a fill that continues it smoothly
    Eigen::Matrix2Xd plane; ///< 2 by #V of mesh: the blank and its fill
    int part_vertices = 0;
    int part_triangles = 0;
    std::vector<int> outline; ///< the outer boundary loop, counter-clockwise
    int holes = 0;            ///< boundary loops that were filled
    int fanned_holes = 0;     ///< those whose edge crosses itself in the plane: closed by a fan,
                              ///< good for nothing but the connectivity

    bool is_fill(int face) const { return face >= part_triangles; }
};

/// The boundary loop that runs around the mesh: the one with the largest area in the plane,
/// counter-clockwise positive. (The longest one may be the wavy edge of a hole.)
/// @param loops of the mesh, as boundary_loops() gives them; @param plane 2 by #V
/// @throws InputError if there is no loop, or none runs counter-clockwise: the blank is upside down
int outer_loop(const std::vector<std::vector<int>>& loops, const Eigen::Matrix2Xd& plane);

/// Closes every boundary loop but the outer one, without moving a vertex. In the plane a hole is
/// triangulated inside its edge and refined to about the size of the edges around it; in space the
/// new vertices minimise the squared Laplacian of the position as a function over the plane, which
/// joins the part with a continuous tangent plane and leaves a hole in a plane part plane. Ear
/// clipping, refinement after [Liepa 2003], biharmonic fill.
/// @param part one component without handles; @param plane 2 by #V of the part, its blank
/// @throws InputError if the filled part is not a disk: several components, or handles
FilledMesh fill_holes(const TriMesh& part, const Eigen::Matrix2Xd& plane, const Progress& progress = {});

} // namespace spia
