#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// How the sheet turns over an edge between two faces.
struct EdgeTurn {
    int face, twin;       ///< the two faces
    double length;        ///< mm
    double turn;          ///< radians, from 0 to pi; positive either way
    bool bulging;         ///< the outer side is convex here
    Eigen::Vector3d axis; ///< unit: the normal of `face` turns to that of `twin` about it
};

/// The turns of a whole mesh, those of a scan without its noise.
struct SheetTurns {
    Eigen::Matrix3Xd normal;    ///< 3 by #F, unit
    Eigen::VectorXd area;       ///< #F, mm2
    std::vector<EdgeTurn> edge; ///< between two faces each
    std::vector<EdgeTurn> rim;  ///< of one face; only face and length
    std::vector<int> first, at; ///< #F + 1: the edges of face f are at[first[f]] .. at[first[f + 1]
                                ///< - 1]
    double roughness;           ///< radians: how much neighbouring vertices stand off their rings
                                ///< unlike each other, median
    bool smoothed;              ///< the normals are those of a smoothed sheet

    /// mm, of a face above an edge
    double height(const EdgeTurn& e, int of) const { return 2 * area[of] / e.length; }
};

/// Where neighbouring vertices stand off unlike each other by more than `rough` radians (median
/// over the mesh: noise, not curvature), normals are first smoothed over faces that look about
/// alike, which keeps bends and edges [Lee and Wang 2005]; not so where a quarter of the edges turn
/// by less than a tenth of that: such a mesh is exact, but coarse at its bends.
/// @param mesh no edge of more than two faces, no face without area
SheetTurns sheet_turns(const TriMesh& mesh, double rough = 0.01);

} // namespace spia
