#include "engine/forming/solver/placing.h"

#include <Eigen/Geometry>
#include <cmath>

namespace spia {

Eigen::Matrix<double, 3, 2> blank_plane(const Eigen::Vector3d& direction)
{
    Eigen::Vector3d x = Eigen::Vector3d::UnitX() - direction[0] * direction;
    if (x.norm() < 0.1)
        x = Eigen::Vector3d::UnitY() - direction[1] * direction;
    Eigen::Matrix<double, 3, 2> plane;
    plane.col(0) = x.normalized();
    plane.col(1) = direction.cross(plane.col(0));
    return plane;
}

void place_under_part(const TriMesh& part, const std::vector<Element>& element,
                      const Eigen::Matrix<double, 3, 2>& plane, Eigen::Matrix2Xd& X)
{
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(part.vertices());
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 0; a < 3; ++a)
            mass[part.triangle(a, f)] += element[size_t(f)].area / 3;
    mass /= mass.sum();
    const Eigen::Matrix2Xd below = plane.transpose() * part.position;
    const Eigen::Vector2d to = below * mass, from = X * mass;
    const Eigen::Matrix2d moment = (below.colwise() - to) * mass.asDiagonal() * (X.colwise() - from).transpose();
    const double angle = std::atan2(moment(1, 0) - moment(0, 1), moment(0, 0) + moment(1, 1));
    X = (Eigen::Rotation2Dd(angle).toRotationMatrix() * (X.colwise() - from)).colwise() + to;
}

double place_on(const std::vector<HeldVertex>& held, Eigen::Matrix2Xd& X)
{
    Eigen::Matrix2Xd from(2, Eigen::Index(held.size())), to = from;
    for (size_t k = 0; k < held.size(); ++k) {
        from.col(Eigen::Index(k)) = X.col(held[k].vertex);
        to.col(Eigen::Index(k)) = held[k].place;
    }
    const Eigen::Vector2d c = from.rowwise().mean(), d = to.rowwise().mean();
    const Eigen::Matrix2d moment = (to.colwise() - d) * (from.colwise() - c).transpose();
    const double angle = std::atan2(moment(1, 0) - moment(0, 1), moment(0, 0) + moment(1, 1));
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
    X = (turn * (X.colwise() - c)).colwise() + d;
    return ((turn * (from.colwise() - c)) - (to.colwise() - d)).norm() / (to.colwise() - d).norm();
}

} // namespace spia
