#include "engine/unfold/target/given_face.h"

#include <Eigen/Geometry>

namespace spia {
namespace {

/// Square to an axis, from it to a place.
Eigen::Vector3d across(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const Eigen::Vector3d& towards)
{
    const Eigen::Vector3d arm = towards - origin, square = arm - axis.dot(arm) * axis;
    return square.norm() > 0 ? Eigen::Vector3d(square.normalized()) : axis.unitOrthogonal();
}

} // namespace

PlaneFace given_plane(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal)
{
    const Eigen::Vector3d n = normal.normalized(), x = n.unitOrthogonal();
    Eigen::Matrix<double, 3, 2> axes;
    axes << x, n.cross(x);
    return {origin, axes};
}

CylinderFace given_cylinder(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, double radius,
                            const Eigen::Vector3d& towards)
{
    const Eigen::Vector3d along = axis.normalized();
    return {origin, along, across(origin, along, towards), radius, true};
}

ConeFace given_cone(const Eigen::Vector3d& apex, const Eigen::Vector3d& axis, double half_angle,
                    const Eigen::Vector3d& towards)
{
    const Eigen::Vector3d along = axis.normalized();
    return {apex, along, across(apex, along, towards), half_angle, true};
}

Eigen::Vector3d middle_of_pick(const TriMesh& part, const UnfoldPick& pick)
{
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    const std::vector<int>& faces = pick.fixed.empty() ? pick.freed : pick.fixed;
    for (const int f : faces)
        middle += part.position(Eigen::all, part.triangle.col(f)).rowwise().mean() / double(faces.size());
    return middle;
}

} // namespace spia
