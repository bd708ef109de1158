#include "engine/forming/process/rolling.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <complex>

namespace spia {

Eigen::Vector2d carried_to_blank(const TriMesh& part, const Eigen::Matrix2Xd& flat, const Eigen::Vector3d& direction,
                                 const Eigen::Vector2d& seen)
{
    const Eigen::Vector3d unit = direction.normalized();
    std::complex<double> sum = 0; // of twice the angles: opposite directions are the same
    double whole = 0;
    for (int f = 0; f < part.triangles(); ++f) {
        const auto t = part.triangle.col(f);
        Eigen::Matrix<double, 3, 2> in_space;
        in_space << part.position.col(t[1]) - part.position.col(t[0]),
            part.position.col(t[2]) - part.position.col(t[0]);
        Eigen::Matrix2d on_blank;
        on_blank << flat.col(t[1]) - flat.col(t[0]), flat.col(t[2]) - flat.col(t[0]);
        const Eigen::Matrix2d gram = in_space.transpose() * in_space;
        const double area = std::sqrt(std::max(0., gram.determinant())) / 2;
        if (!(area > 0))
            continue;
        const Eigen::Vector2d x = on_blank * gram.ldlt().solve(in_space.transpose() * unit);
        const std::complex<double> z(x[0], x[1]);
        if (std::abs(z) > 0)
            sum += area * z * z / std::abs(z);
        whole += area;
    }
    constexpr double none = 1e-6; // of the area
    if (!(std::abs(sum) > none * whole))
        return seen.normalized();
    const double angle = std::arg(sum) / 2;
    const Eigen::Vector2d result(std::cos(angle), std::sin(angle));
    return result.dot(seen) < 0 ? Eigen::Vector2d(-result) : result;
}

} // namespace spia
