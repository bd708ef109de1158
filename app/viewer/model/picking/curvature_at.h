#pragma once
#include <Eigen/Core>
#include <array>

#include "engine/mesh/region.h"

namespace spia::viewer {

/// How a sheet bends at a place.
struct CurvatureAt {
    std::array<double, 2> curvature = {}; ///< 1/mm, principal, the stronger first; above 0: bends
                                          ///< towards the normal
    Eigen::Vector3d place, normal;        ///< mm, on the fitted face; unit, on the outer side
    Eigen::Vector3d across;               ///< unit, the direction in which it bends most
    double reach_mm = 0;                  ///< radius of the patch that was looked at
    double distance_mm = 0;               ///< greatest one of the patch from the fitted face
    int vertices = 0;                     ///< of the patch
};

/// Of the least-squares quadric z = a x^2 + b x y + c y^2 + d x + e y + f over the vertices of the
/// faces around, z along the normal.
/// @param region  faces, ascending: what is not of it does not count, such as the flat sheet beside
/// a bend
/// @throws InputError if there are too few vertices
CurvatureAt curvature_at(const TriMesh& mesh, int face, const Eigen::Vector3d& place, const FaceSet& region);

} // namespace spia::viewer
