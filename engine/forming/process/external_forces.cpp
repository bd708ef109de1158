#include "engine/forming/process/external_forces.h"

#include <Eigen/Geometry>
#include <cmath>

#include "engine/forming/process/smallest_turn.h"

namespace spia {
namespace {

Eigen::VectorXd at_vertices(const Eigen::VectorXd& traction, const Eigen::Matrix3Xi& triangle,
                            const Eigen::VectorXd& area, Eigen::Index vertices)
{
    Eigen::VectorXd force = Eigen::VectorXd::Zero(vertices);
    for (Eigen::Index f = 0; f < traction.size(); ++f)
        for (int a = 0; a < 3; ++a)
            force[triangle(a, f)] += traction[f] * area[f] / 3;
    return force;
}

/// Friction of some size against a slip, and how it changes with X.
void add_friction(double size, const Eigen::Vector3d& slip, const Eigen::Matrix<double, 3, 2>& slip_change, double fade,
                  ForceAtVertex& out)
{
    const double length = std::sqrt(slip.squaredNorm() + fade);
    const Eigen::Vector3d way = slip / length;
    out.force -= size * way;
    out.derivative -= size / length * (slip_change - way * (way.transpose() * slip_change));
}

} // namespace

ExternalForces ExternalForces::scaled(double share) const
{
    ExternalForces out = *this;
    out.traction *= share;
    out.travelling *= share;
    for (Restraint& each : out.restraint)
        each.force *= share;
    return out;
}

NodalForces::NodalForces(const ExternalForces& forces, const Eigen::Matrix3Xd& position, const Eigen::Matrix3Xd& normal,
                         const Eigen::Matrix3Xi& triangle, const Eigen::VectorXd& area)
    : forces_(forces)
{
    if (!forces.any())
        return;
    const Eigen::Index vertices = position.cols();
    friction_ = at_vertices(forces.traction, triangle, area, vertices);
    travelling_ = at_vertices(forces.travelling, triangle, area, vertices);
    line_.resize(size_t(vertices));
    for (const Restraint& r : forces.restraint)
        line_[size_t(r.vertex)].push_back(r);
    below_ = forces.slip ? forces.slip->foot : Eigen::Matrix2Xd(forces.plane.transpose() * position);
    const Eigen::Vector3d up = forces.plane.col(0).cross(forces.plane.col(1));
    into_sheet_.resize(size_t(vertices));
    if (forces.slip)
        into_sheet_ = forces.slip->into_sheet;
    acts_.resize(size_t(vertices));
    for (size_t v = 0; v < acts_.size(); ++v) {
        acts_[v] = friction_[Eigen::Index(v)] != 0 || travelling_[Eigen::Index(v)] != 0 || !line_[v].empty();
        for (int k = 0; k < 2 && acts_[v] && !forces.slip; ++k)
            into_sheet_[v].col(k) = smallest_turn(up, normal.col(Eigen::Index(v)), forces.plane.col(k));
    }
}

ForceAtVertex NodalForces::operator()(int v, const Eigen::Vector2d& X) const
{
    ForceAtVertex out;
    const Eigen::Matrix<double, 3, 2>& into_sheet = into_sheet_[size_t(v)];
    const Eigen::Matrix<double, 3, 2> slip_change = -into_sheet;
    const Eigen::Vector3d slip = into_sheet * (below_.col(v) - X);
    const double fade = forces_.full_slip * forces_.full_slip;
    if (friction_[v] != 0)
        add_friction(friction_[v], slip, slip_change, fade, out);
    if (travelling_[v] != 0)
        add_friction(travelling_[v], into_sheet * (forces_.stuck.col(v) - X), slip_change, fade, out);
    for (const Restraint& r : line_[size_t(v)]) {
        const double across = r.across.dot(slip), length = std::sqrt(across * across + fade);
        out.force -= r.force * across / length * r.across;
        out.derivative -= r.force * fade / (length * length * length) * r.across * (r.across.transpose() * slip_change);
    }
    return out;
}

} // namespace spia
