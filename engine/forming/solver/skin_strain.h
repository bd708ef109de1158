#pragma once
#include "engine/forming/blank.h"
#include "engine/forming/solver/membrane.h"

namespace spia {

/// Strains of one skin of the sheet, one entry per face, logarithmic.
struct SkinFields {
    Eigen::VectorXd strain_major, strain_minor, strain_equivalent;
};

/// What bending adds to the strain of the middle surface, which is all a membrane knows.
struct SkinStrains {
    SkinFields outer, inner;   ///< outer: where the faces are seen counter-clockwise from
    Eigen::VectorXd curvature; ///< 1/mm, the principal one of greatest size; positive stretches the
                               ///< outer skin
    int sharp_faces = 0;       ///< bent sharper than a radius of one thickness; taken as bent to
                               ///< that radius
};

/// Curvature of the part, one symmetric tensor per face in the frame of its element, 1/mm, positive
/// where it bulges to the outer side: minus the second derivatives of the quadratic that fits the
/// vertices of the face and their neighbours best, by height over the face. [Cazals and Pouget
/// 2005, jets of degree 2]
std::vector<Eigen::Matrix2d> curvatures(const TriMesh& part, const std::vector<Element>& element);

/// A post-correction (Kirchhoff): the sheet was flat and bends as the part curves, so at height z
/// above the middle surface, here half the formed thickness, the deformation gradient is (I + z W)
/// F with the curvature W. What is bent and straightened again on its way over a radius, and the
/// shift of the neutral layer, are left out.
SkinStrains skin_strains(const TriMesh& part, const std::vector<Element>& element, const Blank& blank,
                         const Sheet& sheet);

} // namespace spia
