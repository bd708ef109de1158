#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Two pieces of surface side by side, and how.
struct PieceContact {
    int a, b;           ///< pieces, a < b
    double smooth = 0;  ///< mm of edge across which the surface goes on smoothly
    double level = 0;   ///< mm of these, across which it does not turn
    double concave = 0; ///< mm of sharp edge, hollow seen from outside
    double convex = 0;  ///< mm of sharp edge

    double length() const { return smooth + concave + convex; }
};

/// The faces of a mesh in pieces, each to be judged as a whole.
struct SurfacePieces {
    std::vector<int> piece;            ///< per triangle
    std::vector<double> area;          ///< per piece, mm2
    std::vector<PieceContact> contact; ///< each pair once, ascending

    int count() const { return int(area.size()); }
};

/// @param normal  per triangle its area vector, outwards: 3 by #F
/// @param unit  per triangle the number of its piece, any numbers; empty: pieces whose normals turn
/// by less than 12 degrees from
///              that of their largest triangle
SurfacePieces surface_pieces(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, const std::vector<int>& unit);

} // namespace spia
