#include "engine/mesh/solid/fit/round_edge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/small_dense.h"

namespace spia {

bool RoundEdge::surrounded(const Eigen::Matrix3Xd& places) const
{
    constexpr double gap = 35 * std::numbers::pi / 180; // as find_curves() has it
    const Eigen::Vector3d x = axis.unitOrthogonal(), y = axis.cross(x);
    std::vector<double> angle;
    for (Eigen::Index i = 0; i < places.cols(); ++i)
        angle.push_back(std::atan2((places.col(i) - centre).dot(y), (places.col(i) - centre).dot(x)));
    if (angle.empty())
        return false;
    std::sort(angle.begin(), angle.end());
    double widest = angle.front() + 2 * std::numbers::pi - angle.back();
    for (size_t i = 0; i + 1 < angle.size(); ++i)
        widest = std::max(widest, angle[i + 1] - angle[i]);
    return widest <= gap;
}

std::optional<RoundEdge> round_edge(const Eigen::Matrix3Xd& places, const Eigen::Vector3d& axis, double within)
{
    constexpr Eigen::Index least = 8;
    if (places.cols() < least)
        return std::nullopt;
    RoundEdge circle{Eigen::Vector3d::Zero(), axis.normalized()};
    // x^2 + y^2 = 2 a x + 2 b y + c in the plane, least squares.
    const Eigen::Vector3d x = circle.axis.unitOrthogonal(), y = circle.axis.cross(x);
    const Eigen::Vector3d mean = places.rowwise().mean();
    const Eigen::Matrix3Xd from = places.colwise() - mean;
    Eigen::MatrixX3d a(places.cols(), 3);
    a << 2 * (x.transpose() * from).transpose(), 2 * (y.transpose() * from).transpose(),
        Eigen::VectorXd::Ones(places.cols());
    const Eigen::VectorXd b = a.leftCols<2>().rowwise().squaredNorm() / 4;
    const Eigen::Vector3d fit = least_squares(a, b);
    circle.centre = mean + fit[0] * x + fit[1] * y;
    circle.radius = std::sqrt(std::max(fit[2] + fit.head<2>().squaredNorm(), 0.));
    for (Eigen::Index i = 0; i < places.cols(); ++i)
        if (std::abs(circle.off_axis(places.col(i)).norm() - circle.radius) > within ||
            std::abs(circle.height(places.col(i))) > within)
            return std::nullopt;
    return circle.surrounded(places) ? std::optional(circle) : std::nullopt;
}

} // namespace spia
