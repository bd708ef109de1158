#pragma once
#include "engine/forming/process/process.h"

namespace spia {

/// How a tool presses on its faces.
struct ContactPressure {
    double area_mm2; ///< of the part
    double MPa;      ///< as given, or the force over the area seen along the stamping direction
};

/// @param area_vector of the part's faces, see area_vectors(); @param direction unit vector
/// @throws InputError if a force is given and the faces are not seen along the direction
ContactPressure contact_pressure(const ContactRegion& region, const Eigen::Matrix3Xd& area_vector,
                                 const Eigen::Vector3d& direction);
/// Likewise on a tool that is no plane: seen along a unit vector of its own for each of the part's
/// faces.
ContactPressure contact_pressure(const ContactRegion& region, const Eigen::Matrix3Xd& area_vector,
                                 const Eigen::Matrix3Xd& square_to_tool);

} // namespace spia
