#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A surface whose openings are covered.
struct CoveredOpenings {
    TriMesh mesh;                       ///< its triangles keep their numbers, the covers follow
    std::vector<int> beside;            ///< per triangle of a cover one of the surface at its opening
    std::vector<std::vector<int>> loop; ///< per opening the vertices around it
    std::vector<double> width;          ///< mm, of each: as of a slit of its area and perimeter
    bool surely = true; ///< each is a missing triangle or narrow; else the surface may have had another shape there
};

/// Covers the openings of an almost closed surface: where a few triangles are missing, as in STL
/// files, and slits whose sides do not have the same vertices, so that welding does not close them.
/// Each cover is the triangulation of least area [Barequet and Sharir 1995].
/// @pre manifold
/// @returns nothing if it is closed, or an opening is too large to be one of these
std::optional<CoveredOpenings> cover_small_openings(const TriMesh& surface);

} // namespace spia
