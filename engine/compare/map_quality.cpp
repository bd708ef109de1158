#include "engine/compare/map_quality.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "engine/forming/solver/energy_stage.h"
#include "engine/forming/solver/membrane.h"
#include "engine/mesh/flat/distortion.h"
#include "engine/mesh/flat/outline.h"
#include "engine/mesh/topology.h"

namespace spia {

std::string_view quality_definitions()
{
    return "A: area of a triangle on the part, s1 >= s2: singular values of the map from it to the plane, sums over "
           "all F triangles; every map is first scaled to the area of the part.\n"
           "angular rms: sqrt(sum over corners of (a - f)^2 / f^2 / (3 F)), a the flat angle, f the angle on the part, "
           "at inner vertices scaled so that their sum is 2 pi [Sheffer et al. 2005, per corner, with its root taken].\n"
           "area rms: sqrt(sum A (q - 1)^2 / sum A), q = s1 s2 after the scaling.\n"
           "L2 stretch: sqrt(sum A (1/s1^2 + 1/s2^2) / 2 / sum A), best 1, infinite with flips [Sander et al. 2001].\n"
           "symmetric Dirichlet: the least sum A (s1^2 + s2^2 + 1/s1^2 + 1/s2^2) / sum A over all uniform scales of "
           "the map, best 4, infinite with flips [Smith and Schaefer 2015].\n"
           "flips: triangles without positive area in the plane.\n"
           "outline overlaps: pairs of boundary edges, neighbours apart, that cross or touch in the plane.";
}

MapQuality map_quality(const TriMesh& part, const Eigen::Matrix2Xd& flat)
{
    MapQuality quality;
    const Distortion d = distortion(part, flat);
    quality.angular_rms = d.angular_rms;
    quality.area_rms = d.area_rms;
    quality.flips = flipped_triangles(part.triangle, flat);
    quality.crossings = crossings(boundary_loops(part), flat);
    // of A, A s1 s2, A |J|^2, A |J^-1|^2
    double formed_area = 0, mapped_area = 0, stretch = 0, inverse = 0;
    const std::vector<Element> element = elements(part);
    for (int f = 0; f < part.triangles(); ++f) {
        const Element& e = element[size_t(f)];
        const Eigen::Matrix2d J = inverse_gradient(e, corners(flat, part.triangle.col(f)));
        const double determinant = J.determinant();
        formed_area += e.area;
        mapped_area += e.area * determinant;
        stretch += e.area * J.squaredNorm();
        inverse += e.area * J.squaredNorm() / (determinant * determinant);
    }
    quality.l2_stretch = std::sqrt(0.5 * inverse * mapped_area) / formed_area;
    quality.symmetric_dirichlet = 2 * std::sqrt(stretch * inverse) / formed_area;
    if (quality.flips > 0)
        quality.l2_stretch = quality.symmetric_dirichlet = std::numeric_limits<double>::infinity();
    return quality;
}

} // namespace spia
