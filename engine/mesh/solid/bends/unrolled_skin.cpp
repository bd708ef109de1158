#include "engine/mesh/solid/bends/unrolled_skin.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/core/small_dense.h"
#include "engine/mesh/solid/fit/cylinder_fit.h"
#include "engine/mesh/solid/off_axis.h"

namespace spia {
namespace {

using Kind = StatedSurface::Kind;

} // namespace

std::optional<StatedSurface> cylinder_through(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& normal,
                                              double within)
{
    // The normals of a cylinder are in a plane across its axis.
    constexpr double turns = 1e-3; // of the normals' squares: they turn by 2 degrees or so
    const EigenPairs<3> spread = eigen_pairs(normal * normal.colwise().normalized().transpose());
    constexpr Eigen::Index unknowns = 5;
    if (points.cols() <= unknowns || spread.value[1] < turns * spread.value[2])
        return std::nullopt;
    const auto round = cylinder_along(spread.vector.col(0), points);
    const auto fit = round ? fitted(*round, points, Eigen::VectorXd::Zero(points.cols())) : std::nullopt;
    if (!fit || !(fit->radius > within) || !(fit->off <= within))
        return std::nullopt;
    return StatedSurface{Kind::cylinder, fit->point, fit->axis, fit->radius, 0};
}

UnrolledSkin::UnrolledSkin(const StatedSurface& cylinder, const Eigen::Matrix3Xd& points, double within)
    : cylinder_(cylinder), within_(within)
{
    // Those beside the bend may lie on all sides of its axis.
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& p : points.colwise())
        if (const Eigen::Vector3d out = off_axis(cylinder, p); std::abs(out.norm() - cylinder.radius) <= within)
            middle += out.normalized();
    x_ = middle.isZero(1e-6) ? cylinder.direction.unitOrthogonal() : Eigen::Vector3d(middle.normalized());
    y_ = cylinder.direction.cross(x_);
}

std::optional<UnrolledSkin> UnrolledSkin::of(const std::vector<StatedSurface>& surfaces, const Eigen::Matrix3Xd& points,
                                             double within)
{
    const auto cylinder =
        std::find_if(surfaces.begin(), surfaces.end(), [](const auto& s) { return s.kind == Kind::cylinder; });
    if (cylinder == surfaces.end())
        return std::nullopt;
    UnrolledSkin result(*cylinder, points, within);
    for (const StatedSurface& surface : surfaces)
        if (surface.kind == Kind::other || (surface.kind == Kind::cylinder && !same_cylinder(surface, *cylinder)) ||
            (surface.kind == Kind::plane && !result.touch(surface, points)))
            return std::nullopt;
    return result;
}

/// Takes a plane in that touches the cylinder.
bool UnrolledSkin::touch(const StatedSurface& plane, const Eigen::Matrix3Xd& points)
{
    constexpr double along = 1e-4; // radians, against the axis; that of a mesh is measured
    if (std::abs(plane.direction.dot(cylinder_.direction)) > along)
        return false;
    const double height = (cylinder_.point - plane.point).dot(plane.direction);
    if (std::abs(std::abs(height) - cylinder_.radius) > within_)
        return false;
    const Eigen::Vector3d foot = height > 0 ? Eigen::Vector3d(-plane.direction) : plane.direction;
    const double angle = std::atan2(foot.dot(y_), foot.dot(x_));
    // The places on it say on which side of the cylinder it goes on.
    double beyond = 0;
    const Eigen::Vector3d way = cylinder_.direction.cross(foot);
    for (const auto& p : points.colwise())
        if (std::abs((p - plane.point).dot(plane.direction)) <= within_)
            beyond += (p - cylinder_.point).dot(way);
    if (std::abs(beyond) <= within_)
        return true; // they end where it begins
    std::optional<Side>& side = side_[beyond > 0 ? 1 : 0];
    if (side && std::abs(side->angle - angle) * cylinder_.radius > within_)
        return false;
    side = Side{plane, angle};
    return !side_[0] || !side_[1] || side_[0]->angle < side_[1]->angle;
}

double UnrolledSkin::angle_of(const Eigen::Vector3d& place) const
{
    const Eigen::Vector3d way = off_axis(cylinder_, place);
    return std::atan2(way.dot(y_), way.dot(x_));
}

Eigen::Vector3d UnrolledSkin::out(double angle) const { return std::cos(angle) * x_ + std::sin(angle) * y_; }

std::optional<Eigen::Vector2d> UnrolledSkin::flat(const Eigen::Vector3d& place) const
{
    const Eigen::Vector3d from = place - cylinder_.point;
    const double v = from.dot(cylinder_.direction);
    for (const int s : {0, 1})
        if (const auto& side = side_[size_t(s)]) {
            const Eigen::Vector3d foot = out(side->angle);
            const double beyond = (s ? 1 : -1) * from.dot(cylinder_.direction.cross(foot));
            if (beyond > -within_ && std::abs(from.dot(foot) - cylinder_.radius) <= within_ && from.dot(foot) > 0)
                return Eigen::Vector2d(cylinder_.radius * side->angle + (s ? beyond : -beyond), v);
        }
    if (std::abs(off_axis(cylinder_, place).norm() - cylinder_.radius) > within_)
        return std::nullopt;
    return Eigen::Vector2d(cylinder_.radius * angle_of(place), v);
}

Eigen::Vector3d UnrolledSkin::in_space(const Eigen::Vector2d& flat) const
{
    const int at = zone(flat.x());
    const double angle = at == 0 ? flat.x() / cylinder_.radius : side_[at < 0 ? 0 : 1]->angle;
    const double beyond = flat.x() - cylinder_.radius * angle;
    const Eigen::Vector3d foot = out(angle);
    return cylinder_.point + cylinder_.radius * foot + beyond * cylinder_.direction.cross(foot) +
           flat.y() * cylinder_.direction;
}

std::vector<double> UnrolledSkin::seams() const
{
    std::vector<double> result;
    for (const auto& side : side_)
        if (side)
            result.push_back(cylinder_.radius * side->angle);
    return result;
}

double UnrolledSkin::turn(double u, double to) const
{
    const auto angle = [&](double at) {
        const double free = at / cylinder_.radius;
        return std::clamp(free, side_[0] ? side_[0]->angle : free, side_[1] ? side_[1]->angle : free);
    };
    return std::abs(angle(u) - angle(to));
}

int UnrolledSkin::zone(double u) const
{
    const double angle = u / cylinder_.radius;
    return side_[0] && angle < side_[0]->angle ? -1 : side_[1] && angle > side_[1]->angle ? 1 : 0;
}

int UnrolledSkin::zone_of(const StatedSurface& surface) const
{
    constexpr double alike = 1 - 1e-9; // cosine, 0.003 degrees
    for (const int s : {0, 1})
        if (const auto& side = side_[size_t(s)]; side && surface.kind == Kind::plane)
            if (const double facing = surface.direction.dot(out(side->angle)); std::abs(facing) > alike)
                if ((surface.point - cylinder_.point).dot(out(side->angle)) > 0)
                    return s ? 1 : -1;
    return 0;
}

} // namespace spia
