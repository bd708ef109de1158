#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/coons/quad_grid.h"
#include "engine/core/progress.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/locate.h"

namespace spia {

/// The filled blank, mapped one-to-one onto the unit square. The mesh of the map is that of the
/// blank but for triangles that are cut where an inner edge joins two vertices of one side: a
/// straight side would leave them no area.
struct HarmonicMap {
    Eigen::Matrix2Xd square;             ///< 2 by #V, those of the filled mesh first
    Eigen::Matrix2Xd plane;              ///< 2 by #V, the same vertices in the plane of the blank
    Eigen::Matrix3Xi triangle;           ///< 3 by #F
    std::vector<int> parent;             ///< per triangle, the face of the filled mesh it is a part
                                         ///< of
    std::vector<Eigen::Matrix3d> corner; ///< per triangle, barycentric coordinates of its corners
                                         ///< in the parent

    /// The same place as a point of the filled mesh.
    MeshPoint in_filled_mesh(const MeshPoint& point) const;
};

/// Solves for a position of every inner vertex that is a weighted mean of its neighbours', the
/// sides at their chord lengths on the sides of the square. The weights are cotangents in the plane
/// of the blank, bounded from below by a positive number: the map is one-to-one for every blank,
/// even one that overlaps itself [Tutte 1963, Floater 2003].
/// @param boundary of the same part
HarmonicMap harmonic_map(const FilledMesh& filled, const BlankBoundary& boundary, const Progress& progress = {});

} // namespace spia
