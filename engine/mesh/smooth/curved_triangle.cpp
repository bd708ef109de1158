#include "engine/mesh/smooth/curved_triangle.h"

#include <algorithm>
#include <cmath>

namespace spia {
namespace {

/// How much longer than its chord the way is over a surface that the chord meets at such angles,
/// radians: of an arc both are half of what it turns, with opposite signs.
/// @returns nothing where that is too much
std::optional<double> longer(double from, double to)
{
    constexpr double most = 0.6; // radians; at 35 degrees series of fourth order are off by 1e-3
    const double arc = (to - from) / 2, wave = (from + to) / 2;
    if (!(std::abs(arc) <= most && std::abs(wave) <= most))
        return std::nullopt;
    const double bent = arc * arc < 1e-12 ? 1 : arc / std::sin(arc);
    return bent + wave * wave / 10; // of the cubic with these slopes: arc^2/6 + wave^2/10
}

} // namespace

Eigen::Vector3d third_of_way(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& normal)
{
    const Eigen::Vector3d way = to - from;
    return from + (way - way.dot(normal) * normal) / 3;
}

Eigen::Vector3d CubicTriangle::at(const Eigen::Vector3d& barycentric) const
{
    Eigen::Vector3d place = Eigen::Vector3d::Zero(), mean = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
        const double u = barycentric[i];
        place += u * u * u * corner.col(i);
        for (int j = 0; j < 3; ++j)
            if (i != j) {
                place += 3 * u * u * barycentric[j] * near[size_t(i)].col(j);
                mean += near[size_t(i)].col(j) / 6;
            }
    }
    const Eigen::Vector3d middle = mean + (mean - corner.rowwise().mean()) / 2;
    return place + 6 * barycentric.prod() * middle;
}

Eigen::Vector3d CurvedTriangle::on_surface(const Eigen::Vector3d& barycentric) const
{
    CubicTriangle cubic{corner, {}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            cubic.near[size_t(i)].col(j) = third_of_way(corner.col(i), corner.col(j), normal.col(i));
    return cubic.at(barycentric);
}

std::optional<Eigen::Matrix<double, 2, 3>> CurvedTriangle::laid() const
{
    constexpr double flat = 1e-5; // radians: normals of single precision
    Eigen::Vector3d length;       // of the edge from corner k to the next
    bool curved = false;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d chord = corner.col((k + 1) % 3) - corner.col(k), along = chord.normalized();
        const auto angle = [&](int end) { return std::asin(std::clamp(along.dot(normal.col(end)), -1., 1.)); };
        const double from = angle(k), to = angle((k + 1) % 3);
        const auto share = longer(from, to);
        if (!share)
            return std::nullopt;
        curved |= std::abs(from) > flat || std::abs(to) > flat;
        length[k] = *share * chord.norm();
    }
    if (!curved)
        return std::nullopt;
    const double foot = (length[0] * length[0] + length[2] * length[2] - length[1] * length[1]) / (2 * length[0]);
    const double height = std::sqrt(std::max(0., length[2] * length[2] - foot * foot));
    const double before = (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0)).norm();
    constexpr double alike = 0.25; // of needles no height is left of the difference of their sides
    if (!(std::abs(length[0] * height / before - 1) <= alike))
        return std::nullopt;
    // A triangle of shortest ways on a surface of curvature K has 1 + K (a^2 + b^2 + c^2) / 24
    // times the area of the plane one with these sides. [Gauss 1827] K x area is that of the
    // triangle of the normals.
    const Eigen::Vector3d p = normal.col(1) - normal.col(0), q = normal.col(2) - normal.col(0);
    const double turned = normal.rowwise().mean().dot(p.cross(q)), area = length[0] * height;
    constexpr double most = 0.1;
    const double excess = std::clamp(turned / area * length.squaredNorm() / 24, -most, most);
    Eigen::Matrix<double, 2, 3> result;
    result << 0, length[0], foot, 0, 0, height;
    return result * std::sqrt(1 + excess);
}

} // namespace spia
