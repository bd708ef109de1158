#include "engine/forming/external_forces.h"

#include <cmath>

namespace spia {

NodalForces::NodalForces(const ExternalForces& forces, const Eigen::Matrix3Xd& position, const Eigen::Matrix3Xd& normal,
                         const Eigen::Matrix3Xi& triangle, const Eigen::VectorXd& area)
    : forces_(forces), position_(position), normal_(normal)
{
    if (forces.traction.size() == 0 && forces.restraint.empty())
        return;
    friction_ = Eigen::VectorXd::Zero(position.cols());
    line_.resize(size_t(position.cols()));
    for (Eigen::Index f = 0; f < forces.traction.size(); ++f)
        for (int a = 0; a < 3; ++a)
            friction_[triangle(a, f)] += forces.traction[f] * area[f] / 3;
    for (const Restraint& r : forces.restraint)
        line_[size_t(r.vertex)].push_back(r);
    acts_.resize(size_t(position.cols()));
    for (size_t v = 0; v < acts_.size(); ++v)
        acts_[v] = friction_[Eigen::Index(v)] != 0 || !line_[v].empty();
}

ForceAtVertex NodalForces::operator()(int v, const Eigen::Vector2d& X) const
{
    ForceAtVertex out;
    const Eigen::Vector3d n = normal_.col(v);
    const Eigen::Matrix3d to_tangent = Eigen::Matrix3d::Identity() - n * n.transpose();
    const Eigen::Vector3d slip = to_tangent * (position_.col(v) - forces_.origin - forces_.plane * X);
    const Eigen::Matrix<double, 3, 2> slip_change = -to_tangent * forces_.plane;
    const double fade = forces_.full_slip * forces_.full_slip;
    if (friction_[v] != 0) {
        const double length = std::sqrt(slip.squaredNorm() + fade);
        const Eigen::Vector3d way = slip / length;
        out.force -= friction_[v] * way;
        out.derivative -= friction_[v] / length * (slip_change - way * (way.transpose() * slip_change));
    }
    for (const Restraint& r : line_[size_t(v)]) {
        const double across = r.across.dot(slip), length = std::sqrt(across * across + fade);
        out.force -= r.force * across / length * r.across;
        out.derivative -= r.force * fade / (length * length * length) * r.across * (r.across.transpose() * slip_change);
    }
    return out;
}

} // namespace spia
