#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/solid/stated_surface.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/unfold/plan/bends.h"

namespace spia {

/// Faces of a part whose corners lie on one cylinder: in one piece, or in pieces between the same
/// angles that holes and notches part.
struct BendZone {
    Eigen::Vector3d point;             ///< mm, on the axis
    Eigen::Vector3d axis;              ///< unit
    double radius;                     ///< mm, of the cylinder on which the corners lie
    double stated = 0;                 ///< mm, radius of the CAD face; 0: none states it
    double measured = 0;               ///< mm, how far corners may lie off what was measured; 0: it
                                       ///< was not, or is stated
    double sewn = 0;                   ///< mm, gaps of the file were closed up to that
    bool bulging;                      ///< on the outer side of the faces
    std::vector<int> face;             ///< ascending
    std::vector<Eigen::Vector3d> turn; ///< per face: where its corners lie around the axis,
                                       ///< radians, without jumps in the zone
    double from = 0, to = 0;           ///< radians: least and greatest of those on the cylinder
    double off = 0;                    ///< mm, distance from the cylinder that three quarters of
                                       ///< the corners are within
};

/// Zones on the cylinders that a CAD file states. Faces of one cylinder that touch are one zone.
/// @param surface  per face what it lies on, or is a distance from, all along its normal
/// @param sewn  mm: gaps between faces of the file were closed up to that, so that planes may not
/// touch the cylinders beside them
std::vector<BendZone> stated_zones(const TriMesh& part, const std::vector<StatedSurface>& surface, double sewn = 0);

/// Zones of a mesh that nothing is known of: the chords of cylinders however large
/// (strip_cylinders()); then of each bend of the map the circle through its vertices, if they lie
/// on one, and all faces of the bend and beside it with their corners on it.
/// @param of_solid  a surface of a solid both of whose skins were searched (measured_cylinders()):
/// flats around a circle that are on none
///                  found there are folds
std::vector<BendZone> fitted_zones(const TriMesh& part, const BendMap& map, bool of_solid = false);

/// Gives the bends of a map the radii of the zones that they are: area over length and angle, by
/// which find_bends() measures any band, is that of its chords.
void take_radii(const std::vector<BendZone>& zones, BendMap& map);

} // namespace spia
