#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Cuts that let a part unroll without strain: those of a tray whose walls are joined at its
/// corners, say, with or without a relief there, or of a hoop.
struct CornerSeam {
    std::vector<std::vector<int>> path; ///< vertices, from a corner or an opening to the outline,
                                        ///< edge by edge
    std::vector<int> corner;            ///< vertices that lack most of their angle, or have too
                                        ///< much of it
    std::vector<int> opening;           ///< likewise, one of each of the part's openings that lack
                                        ///< of the turn of a hole in flat sheet
    double length = 0;                  ///< mm, of the paths
    double defect = 0;                  ///< radians, the greatest that one of them lacks or has too
                                        ///< much
};

/// Looks for a few inner vertices and openings that hold all of the part's curvature, and for the
/// shortest ways from them to its outline, the longest line of its border.
/// @param part a sheet: one component, manifold, with a border
/// @returns nothing if the part unrolls as it is, or would not after such cuts: it is curved
/// elsewhere
std::optional<CornerSeam> corner_seam(const TriMesh& part);

} // namespace spia
