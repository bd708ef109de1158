#pragma once
#include <vector>

#include "engine/mesh/doctor/doctor.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/soup.h"

namespace spia {

/// The surface of a soup while the doctor mends it.
struct MendedSurface {
    const PolygonSoup& soup;
    std::vector<Triangle> triangle; ///< vertices of the soup, then copies of some
    std::vector<int> number;        ///< per triangle: its polygon in the soup
    std::vector<int> piece;         ///< per triangle: which connected piece
    std::vector<int> home;          ///< per vertex, copies included: the vertex of the soup
    bool two_faces_per_edge = true; ///< at most
    bool two_sided = true;
};

/// Leaves out the marked triangles. @param marked  #triangles, not 0 where one goes
Tally remove(MendedSurface& s, const std::vector<char>& marked);

// The repairs, in the order of the examination. Each reports what it has done and what it cannot
// mend.

/// A triangle without area can be what makes an edge one of three faces. It is left out where this
/// opens no other edge.
Tally drop_flat_at_crowded_edges(MendedSurface& s);

/// Leaves out all but the largest piece of sheet.
void keep_largest(MendedSurface& s, DoctorReport& report);

/// Turns over what shows the other side than its neighbours, and counts the pieces.
void orient(MendedSurface& s, DoctorReport& report);

/// @param dropped  triangles without area that were left out earlier
void mend_flat_triangles(MendedSurface& s, const Tally& dropped, DoctorReport& report);

/// Where faces meet in a vertex only, each further fan gets a copy of the vertex; the first face
/// keeps it.
void separate_fans(MendedSurface& s, DoctorReport& report);

} // namespace spia
