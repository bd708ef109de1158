#pragma once
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// How far the points of one mesh can be from another one.
struct MeshDistance {
    double bound = 0;                                ///< mm; no point of any face is farther
    double seen = 0;                                 ///< mm; at `where` it is that far
    Eigen::Vector3d where = Eigen::Vector3d::Zero(); ///< mm
    int face = -1;                                   ///< with the largest bound
    Eigen::VectorXd of_face;                         ///< bound of each face, mm
};

/// The largest distance from places of a mesh to the nearest place of another, as a bound that holds everywhere, not only at samples.
/// The distance to a triangle is convex: on a polygon it is largest at a corner. Each face is clipped along the borders of
/// the faces that are nearest to its pieces until the bound of each piece is no more than `precision`, or a
/// tenth, above a distance that was seen.
/// @param search  of `to`
/// The result does not depend on the number of threads.
MeshDistance farthest(const TriMesh& from, const TriMesh& to, const ClosestPointSearch& search, double precision,
                      const Progress& progress = {});

} // namespace spia
