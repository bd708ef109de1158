#pragma once
#include <string_view>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// How well a flat map keeps the part's angles, areas and lengths, whatever method made it. None of
/// the measures depends on where the map lies, how it is turned and how large it is.
struct MapQuality {
    double angular_rms = 0;         ///< best 0
    double area_rms = 0;            ///< best 0
    double l2_stretch = 0;          ///< best 1; infinite with flips
    double symmetric_dirichlet = 0; ///< best 4; infinite with flips
    int flips = 0;                  ///< triangles without positive area
    int crossings = 0;              ///< pairs of boundary edges that meet: where the sheet would
                                    ///< lie on itself
};

/// One line for each measure, "name: formula [source]".
std::string_view quality_definitions();

/// @param flat 2 by #V @throws InputError if a face of the part has no area
MapQuality map_quality(const TriMesh& part, const Eigen::Matrix2Xd& flat);

} // namespace spia
