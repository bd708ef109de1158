#pragma once
#include <Eigen/Core>
#include <complex>

#include "engine/mesh/tri_mesh.h"
#include "tests/support/shapes.h"

namespace spia {

/// Largest distance between two layouts after the best similarity (no reflection), as a share of
/// the second's size.
inline double distance_up_to_similarity(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b)
{
    const auto centred = [](const Eigen::Matrix2Xd& x) {
        Eigen::VectorXcd z = x.row(0).cast<std::complex<double>>().transpose();
        z += std::complex<double>(0, 1) * x.row(1).transpose();
        return Eigen::VectorXcd(z.array() - z.mean());
    };
    const Eigen::VectorXcd z = centred(a), w = centred(b);
    const std::complex<double> factor = z.dot(w) / z.squaredNorm();
    return (factor * z - w).cwiseAbs().maxCoeff() / w.cwiseAbs().maxCoeff();
}

/// A bumpy sheet that nothing flattens without distortion: disk or, with holes, not.
inline TriMesh bumpy(TriMesh flat, double height)
{
    for (int v = 0; v < flat.vertices(); ++v)
        flat.position(2, v) =
            height * std::sin(0.13 * flat.position(0, v)) * std::cos(0.11 * flat.position(1, v) + 0.3);
    return flat;
}
inline TriMesh bumpy_disk() { return bumpy(shapes::rectangle(60, 45, 8, 6), 6); }
inline TriMesh bumpy_plate() { return bumpy(shapes::plate({.triangles = 1200}), 5); } // two holes

} // namespace spia
