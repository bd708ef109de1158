#pragma once
#include <span>
#include <vector>

#include "engine/forming/process/process.h"

namespace spia {

/// A round bead in a groove with two shoulders; the sheet bends and unbends at each of the three
/// radii. No clearance enters: the groove is as wide as the bead with the sheet on both sides of
/// it, the narrowest that lets it in. A wider one restrains less.
struct BeadShape {
    double radius = 5;          ///< mm, of the bead
    double shoulder_radius = 3; ///< mm, of the groove's edges
    double depth = 5;           ///< mm, how far the bead pushes the sheet out of its plane
    double friction = 0.12;     ///< coefficient of the contact with the tool
    friend bool operator==(const BeadShape&, const BeadShape&) = default;
};

/// The equivalent bead: force per length (N/mm) that pulls the sheet through. Each bending and
/// unbending costs the plastic work of the moment in plane strain over the change of curvature,
/// each wrap multiplies what is pulled by exp(friction * angle). [Swift 1948, bending under
/// tension; Stoughton 1988, work of bending at a bead] Over a shallow bead the sheet spans the
/// groove in a wave flatter than the tools; it is bent no sharper than that, and a wave within its
/// elastic limit costs nothing. Neither the softening by reverse bending nor the thinning in the
/// bead is in it.
/// @param thickness mm
/// @throws InputError if a length is not positive, the depth or friction negative
double drawbead_force(const BeadShape& bead, const Material& material, double thickness);

/// The same with the sheet in which the bead lies: the piece of a tailored blank with the face
/// nearest to the middle of its line, where two overlap the later one, else the base sheet.
/// @param line mm, on the part; @param material, thickness of the base sheet
/// @throws InputError as above
double drawbead_force(const BeadShape& bead, const std::vector<Eigen::Vector3d>& line, const TriMesh& part,
                      const Material& material, double thickness, std::span<const TailoredPiece> pieces);

} // namespace spia
