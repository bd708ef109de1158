#include "engine/unfold/step/ring_chart.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/mesh/vectors.h"

namespace spia {
namespace {

/// Of a symmetric, positive definite matrix. [Cayley and Hamilton]
Eigen::Matrix2d root(const Eigen::Matrix2d& A)
{
    const double determinant = std::sqrt(A.determinant());
    return (A + determinant * Eigen::Matrix2d::Identity()) / std::sqrt(A.trace() + 2 * determinant);
}

} // namespace

std::optional<RingChart> RingChart::around(const TargetSurface& face, const FreedPiece& piece,
                                           const Eigen::Matrix3Xd& state)
{
    RingChart out;
    if (const auto* cylinder = std::get_if<CylinderFace>(&face)) {
        out.origin_ = cylinder->origin, out.axis_ = cylinder->axis, out.towards_ = cylinder->towards;
        out.sine_ = 0;
        out.side_ = cylinder->bulges ? 1 : -1;
    } else if (const auto* cone = std::get_if<ConeFace>(&face)) {
        out.origin_ = cone->apex, out.axis_ = cone->axis, out.towards_ = cone->towards;
        out.sine_ = std::sin(cone->half_angle);
        out.side_ = cone->bulges ? 1 : -1;
    } else
        return std::nullopt;
    const double cosine = std::sqrt(1 - out.sine_ * out.sine_);
    double level = 0;
    for (const int v : piece.held) {
        const Eigen::Vector3d arm = state.col(v) - out.origin_;
        const double along = out.axis_.dot(arm), off = (arm - along * out.axis_).norm();
        level += (cosine * along + out.sine_ * off) / double(piece.held.size());
    }
    out.level_ = level;
    const auto* cylinder = std::get_if<CylinderFace>(&face);
    out.radius_ = cylinder ? cylinder->radius : level * out.sine_;

    // The piece lies to the left of its hinge, seen from the outer side.
    std::set<std::array<int, 2>> hinge;
    for (const auto& [a, b] : piece.hinge)
        hinge.insert({std::min(a, b), std::max(a, b)});
    double around = 0;
    const Eigen::Vector3d across = out.axis_.cross(out.towards_);
    for (int f = 0; f < piece.mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = piece.mesh.triangle(k, f), b = piece.mesh.triangle((k + 1) % 3, f);
            if (!hinge.count({std::min(a, b), std::max(a, b)}))
                continue;
            const auto seen = [&](int v) -> Eigen::Vector2d {
                const Eigen::Vector3d arm = state.col(v) - out.origin_;
                return {out.towards_.dot(arm), across.dot(arm)};
            };
            const Eigen::Vector2d p = seen(a), q = seen(b);
            around += std::atan2(cross(p, q), p.dot(q));
        }
    out.way_ = out.side_ * around >= 0 ? 1 : -1;
    return out;
}

Eigen::Vector2d RingChart::place(const Eigen::Vector3d& point) const
{
    const Eigen::Vector3d arm = point - origin_;
    const double along = axis_.dot(arm), x = towards_.dot(arm), y = axis_.cross(towards_).dot(arm),
                 off = std::hypot(x, y);
    const double level = std::sqrt(1 - sine_ * sine_) * along + sine_ * off;
    const double r = sine_ > 0 ? radius_ * std::pow(level / level_, way_ / sine_)
                               : radius_ * std::exp(way_ * (level - level_) / radius_);
    const double turn = -way_ * side_ * std::atan2(y, x);
    return {r * std::cos(turn), r * std::sin(turn)};
}

Eigen::Vector3d RingChart::point(const Eigen::Vector2d& place) const
{
    const double grown = std::log(place.norm() / radius_), angle = -way_ * side_ * std::atan2(place[1], place[0]);
    const Eigen::Vector3d out = std::cos(angle) * towards_ + std::sin(angle) * axis_.cross(towards_);
    if (sine_ == 0)
        return origin_ + (level_ + way_ * radius_ * grown) * axis_ + radius_ * out;
    const double level = level_ * std::exp(way_ * sine_ * grown);
    return origin_ + level * (std::sqrt(1 - sine_ * sine_) * axis_ + sine_ * out);
}

double RingChart::radius_of(double area_mm2) const
{
    constexpr double turn = 2 * std::numbers::pi,
                     nearest = 0.1; // to the apex of a cone, of the way from the hinge to it
    if (sine_ == 0)
        return radius_ * std::exp(area_mm2 / (turn * radius_ * radius_));
    const double square = 1 + way_ * 2 * area_mm2 / (turn * sine_ * level_ * level_);
    const double level = std::sqrt(std::max(square, nearest * nearest));
    return radius_ * std::pow(level, way_ / sine_);
}

Eigen::Matrix<double, 2, 3> RingChart::developed(const Eigen::Matrix<double, 2, 3>& corner) const
{
    Eigen::Matrix<double, 2, 3> out;
    const Eigen::Vector2d middle = corner.rowwise().mean();
    for (int a = 0; a < 3; ++a) {
        const Eigen::Vector2d p = corner.col(a);
        const double turn = std::atan2(cross(middle, p), middle.dot(p)), grown = std::log(p.norm() / radius_);
        if (sine_ == 0)
            out.col(a) << -way_ * radius_ * turn, level_ + way_ * radius_ * grown;
        else {
            const double level = level_ * std::exp(way_ * sine_ * grown), angle = way_ * sine_ * turn;
            out.col(a) << -level * std::sin(angle), level * std::cos(angle);
        }
    }
    return out;
}

Eigen::Matrix2d RingChart::lengths(const Eigen::Matrix<double, 2, 3>& corner) const
{
    const Eigen::Matrix<double, 2, 3> flat = developed(corner);
    Eigen::Matrix2d from, to;
    from << corner.col(1) - corner.col(0), corner.col(2) - corner.col(0);
    to << flat.col(1) - flat.col(0), flat.col(2) - flat.col(0);
    if (!(to.determinant() > 0)) {
        const double r = corner.rowwise().mean().norm(),
                     level = sine_ > 0 ? level_ * std::pow(r / radius_, way_ * sine_) * sine_ : radius_;
        return level / r * Eigen::Matrix2d::Identity();
    }
    const Eigen::Matrix2d M = to * from.inverse();
    return root(M.transpose() * M);
}

} // namespace spia
