#include "engine/exchange/deck/dyna_transforms.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/read_number.h"
#include "engine/exchange/deck/abaqus_keyword.h"

namespace spia {
namespace {

/// Axes of three points: from the first to the second, and towards the third.
std::optional<Eigen::Affine3d> frame_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
    const Eigen::Vector3d x = b - a, z = x.cross(c - a);
    constexpr double in_line = 1e-10; // sine of the angle between them
    if (!(z.norm() > in_line * x.norm() * (c - a).norm()))
        return std::nullopt;
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    frame.linear().col(0) = x.normalized();
    frame.linear().col(2) = z.normalized();
    frame.linear().col(1) = frame.linear().col(2).cross(frame.linear().col(0));
    frame.translation() = a;
    return frame;
}

} // namespace

void DynaTransforms::begin(const DynaKeyword& keyword)
{
    title_next_ = keyword.has("TITLE");
    id_.reset();
    point_.clear();
}

void DynaTransforms::card(std::string_view line)
{
    if (std::exchange(title_next_, false))
        return;
    values_.cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
    if (!id_) {
        id_ = values_.whole(0);
        defined_[*id_] = Eigen::Affine3d::Identity();
        return;
    }
    const std::string option = upper_case(trimmed(values_.fields()[0]));
    if (option.empty())
        return;
    if (option == "POINT") {
        point_[values_.whole(1)] = vector(2);
        return;
    }
    std::optional<Eigen::Affine3d>& whole = defined_[*id_];
    const std::optional<Eigen::Affine3d> next = step(option);
    whole = whole && next ? std::optional(Eigen::Affine3d(*next * *whole)) : std::nullopt;
}

std::optional<Eigen::Affine3d> DynaTransforms::find(std::int64_t id) const
{
    const auto found = defined_.find(id);
    return found == defined_.end() ? std::nullopt : found->second;
}

Eigen::Vector3d DynaTransforms::vector(size_t first)
{
    return {values_.coordinate(first), values_.coordinate(first + 1), values_.coordinate(first + 2)};
}

std::optional<Eigen::Vector3d> DynaTransforms::point(size_t field) const
{
    const auto found = point_.find(values_.whole_or_zero(field));
    return found == point_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<Eigen::Affine3d> DynaTransforms::step(const std::string& option)
{
    Eigen::Affine3d move = Eigen::Affine3d::Identity();
    if (option == "TRANSL") {
        move.translation() = vector(1);
        return move;
    }
    if (option == "SCALE") { // a factor that is not given is 1
        for (int k = 0; k < 3; ++k)
            if (const double factor = values_.coordinate(size_t(k) + 1); factor != 0)
                move.linear()(k, k) = factor;
        return move;
    }
    if (option == "MIRROR") {
        const Eigen::Vector3d at = vector(1), normal = vector(4) - at;
        if (!(normal.norm() > 0))
            return std::nullopt;
        const Eigen::Vector3d n = normal.normalized();
        move.linear() -= 2 * n * n.transpose();
        move.translation() = 2 * n.dot(at) * n;
        return move;
    }
    if (option == "ROTATE")
        return rotation();
    if (option == "POS6P")
        return between_points();
    return std::nullopt;
}

/// About an axis by its direction and a point on it, or where there is no more than three fields by
/// two points.
std::optional<Eigen::Affine3d> DynaTransforms::rotation()
{
    Eigen::Vector3d axis = vector(1), at = vector(4);
    double degrees = values_.coordinate(7);
    if (at.isZero(0) && degrees == 0 && point(1) && point(2)) {
        at = *point(1);
        axis = *point(2) - at;
        degrees = values_.coordinate(3);
    }
    if (!(axis.norm() > 0))
        return std::nullopt;
    return Eigen::Translation3d(at) * Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()) *
           Eigen::Translation3d(-at);
}

/// From the place of the first three points to that of the last three.
std::optional<Eigen::Affine3d> DynaTransforms::between_points()
{
    std::array<std::optional<Eigen::Vector3d>, 6> p;
    for (size_t k = 0; k < p.size(); ++k)
        p[k] = point(k + 1);
    for (const auto& each : p)
        if (!each)
            return std::nullopt;
    const auto from = frame_of(*p[0], *p[1], *p[2]), to = frame_of(*p[3], *p[4], *p[5]);
    return from && to ? std::optional(Eigen::Affine3d(*to * from->inverse())) : std::nullopt;
}

} // namespace spia
