#include "engine/forming/solver/laid_lengths.h"

#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia {
namespace {

/// Turned about its middle so that the sum of squares to the other's corners, taken from their
/// middle, is least. [Kabsch 1976 in the plane]
Eigen::Matrix<double, 2, 3> turned_onto(const Eigen::Matrix<double, 2, 3>& other, const Eigen::Matrix<double, 2, 3>& x)
{
    const Eigen::Matrix<double, 2, 3> from = x.colwise() - x.rowwise().mean(),
                                      to = other.colwise() - other.rowwise().mean();
    const Eigen::Matrix2d moment = to * from.transpose();
    const double angle = std::atan2(moment(1, 0) - moment(0, 1), moment(0, 0) + moment(1, 1));
    Eigen::Matrix2d turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return turn * from;
}

} // namespace

std::vector<Element> elements(const TriMesh& part, const LaidLengths& laid)
{
    std::vector<Element> result = elements(part);
    for (size_t i = 0; i < laid.face.size(); ++i) {
        const int f = laid.face[i];
        Element& e = result[size_t(f)];
        const Eigen::Matrix<double, 2, 3> own =
            e.frame.transpose() * Eigen::Matrix3d(part.position(Eigen::all, part.triangle.col(f)));
        const Eigen::Matrix<double, 2, 3> x = turned_onto(own, laid.corner[i]);
        const Eigen::Vector2d p = x.col(1) - x.col(0), q = x.col(2) - x.col(0);
        const double twice_area = p[0] * q[1] - p[1] * q[0];
        if (!(twice_area > 0))
            throw InputError(fmt::format("face {} has no area once it is laid flat", f));
        e.area = 0.5 * twice_area;
        // Rows of the inverse of (p q).
        e.gradient.col(1) = Eigen::Vector2d(q[1], -q[0]) / twice_area;
        e.gradient.col(2) = Eigen::Vector2d(-p[1], p[0]) / twice_area;
        e.gradient.col(0) = -e.gradient.col(1) - e.gradient.col(2);
    }
    return result;
}

} // namespace spia
