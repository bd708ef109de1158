#include "engine/mesh/solid/fit/cylinder_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "engine/core/small_dense.h"

namespace spia {
namespace {

/// Circle through places of a plane. [Kasa 1976] Nothing if they lie on a line.
std::optional<Eigen::Vector3d> circle(const Eigen::Matrix2Xd& place)
{
    const Eigen::Vector2d middle = place.rowwise().mean();
    const Eigen::Matrix2Xd p = place.colwise() - middle;
    const double size = p.colwise().norm().maxCoeff();
    if (!(size > 0))
        return std::nullopt;
    Eigen::MatrixX3d a(p.cols(), 3);
    a << p.transpose() / size, Eigen::VectorXd::Ones(p.cols());
    const Eigen::VectorXd right = p.colwise().squaredNorm().transpose() / (size * size);
    const Eigen::Vector3d x = least_squares(a, right);
    const double square = x[2] + (x[0] * x[0] + x[1] * x[1]) / 4;
    if (!x.allFinite() || !(square > 0))
        return std::nullopt;
    return Eigen::Vector3d(middle.x() + size * x[0] / 2, middle.y() + size * x[1] / 2, size * std::sqrt(square));
}

} // namespace

Eigen::Matrix<double, 3, 2> across(const Eigen::Vector3d& axis)
{
    Eigen::Matrix<double, 3, 2> result;
    result.col(0) = axis.unitOrthogonal();
    result.col(1) = axis.cross(result.col(0));
    return result;
}

std::optional<FittedCylinder> cylinder_of(const TriMesh& part, const Eigen::Matrix3Xd& normal,
                                          const Eigen::Matrix3Xi& neighbour, const std::vector<int>& faces)
{
    const std::set<int> in(faces.begin(), faces.end());
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    for (const int f : faces)
        for (int k = 0; k < 3; ++k)
            if (const int g = neighbour(k, f); g > f && in.count(g)) {
                const Eigen::Vector3d edge =
                    part.position.col(part.triangle((k + 1) % 3, f)) - part.position.col(part.triangle(k, f));
                const Eigen::Vector3d turn = normal.col(f).normalized().cross(normal.col(g).normalized()) * edge.norm();
                axis += turn.dot(axis) < 0 ? Eigen::Vector3d(-turn) : turn;
            }
    if (!(axis.norm() > 0))
        return std::nullopt;
    return cylinder_along(axis.normalized(), part.position(Eigen::all, corners(part, faces)));
}

std::optional<FittedCylinder> cylinder_along(const Eigen::Vector3d& axis, const Eigen::Matrix3Xd& place)
{
    FittedCylinder fit{};
    fit.axis = axis;
    const Eigen::Matrix<double, 3, 2> frame = across(fit.axis);
    const Eigen::Matrix2Xd flat = frame.transpose() * place;
    const auto round = circle(flat);
    if (!round)
        return std::nullopt;
    fit.point = frame * round->head<2>();
    fit.radius = (*round)[2];
    for (Eigen::Index i = 0; i < flat.cols(); ++i)
        fit.off = std::max(fit.off, std::abs((flat.col(i) - round->head<2>()).norm() - fit.radius));
    return fit;
}

std::vector<int> corners(const TriMesh& part, const std::vector<int>& faces)
{
    std::vector<int> vertices;
    vertices.reserve(3 * faces.size());
    for (const int f : faces)
        for (int k = 0; k < 3; ++k)
            vertices.push_back(part.triangle(k, f));
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

std::optional<FittedCylinder> fitted(const FittedCylinder& from, const Eigen::Matrix3Xd& place,
                                     const Eigen::VectorXd& shift)
{
    constexpr int most_steps = 30;
    constexpr double still = 1e-13; // of the size
    const Eigen::Vector3d middle = place.rowwise().mean();
    const double size = (place.colwise() - middle).colwise().norm().maxCoeff();
    FittedCylinder at = from;
    at.point += (middle - at.point).dot(at.axis) * at.axis;
    const Eigen::Vector3d first = at.point;
    for (int step = 0; step < most_steps; ++step) {
        const Eigen::Matrix<double, 3, 2> frame = across(at.axis);
        const Eigen::Matrix3Xd w = place.colwise() - at.point;
        const Eigen::RowVectorXd along = at.axis.transpose() * w;
        const Eigen::Matrix2Xd off = frame.transpose() * w;
        const Eigen::VectorXd distance = off.colwise().norm().transpose();
        if (!(size > 0) || !(distance.minCoeff() > 0))
            return std::nullopt;
        // The distance from the axis by its point, its tilt (as what that moves a place so far
        // along it as all are) and the radius.
        Eigen::MatrixXd slope(place.cols(), 5);
        const Eigen::Matrix2Xd out = off.array().rowwise() / distance.transpose().array();
        slope.leftCols(2) = -out.transpose();
        slope.middleCols(2, 2) = -(out.array().rowwise() * (along / size).array()).matrix().transpose();
        slope.col(4).setConstant(-1);
        const Eigen::VectorXd way = shortest_least_squares(
            slope, -(distance - shift).array().matrix() + Eigen::VectorXd::Constant(place.cols(), at.radius));
        at.point += frame * way.head<2>();
        at.axis = (at.axis + frame * way.segment<2>(2) / size).normalized();
        at.radius += way[4];
        if (!way.allFinite() || !(at.radius > 0) || (at.point - first).norm() > from.radius + size)
            return std::nullopt;
        if (way.norm() <= still * size)
            break;
    }
    at.point += (middle - at.point).dot(at.axis) * at.axis;
    at.off = 0;
    for (Eigen::Index i = 0; i < place.cols(); ++i)
        at.off = std::max(at.off, std::abs(distance_from_axis(at, place.col(i)) - at.radius - shift[i]));
    return at;
}

double distance_from_axis(const FittedCylinder& cylinder, const Eigen::Vector3d& place)
{
    const Eigen::Vector3d from = place - cylinder.point;
    return (from - from.dot(cylinder.axis) * cylinder.axis).norm();
}

bool lies_on(const TriMesh& part, const FittedCylinder& cylinder, int face, double within)
{
    for (int k = 0; k < 3; ++k)
        if (std::abs(distance_from_axis(cylinder, part.position.col(part.triangle(k, face))) - cylinder.radius) >
            within)
            return false;
    return true;
}

} // namespace spia
