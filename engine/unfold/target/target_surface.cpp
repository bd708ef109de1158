#include "engine/unfold/target/target_surface.h"

#include <Eigen/Geometry>
#include <cmath>

#include "engine/unfold/target/height_spline.h"

namespace spia {
namespace {

/// A point in the half plane through the axis: along the axis, away from it, and the angle of the
/// half plane.
struct AboutAxis {
    double along, off, angle;
    Eigen::Vector3d out; ///< unit vector away from the axis
};

/// @param origin, axis, towards as of a cylinder
AboutAxis about_axis(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const Eigen::Vector3d& towards,
                     const Eigen::Vector3d& point)
{
    const Eigen::Vector3d arm = point - origin, across = axis.cross(towards);
    const double x = towards.dot(arm), y = across.dot(arm), off = std::hypot(x, y);
    return {axis.dot(arm), off, std::atan2(y, x),
            off > 0 ? Eigen::Vector3d((x * towards + y * across) / off) : towards};
}

Eigen::Vector3d direction_at(const Eigen::Vector3d& axis, const Eigen::Vector3d& towards, double angle)
{
    return std::cos(angle) * towards + std::sin(angle) * axis.cross(towards);
}

struct Developed {
    const Eigen::Vector3d& point;

    Eigen::Vector2d operator()(const PlaneFace& p) const { return p.axes.transpose() * (point - p.origin); }
    Eigen::Vector2d operator()(const HeightFace& h) const { return h.axes.transpose() * (point - h.origin); }
    Eigen::Vector2d operator()(const CylinderFace& c) const
    {
        const AboutAxis at = about_axis(c.origin, c.axis, c.towards, point);
        return {(c.bulges ? 1 : -1) * c.radius * at.angle, at.along};
    }
    Eigen::Vector2d operator()(const ConeFace& c) const
    {
        const AboutAxis at = about_axis(c.apex, c.axis, c.towards, point);
        const double slant = at.along * std::cos(c.half_angle) + at.off * std::sin(c.half_angle),
                     angle = (c.bulges ? -1 : 1) * at.angle * std::sin(c.half_angle);
        return {-slant * std::sin(angle), slant * std::cos(angle)};
    }
};

struct Placed {
    const Eigen::Vector2d& place;

    Eigen::Vector3d operator()(const PlaneFace& p) const { return p.origin + p.axes * place; }
    Eigen::Vector3d operator()(const HeightFace& h) const
    {
        return h.origin + h.axes * place + height_at(h, place).value * h.axes.col(0).cross(h.axes.col(1));
    }
    Eigen::Vector3d operator()(const CylinderFace& c) const
    {
        const double angle = (c.bulges ? 1 : -1) * place[0] / c.radius;
        return c.origin + place[1] * c.axis + c.radius * direction_at(c.axis, c.towards, angle);
    }
    Eigen::Vector3d operator()(const ConeFace& c) const
    {
        const double slant = place.norm(), turned = std::atan2(-place[0], place[1]),
                     angle = (c.bulges ? -1 : 1) * turned / std::sin(c.half_angle);
        return c.apex + slant * (std::cos(c.half_angle) * c.axis +
                                 std::sin(c.half_angle) * direction_at(c.axis, c.towards, angle));
    }
};

struct Tangents {
    using Matrix32d = Eigen::Matrix<double, 3, 2>;
    const Eigen::Vector2d& place;

    Matrix32d operator()(const PlaneFace& p) const { return p.axes; }
    Matrix32d operator()(const HeightFace& h) const
    {
        return h.axes + h.axes.col(0).cross(h.axes.col(1)) * height_at(h, place).slope.transpose();
    }
    Matrix32d operator()(const CylinderFace& c) const
    {
        const double way = c.bulges ? 1 : -1;
        Matrix32d out;
        out << way * c.axis.cross(direction_at(c.axis, c.towards, way * place[0] / c.radius)), c.axis;
        return out;
    }
    Matrix32d operator()(const ConeFace& c) const
    {
        const double way = c.bulges ? -1 : 1, angle = way * std::atan2(-place[0], place[1]) / std::sin(c.half_angle);
        const Eigen::Vector3d out = direction_at(c.axis, c.towards, angle), round = way * c.axis.cross(out),
                              along = std::cos(c.half_angle) * c.axis + std::sin(c.half_angle) * out;
        const Eigen::Vector2d slant = place.normalized();
        return along * slant.transpose() + round * Eigen::RowVector2d(-slant[1], slant[0]);
    }
};

struct OuterNormal {
    const Eigen::Vector3d& point;

    Eigen::Vector3d operator()(const PlaneFace& p) const { return p.axes.col(0).cross(p.axes.col(1)); }
    Eigen::Vector3d operator()(const HeightFace& h) const
    {
        const Eigen::Vector2d slope = height_at(h, h.axes.transpose() * (point - h.origin)).slope;
        return (h.axes.col(0).cross(h.axes.col(1)) - h.axes * slope).normalized();
    }
    Eigen::Vector3d operator()(const CylinderFace& c) const
    {
        return (c.bulges ? 1 : -1) * about_axis(c.origin, c.axis, c.towards, point).out;
    }
    Eigen::Vector3d operator()(const ConeFace& c) const
    {
        const Eigen::Vector3d out = about_axis(c.apex, c.axis, c.towards, point).out;
        return (c.bulges ? 1 : -1) * (std::cos(c.half_angle) * out - std::sin(c.half_angle) * c.axis);
    }
};

} // namespace

bool operator==(const HeightFace& a, const HeightFace& b)
{
    return a.origin == b.origin && a.axes == b.axes && a.corner == b.corner && a.spacing == b.spacing &&
           a.coefficient.rows() == b.coefficient.rows() && a.coefficient.cols() == b.coefficient.cols() &&
           a.coefficient == b.coefficient;
}

std::string_view name(const TargetSurface& face)
{
    constexpr std::string_view names[] = {"plane", "cylinder", "cone", "smooth"};
    return names[face.index()];
}

Eigen::Vector2d developed(const TargetSurface& face, const Eigen::Vector3d& point)
{
    return std::visit(Developed{point}, face);
}

Eigen::Vector3d placed(const TargetSurface& face, const Eigen::Vector2d& place)
{
    return std::visit(Placed{place}, face);
}

Eigen::Vector3d outer_normal(const TargetSurface& face, const Eigen::Vector3d& point)
{
    return std::visit(OuterNormal{point}, face);
}

Eigen::Matrix<double, 3, 2> tangents(const TargetSurface& face, const Eigen::Vector2d& place)
{
    return std::visit(Tangents{place}, face);
}

Eigen::Matrix2d metric(const TargetSurface& face, const Eigen::Vector2d& place)
{
    const auto* height = std::get_if<HeightFace>(&face);
    if (!height)
        return Eigen::Matrix2d::Identity();
    // J^T J = I + s s^T with the slope s: lengths along s are longer, those across it as they are.
    const Eigen::Vector2d slope = height_at(*height, place).slope;
    const double longer = std::sqrt(1 + slope.squaredNorm());
    return Eigen::Matrix2d::Identity() + slope * slope.transpose() / (1 + longer);
}

} // namespace spia
