#include "engine/unfold/cylinder_fit.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>

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
    const Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> qr(a);
    const Eigen::VectorXd right = p.colwise().squaredNorm().transpose() / (size * size);
    const Eigen::Vector3d x = qr.solve(right);
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
    FittedCylinder fit{};
    fit.axis = axis.normalized();
    std::set<int> vertices;
    for (const int f : faces)
        for (int k = 0; k < 3; ++k)
            vertices.insert(part.triangle(k, f));
    const std::vector<int> list(vertices.begin(), vertices.end());
    const Eigen::Matrix<double, 3, 2> frame = across(fit.axis);
    const Eigen::Matrix2Xd flat = frame.transpose() * part.position(Eigen::all, list);
    const auto round = circle(flat);
    if (!round)
        return std::nullopt;
    fit.point = frame * round->head<2>();
    fit.radius = (*round)[2];
    for (Eigen::Index i = 0; i < flat.cols(); ++i)
        fit.off = std::max(fit.off, std::abs((flat.col(i) - round->head<2>()).norm() - fit.radius));
    return fit;
}

bool lies_on(const TriMesh& part, const FittedCylinder& cylinder, int face, double within)
{
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d from = part.position.col(part.triangle(k, face)) - cylinder.point;
        if (std::abs((from - from.dot(cylinder.axis) * cylinder.axis).norm() - cylinder.radius) > within)
            return false;
    }
    return true;
}

} // namespace spia
