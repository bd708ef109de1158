#pragma once
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// What lies behind a place of a surface.
struct Opposite {
    int face;              ///< triangle of the place
    Eigen::Vector3d place; ///< mm
    double area;           ///< mm2, that the place stands for
    int hit = -1;          ///< triangle that the ray inwards along the normal meets first; -1: none
    double distance = 0;   ///< mm, along the ray
    double facing = 0;     ///< minus the cosine between the two normals: 1 where they face away
                           ///< from each other
};

/// Looks inwards from places spread over all triangles, in their order. Large triangles have
/// several.
/// @param normal  per triangle its area vector, outwards: 3 by #F; @param spacing mm, between
/// places; made larger where there
///                would be too many
std::vector<Opposite> opposites(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, double spacing,
                                const Progress& progress = {});

/// The distance that most area has, of places that a face turned against them lies behind: the
/// median within the two per cent with the most area of the ten per cent with the most; where a
/// tenth of that has one distance to rounding, that. 0 if there is none. @param counts per place
double main_distance(const std::vector<Opposite>& places, const std::vector<char>& counts);

/// The value below which a share of the weight lies. @param weighted values and weights, at least
/// one
double quantile(std::vector<std::pair<double, double>> weighted, double share);

} // namespace spia
