#pragma once
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// The way the punch travels.
struct StampingDirection {
    Eigen::Vector3d direction = Eigen::Vector3d::Zero(); ///< unit vector on the outer side of the
                                                         ///< part
    double steepest_angle = 0;                           ///< radians between the direction and the
                                                         ///< steepest face's normal
    bool height_field = false;                           ///< no face is seen from behind
    double hidden_area_fraction = 0;                     ///< share of the area seen from behind
                                                         ///< (undercuts)
};

/// The direction that maximises the smallest n_f . d over the faces; where every direction has
/// undercuts, the one from which the most area is seen.
StampingDirection stamping_direction(const TriMesh& part);

} // namespace spia
