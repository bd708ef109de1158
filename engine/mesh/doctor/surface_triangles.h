#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/doctor/doctor.h"
#include "engine/mesh/edge_uses.h"

namespace spia {

/// The triangles a soup's polygons were split into. Vertices keep their numbers in the soup.
struct SurfaceTriangles {
    std::vector<Triangle> triangle;
    std::vector<int> number;  ///< per triangle: its polygon in the soup, never decreasing
    std::vector<int> same_as; ///< per vertex of the soup the one that stands for it
};

/// Joins vertices if asked to, removes repeated corners and duplicates, and splits what has more
/// than three corners; every change is added to the report. Expects indices in range and finite
/// coordinates.
SurfaceTriangles surface_triangles(const PolygonSoup& soup, const DoctorOptions& options, DoctorReport& report,
                                   const Progress& progress);

} // namespace spia
