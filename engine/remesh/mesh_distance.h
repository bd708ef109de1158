#pragma once
#include <limits>
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
    Eigen::VectorXd seen_of_face;                    ///< mm; at `place` it is that far
    Eigen::Matrix3Xd place;                          ///< 3 by #F, mm
    std::vector<int> nearest;                        ///< per face: that of the other mesh nearest
                                                     ///< to its middle
};

/// The largest distance from places of a mesh to the nearest place of another, as a bound that
/// holds everywhere, not only at samples. The distance to a triangle is convex: on a polygon it is
/// largest at a corner. Each face is clipped along the borders of the faces that are nearest to its
/// pieces until the bound of each piece is no more than `precision`, or a tenth, above a distance
/// that was seen on the face, or no more than what was seen anywhere.
/// @param search     of `to`
/// @param precision  mm
/// @param harmless   mm: bounds of single faces that are no larger are not made sharper, however
///         little was seen there, unless nothing was seen as far away on any face
/// The result does not depend on the number of threads.
MeshDistance farthest(const TriMesh& from, const TriMesh& to, const ClosestPointSearch& search, double precision,
                      double harmless = std::numeric_limits<double>::infinity(), const Progress& progress = {});

/// Measures some faces again; of the others the distance has to say what still holds. Those that
/// were bounded less sharply than is asked for now are made sharper.
/// @param again  per face of `from`, 1: to be measured
void measure_again(MeshDistance& distance, const std::vector<char>& again, const TriMesh& from, const TriMesh& to,
                   const ClosestPointSearch& search, double precision, double harmless, const Progress& progress = {});

} // namespace spia
