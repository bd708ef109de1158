#pragma once
#include <Eigen/Core>

namespace spia {

/// The flat blank: every vertex of the part, laid out in the plane. Faces are those of the part.
struct Blank {
    Eigen::Matrix2Xd position; ///< 2 by #V, mm, in the plane of the blank
};

/// What forming did to the sheet; one entry per face, or per node (area-weighted mean of the faces
/// around it).
struct SheetFields {
    Eigen::VectorXd thickness;         ///< mm, after forming
    Eigen::VectorXd thinning;          ///< 1 - thickness / initial thickness
    Eigen::VectorXd strain_major;      ///< logarithmic, the algebraically larger one in the plane
    Eigen::VectorXd strain_minor;      ///< logarithmic
    Eigen::VectorXd strain_equivalent; ///< Hill 1948
    Eigen::VectorXd stress_major;      ///< MPa, along the direction of strain_major
    Eigen::VectorXd stress_minor;      ///< MPa
    Eigen::VectorXd stress_equivalent; ///< MPa
    Eigen::Matrix3Xd direction_major;  ///< unit vector on the part; its sign has no meaning
    Eigen::VectorXi necking;           ///< 1 beyond the strain up to which the hardening curve is
                                       ///< trusted, else 0
};

} // namespace spia
