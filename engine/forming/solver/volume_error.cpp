#include "engine/forming/solver/volume_error.h"

#include <algorithm>
#include <cmath>

#include "engine/forming/solver/membrane.h"
#include "engine/mesh/topology.h"

namespace spia {

namespace {

double area_in_plane(const Eigen::Matrix<double, 2, 3>& x)
{
    const Eigen::Vector2d p = x.col(1) - x.col(0), q = x.col(2) - x.col(0);
    return 0.5 * (p[0] * q[1] - p[1] * q[0]);
}

} // namespace

double volume_error(const TriMesh& part, const Blank& blank, const SheetFields& face, const Eigen::VectorXd& thickness,
                    const LaidLengths& laid)
{
    Eigen::VectorXd formed = area_vectors(part).colwise().norm();
    for (size_t i = 0; i < laid.face.size(); ++i)
        formed[laid.face[i]] = area_in_plane(laid.corner[i]);
    double largest = 0;
    for (int f = 0; f < part.triangles(); ++f) {
        const double flat = area_in_plane(corners(blank.position, part.triangle.col(f)));
        const double h0 = thickness[f];
        largest = std::max(largest, std::abs(face.thickness[f] * formed[f] - h0 * flat) / (h0 * flat));
    }
    return largest;
}

} // namespace spia
