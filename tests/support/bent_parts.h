#pragma once
#include <array>
#include <vector>

#include "engine/mesh/tri_mesh.h"
#include "tests/support/developable.h"
#include "tests/support/profile.h"

/// Bent and flanged parts, made to be taken apart at their bends.
namespace spia::shapes {

/// A plane or ruled piece between four corners, counter-clockwise seen from the outer side.
struct Patch {
    std::array<Eigen::Vector3d, 4> corner;
    int columns, rows; ///< cells from corner 0 to 1, and from 0 to 3
};
/// Patches with their vertices joined where they are at one place.
TriMesh patchwork(const std::vector<Patch>& patches);

/// A box without a lid, sharp-edged, its walls joined at the corners, with a separate lip turned
/// inwards on each wall.
struct LippedBox {
    double width = 100, depth = 70, height = 30; ///< mm
    double lip = 8;                              ///< mm
    double gap = 10;                             ///< mm, between the end of a lip and the next wall
    double edge = 5;                             ///< mm, about, of the triangles
    bool joined = true;                          ///< the walls; else they only have the bottom in
                                                 ///< common
};
TriMesh lipped_box(const LippedBox& shape = {});

/// A profile (distance outwards, z) swept around z. @param angle radians, below a full turn
TriMesh swept(const Profile& profile, double angle, double edge);

/// A round cup, bottom up, with a radius at the bottom and a flange: all around.
struct RoundCup {
    double radius = 40, height = 30, flange = 15; ///< mm, of the wall, of the flat flange
    double bend = 4;                              ///< mm, of both radii
    int triangles = 6000;
};
TriMesh round_cup(const RoundCup& shape = {});

/// Vertices moved by up to so much in any direction, the same for the same seed.
TriMesh noisy(TriMesh mesh, double most_mm, unsigned seed = 1);

} // namespace spia::shapes
