#pragma once
#include "engine/forming/material.h"

namespace spia {

/// A round bead in a groove with two shoulders; the sheet bends and unbends at each of the three radii.
struct BeadShape {
    double radius = 5;          ///< mm, of the bead
    double shoulder_radius = 3; ///< mm, of the groove's edges
    double depth = 5;           ///< mm, how far the bead pushes the sheet out of its plane
    double friction = 0.12;     ///< coefficient of the contact with the tool
    friend bool operator==(const BeadShape&, const BeadShape&) = default;
};

/// The equivalent bead: force per length (N/mm) that pulls the sheet through. Each bending and unbending costs the plastic
/// work of the moment in plane strain over the change of curvature, each wrap multiplies what is pulled by
/// exp(friction * angle). [Swift 1948, bending under tension; Stoughton 1988, work of bending at a bead] Neither the
/// softening by reverse bending nor the thinning in the bead is in it.
/// @param thickness mm
/// @throws InputError if a length is not positive, the depth or friction negative
double drawbead_force(const BeadShape& bead, const Material& material, double thickness);

} // namespace spia
