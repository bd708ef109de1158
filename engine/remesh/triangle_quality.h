#pragma once
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// How far the triangles of a mesh are from equilateral ones.
struct TriangleQuality {
    int triangles = 0;
    double least_angle = 0;       ///< radians, of all
    double least_angle_of_99 = 0; ///< radians; 99 % of the triangles have none below
    double edge_ratio = 0;        ///< the largest ratio of the longest to the shortest edge of one
                                  ///< triangle
    double median_edge = 0;       ///< mm
    int face = -1;                ///< with the least angle
};

TriangleQuality triangle_quality(const TriMesh& mesh);

/// Radians: how much the angles around the vertices off the boundary differ from a full turn, all
/// taken as positive (the Gaussian curvature, integrated). 0 up to rounding for strips that unroll.
double total_curvature(const TriMesh& mesh);

/// Radians; 0 for a triangle that has no area. Columns: its corners.
double least_angle(const Eigen::Matrix3d& triangle);

/// Of the longest to the shortest edge; infinite or not a number if that has no length. Columns:
/// its corners.
double edge_ratio(const Eigen::Matrix3d& triangle);

} // namespace spia
