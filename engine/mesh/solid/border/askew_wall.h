#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// The middle of a sheet at a place.
struct SheetPlane {
    Eigen::Vector3d origin, normal; ///< mm; unit
    double half;                    ///< mm, of the thickness

    double height(const Eigen::Vector3d& p) const { return (p - origin).dot(normal); }
    /// Whether a triangle lies in the sheet there, but for rounding.
    bool holds(const TriMesh& solid, int face) const;
};

/// Sine of what a wall leans against one square to the sheet, up to which it counts as square.
constexpr double square_lean = 0.02; // 1 degree

/// The part of a wall around a triangle that leans alike against the sheet, and whether it crosses
/// the sheet, askew and chamfered at its ends or not: then the sheet ends where it is in the
/// middle. What ends at a square wall is a chamfer of that, however deep.
struct AskewWall {
    std::vector<int> face; ///< of the solid, that triangle first; alone where it does not lean
    bool crosses = false;
    bool plane = true; ///< else a cone, say, as what is sunk is

    bool crosses_plane() const { return crosses && plane; }
};

/// @param neighbour  face_neighbours() of the solid
AskewWall askew_wall(const TriMesh& solid, const Eigen::Matrix3Xi& neighbour, int face, const SheetPlane& sheet);

} // namespace spia
